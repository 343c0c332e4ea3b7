"""Work in other processes, on all cores: a process that dies costs its own task only."""

import os
import signal
import tempfile
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import Future, ProcessPoolExecutor, as_completed
from concurrent.futures.process import BrokenProcessPool
from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Died:
    """A task whose process died, or that raised what it should not."""

    because: str


def workers() -> int:
    """As many as there are cores for this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


def spread(
    function: Callable[[Any], Any], tasks: Sequence[Any], *, jobs: int
) -> Iterator[tuple[int, Any]]:
    """(index, result) of every task as it is done; a result may be `Died`.

    A death breaks the whole pool, and nobody can say which task it was: what is left then runs
    one at a time, each in a process of its own.
    """
    left = dict(enumerate(tasks))
    try:
        for index, result in _together(function, left, jobs):
            del left[index]
            yield index, result
    except BrokenProcessPool:
        for index, task in list(left.items()):
            yield index, _alone(function, task)


def _together(
    function: Callable[[Any], Any], tasks: dict[int, Any], jobs: int
) -> Iterator[tuple[int, Any]]:
    with ProcessPoolExecutor(jobs, initializer=_elsewhere) as pool:
        futures = {pool.submit(function, task): index for index, task in tasks.items()}
        try:
            for future in as_completed(futures):
                yield futures[future], _result(future)
        except BaseException:
            pool.shutdown(wait=False, cancel_futures=True)
            raise


def _alone(function: Callable[[Any], Any], task: Any) -> Any:
    with ProcessPoolExecutor(1, initializer=_elsewhere) as pool:
        try:
            return _result(pool.submit(function, task))
        except BrokenProcessPool:
            return Died("the process died")


def _result(future: Future) -> Any:
    try:
        return future.result()
    except BrokenProcessPool:
        raise
    except (Exception, SystemExit) as error:  # one task must not cost the others their rows
        return Died(f"{type(error).__name__}: {error}")


def _elsewhere() -> None:
    """Engines write logs into the current folder: let it not be the user's."""
    os.chdir(tempfile.gettempdir())
    signal.signal(signal.SIGTERM, signal.SIG_DFL)  # the parent's handler is not a worker's
