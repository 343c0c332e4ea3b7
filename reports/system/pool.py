"""Work spread over an executor: a task that raises, or that dies, costs its own result only."""

import multiprocessing
import os
import pickle
import signal
import tempfile
import threading
import time
from collections.abc import Callable, Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, Future, ThreadPoolExecutor, as_completed
from contextlib import contextmanager
from dataclasses import dataclass
from multiprocessing.connection import Connection, wait
from queue import SimpleQueue
from typing import Any

from ...engines.probe import end_group, lead_group
from ...engines.quiet import silence
from ...reference.integrators.now import NOW, doing
from . import limit
from . import termination as ending
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


# Processes of this machine as an executor: a task whose process dies costs nobody but itself.
#
# `concurrent.futures.ProcessPoolExecutor` loses all tasks with one of its processes, and cannot
# end a task. `pebble` can, but all its processes share one pipe: an answer that cannot be read,
# or a process that is killed while it waits, ends the pool. Here each process has a pipe of its
# own, and a thread that waits for it, knows its task, and replaces it.


WORDS = 300  # bytes of what a process is at
GLANCE = 0.5  # s
DAYS = 1e6  # s: no system waits much longer, so no limit is one

_CHILDREN = threading.Lock()  # one looks at them at a time: the system tells each end only once


class ProcessDied(Exception):
    """A task's process ended before the task did."""


class Processes(Executor):
    """So many processes, each with one task at a time."""

    def __init__(self, jobs: int) -> None:
        self._lock = threading.Lock()
        self._ended = False
        self._idle: SimpleQueue[_Process] = SimpleQueue()
        self._all: set[_Process] = set()
        self._jobs = jobs
        for _ in range(jobs):  # before there are threads: a fork copies their locks as they are
            self._idle.put(self._started())
        self._threads = ThreadPoolExecutor(jobs)

    def submit(self, fn: Callable, /, *args: Any, **kwargs: Any) -> Future:
        """As any executor; a future may raise ProcessDied."""
        return self._threads.submit(self._run, (fn, args, kwargs))

    def shutdown(self, wait: bool = True, *, cancel_futures: bool = False) -> None:
        """Ends all processes; with `cancel_futures` in the middle of their tasks."""
        if not cancel_futures:
            self._threads.shutdown(wait=wait)
        with self._lock:
            self._ended = True
            for process in self._all:
                process.kill()
        self._threads.shutdown(wait=wait, cancel_futures=True)

    def doing(self) -> list[str]:
        """For each process that works on a named task: the task, what it is at, for how long."""
        with self._lock:
            return [said for process in self._all if (said := process.doing())]

    def _started(self) -> "_Process":
        with self._lock:
            if self._ended:
                raise ProcessDied("the run was ended")
            process = _Process(self._jobs)
            self._all.add(process)
            return process

    def _run(self, call: tuple[Callable, tuple, dict[str, Any]]) -> Any:
        process, guest = self._idle.get(), getattr(_task(call), "guest", "")
        try:
            if process.guest not in ("", guest):
                process.kill()
                process = self._replaced(process)
            process.guest = process.guest or guest
            return process.answer(call)
        except ProcessDied:
            process = self._replaced(process)
            raise
        finally:
            self._idle.put(process)

    def _replaced(self, process: "_Process") -> "_Process":
        with self._lock:
            self._all.discard(process)
        return self._started()


def _task(call: tuple[Callable, tuple, dict[str, Any]]) -> Any:
    return call[1][-1] if call[1] else None


class _Process:
    """A process that answers one call after the other.

    guest: somebody else's engine that it has run, whose leftovers are to reach nobody else.
    """

    guest = ""

    def __init__(self, jobs: int) -> None:
        self._here, there = multiprocessing.Pipe()
        self._words = multiprocessing.RawArray("c", WORDS)
        self._task, self._since = "", 0.0
        serving = there, self._words, jobs
        self._process = multiprocessing.Process(target=_serve, args=serving, daemon=True)
        with _CHILDREN, _deaf():
            self._process.start()  # looks at all others too
        there.close()

    def answer(self, call: tuple[Callable, tuple, dict[str, Any]]) -> Any:
        """The call's value from the process; its own error is raised here. Raises ProcessDied."""
        asked = _task(call)
        self._task = getattr(asked, "name", "")
        self._since = time.monotonic()
        try:
            self._here.send(call)
            most = min(getattr(asked, "limit", DAYS), DAYS)
            if not self._answered(most):
                self.kill()
                raise ProcessDied(f"it took longer than {most:.3g} s, and was ended")
            if not self._here.poll():
                raise EOFError
            value, error = self._here.recv()
        except (EOFError, OSError):
            self.kill()
            raise ProcessDied(f"the process died ({self._how()})") from None
        finally:
            self._task = ""
        if error is not None:
            raise error
        return value

    def _answered(self, most: float) -> bool:
        """Whether it has, or is gone, within `most` s: what an engine forked may hold its pipes."""
        until = time.monotonic() + most
        while (left := until - time.monotonic()) > 0.0:
            if wait([self._here, self._process.sentinel], min(left, GLANCE)):
                return True
            with _CHILDREN:
                if not self._process.is_alive():
                    return True
        return most >= DAYS

    def doing(self) -> str:
        """The task's name, what the process is at, for how long [s]; empty without a named task."""
        if not self._task:
            return ""
        said = self._words.value.decode("utf-8", "ignore")
        return f"{self._task}{said and ': ' + said} ({time.monotonic() - self._since:.0f} s)"

    def kill(self) -> None:
        """Ends it, whatever it does, with what its tasks have started and left behind."""
        with _CHILDREN:
            if self._process.pid is not None:
                end_group(self._process.pid)
            self._process.kill()
            self._process.join()

    def _how(self) -> str:
        code = self._process.exitcode
        assert code is not None  # it has been joined
        if code >= 0:
            return f"exit code {code}"
        known = {number.value: number.name for number in signal.Signals}
        return known.get(-code, f"signal {-code}")  # those for real time have no names


@contextmanager
def _deaf() -> Iterator[None]:
    """A signal waits until the new process knows what to do with it; it inherits the waiting."""
    if not hasattr(signal, "pthread_sigmask"):
        yield
        return
    before = signal.pthread_sigmask(signal.SIG_BLOCK, ending.known_signals())
    try:
        yield
    finally:
        signal.pthread_sigmask(signal.SIG_SETMASK, before)


def _serve(calls: Connection, words: Any, jobs: int) -> None:
    """Answers calls in a worker process, one of `jobs`, until its parent is gone."""
    lead_group()
    threading.Thread(target=_with_parent, daemon=True).start()
    threading.Thread(target=_tell, args=(words,), daemon=True).start()
    limit.hold(jobs)  # a thread that finds no room as it starts is waited for without end
    silence()
    os.chdir(tempfile.gettempdir())  # engines write logs: let it not be the user's folder
    for number in ending.known_signals():  # the terminal's reach all: the parent decides
        signal.signal(number, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, ending.known_signals())
    own = os.getpid()
    while True:
        try:
            received = calls.recv_bytes()
        except EOFError:
            return
        doing("")
        value, error = None, None
        try:
            fn, args, kwargs = pickle.loads(received)  # from our own parent
            value = fn(*args, **kwargs)
        except BaseException as raised:  # sys.exit too is one task's
            error = raised
        if os.getpid() != own:  # an engine forked, and came back in both: one answer is enough
            os._exit(0)
        try:
            calls.send((value, error))
        except BaseException as unsent:  # what cannot be pickled
            calls.send((None, RuntimeError(why(unsent))))


def _tell(words: Any) -> None:
    """Where its parent looks, what it is at."""
    while True:
        words.value = NOW.text().encode()[: WORDS - 1]
        time.sleep(GLANCE)


def _with_parent() -> None:
    parent = multiprocessing.parent_process()
    assert parent is not None
    parent.join()
    end_group(os.getpid())
    os._exit(1)
