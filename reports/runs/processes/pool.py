"""Work spread over an executor: a task that raises, or that dies, costs its own result only."""

import multiprocessing
import os
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import (
    BrokenExecutor,
    Executor,
    Future,
    ProcessPoolExecutor,
    ThreadPoolExecutor,
    as_completed,
)
from contextlib import contextmanager
from dataclasses import dataclass
from queue import SimpleQueue
from typing import Any

from .... import engines
from ....engines.probe import apart, end_group, end_with_parent, lead_group
from ....engines.quiet import silence
from ....reference.integrators.now import NOW, doing
from ...compare.trial import limit
from ...compare.trial.table_text import why
from . import termination

BEAT = 1.0  # s
GLANCE = 0.5  # s
WORDS = 300  # bytes of what a process is at
DAYS = 1e6  # s: no system waits much longer, so no limit is one
_ONE = threading.Lock()  # engines have one set of callbacks a process


@dataclass(frozen=True)
class Died:
    """A task whose process died, or that raised what it should not."""

    because: str


def workers() -> int:
    """Returns the number of cores for this process."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1


@contextmanager
def local(jobs: int) -> Iterator["Processes"]:
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
            futures[executor.submit(_one_at_a_time, function, task)] = index
        for future in _as_completed(futures, beat):
            yield futures[future], _result(future)
    finally:
        for future in futures:
            future.cancel()


def _as_completed(futures: Iterable[Future], beat: Callable[[], object]) -> Iterator[Future]:
    pending = set(futures)
    while pending:
        try:
            for future in as_completed(pending, BEAT):
                pending.remove(future)
                yield future
        except TimeoutError:
            beat()


def _one_at_a_time(function: Callable[[Any], Any], task: Any) -> Any:
    """The task's result or `Died`; one in a process, however many threads the executor has."""
    with _ONE:
        try:
            return function(task)
        except BaseException as error:  # it must not cost the others their rows
            return Died(why(error))


def _result(future: Future) -> Any:
    try:
        return future.result()
    except BrokenExecutor:
        return Died("the process died")
    except KeyboardInterrupt:
        raise
    except BaseException as error:  # what the executor could not carry
        return Died(why(error))


class Processes(Executor):
    """So many processes of this machine: a pool, and a process for each task of a foreign engine.

    A task may have a `name`, a `limit` of its time [s], and an `engine`; somebody else's may do
    anything to its process. A task of ours that takes too long, or that ends its process, breaks
    the pool; from then on each task has a process of its own, so that the one that does it again
    costs nobody else.
    """

    def __init__(self, jobs: int) -> None:
        self._jobs = jobs
        self._pool: ProcessPoolExecutor | None = None
        self._broken = self._ended = False
        self._words = [multiprocessing.RawArray("c", WORDS) for _ in range(jobs)]
        self._slots = [_Slot(words) for words in self._words]
        self._free: SimpleQueue[int] = SimpleQueue()
        for index in range(jobs):
            self._free.put(index)
        self._threads = ThreadPoolExecutor(jobs, initializer=termination.block_signals)

    def submit(self, fn: Callable, /, *args: Any, **kwargs: Any) -> Future:
        """As any executor; what a process dies of is the result: `Died`."""
        if self._pool is None:
            self._pool = self._started()
        return self._threads.submit(self._run, fn, args, kwargs)

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends all processes; with `cancel_futures` in the middle of their tasks."""
        if not cancel_futures:
            self._threads.shutdown(wait=wait)
        self._ended = True
        self._kill_pool()
        self._threads.shutdown(wait=wait, cancel_futures=True)
        if self._pool is not None:
            self._pool.shutdown(wait=wait, cancel_futures=True)

    def doing(self) -> list[str]:
        """For each process that works on a named task: the task, what it is at, for how long."""
        return [text for slot in self._slots if (text := slot.text())]

    def _started(self) -> ProcessPoolExecutor:
        """A pool whose processes run: they are forked before this process has more threads."""
        pool = ProcessPoolExecutor(self._jobs, initializer=_begin, initargs=(self._words,))
        with termination.signals_blocked():  # until a new process ignores them
            pool.submit(os.getpid)
        return pool

    def _run(self, fn: Callable, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
        task, index = args[-1] if args else None, self._free.get()
        most = min(getattr(task, "limit", DAYS), DAYS)
        slot, call = self._slots[index], (index, fn, args, kwargs)
        slot.task, slot.since = getattr(task, "name", ""), time.monotonic()
        try:
            if not (self._broken or _is_foreign(task)):
                assert self._pool is not None
                try:
                    return self._pool.submit(_work, *call).result(most)
                except BrokenExecutor:
                    self._broken = True
                except TimeoutError:
                    self._broken = True
                    self._kill_pool()
                    return Died(f"it takes longer than {most:g} s")
            given = self._words, *call
            result, why_not = apart(_work_apart, *given, most=most, ended=lambda: self._ended)
            return Died(why_not) if why_not else result
        finally:
            slot.task = ""
            self._free.put(index)

    def _kill_pool(self) -> None:
        """Kills a pool's processes and their children; from Python 3.14 on `kill_workers`."""
        for process in [*(getattr(self._pool, "_processes", None) or {}).values()]:
            end_group(process.pid)
            process.kill()


def _is_foreign(task: Any) -> bool:
    engine = getattr(task, "engine", None)
    return engine is not None and engines.foreign(engine.name)


@dataclass
class _Slot:
    """Where one of the processes says what it is at; task: the name of what it works on."""

    words: Any
    task: str = ""
    since: float = 0.0

    def text(self) -> str:
        if not self.task:
            return ""
        at = self.words.value.decode("utf-8", "ignore")
        return f"{self.task}{at and ': ' + at} ({time.monotonic() - self.since:.0f} s)"


_WORDS: list[Any] = []
"""Of a worker process: where each may say what it is at."""
_AT_WORK: list[Any] = []
"""Of a worker process: where this one says it, while it works."""


def _begin(words: list[Any]) -> None:
    """Prepares a new process, one of as many as there are places for words."""
    lead_group()
    end_with_parent()
    _WORDS[:] = words
    threading.Thread(target=_tell, daemon=True).start()
    # After the thread: one that finds no room as it starts is waited for without end.
    limit.limit_memory(len(words))
    silence()
    os.chdir(tempfile.gettempdir())  # engines write logs: let it not be the user's folder
    termination.leave_signals_to_parent()


def _work(index: int, fn: Callable, args: tuple[Any, ...], kwargs: dict[str, Any]) -> Any:
    doing("")
    _WORDS[index].value = b""
    _AT_WORK[:] = [_WORDS[index]]
    try:
        return fn(*args, **kwargs)
    finally:
        _AT_WORK.clear()


def _work_apart(words: list[Any], *call: Any) -> Any:
    _begin(words)
    return _work(*call)


def _tell() -> None:
    """Says where its parent looks what this process is at."""
    while True:
        for words in [*_AT_WORK]:
            words.value = NOW.text().encode()[: WORDS - 1]
        time.sleep(GLANCE)
