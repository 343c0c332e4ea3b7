"""Work spread over an executor: a task that raises, or that dies, costs its own result only."""

import os
import threading
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, as_completed
from contextlib import contextmanager
from dataclasses import dataclass
from typing import Any

from .processes import ProcessDied, Processes
from .table_text import spelled, why

BEAT = 1.0  # s
_ONE = threading.Lock()  # engines have one set of callbacks a process


@dataclass(frozen=True)
class Died:
    """A task whose process died, or that raised what it should not."""

    because: str


def workers() -> int:
    """As many as there are cores for this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def local(jobs: int) -> Iterator[Executor]:
    """Processes of this machine, which end with the block in whatever way that ends."""
    executor = Processes(jobs)
    try:
        yield executor
    finally:
        executor.shutdown(cancel_futures=True)


def spread(
    function: Callable[[Any], Any],
    tasks: Sequence[Any],
    executor: Executor,
    beat: Callable[[], object] = lambda: None,
) -> Iterator[tuple[int, Any]]:
    """(index, result) of every task as it is done; a result may be `Died`.

    executor: any of `concurrent.futures`, whose tasks and results cross into another process; a
    cluster's own does a task again if it loses one of its machines. beat: is called every few
    seconds while nothing is done.
    """
    futures: dict[Future, int] = {}
    try:
        for index, task in enumerate(tasks):
            futures[executor.submit(_alone, function, task)] = index
        for future in _as_completed(futures, beat):
            yield futures[future], _result(future)
    finally:
        for future in futures:
            future.cancel()


def _as_completed(futures: Iterable[Future], beat: Callable[[], object]) -> Iterator[Future]:
    left = set(futures)
    while left:
        try:
            for future in as_completed(left, BEAT):
                left.remove(future)
                yield future
        except TimeoutError:
            beat()


def _alone(function: Callable[[Any], Any], task: Any) -> Any:
    """One task at a time in a process, however many threads the executor has there."""
    with _ONE:
        try:
            return function(task)
        except BaseException as error:  # it must not cost the others their rows
            return Died(why(error))


def _result(future: Future) -> Any:
    try:
        return future.result()
    except ProcessDied as died:
        return Died(spelled(died))
    except BrokenExecutor:
        return Died("the process died")
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # what the executor could not carry
        return Died(why(error))
