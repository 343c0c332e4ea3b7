"""How a command ends when it is told to: soon, with its workers, and with one line."""

import atexit
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any, NoReturn

INTERRUPTED = 130
SIGNALS = ("SIGINT", "SIGTERM", "SIGHUP")
_LAST: list[Callable[[], object]] = []  # what is done even where nothing else is any more
_WATCHED: list[threading.Thread] = []
OFTEN = 0.2  # s
GRACE = 1.5  # s: workers are killed within milliseconds, and a set of reports is in its place


def listen() -> None:
    """Each of the signals is an interruption from now on, unless the caller ignores it."""
    for number in known_signals():
        if signal.getsignal(number) != signal.SIG_IGN:  # nohup
            signal.signal(number, _interrupt)


def ignore_signals() -> None:
    """Ignore them from here on: what is decided is decided. Only `end` may follow."""
    for number in known_signals():
        signal.signal(number, signal.SIG_IGN)


def end(code: int | None) -> NoReturn:
    """End the process with this exit code (None: 0), whatever threads an engine has left.

    Python itself would wait for each thread that is no daemon. Exit handlers and the last output,
    which may hang too, have GRACE s.
    """
    ignore_signals()
    try:
        closing = threading.Thread(target=_close, daemon=True)
        closing.start()
        closing.join(GRACE)
    finally:
        os._exit(code or 0)


def _close() -> None:
    """Write out both streams, call all exit handlers, and write out what those have said."""
    for call in (_flush, atexit._run_exitfuncs, _flush):
        with suppress(Exception):
            call()


def _flush() -> None:
    for stream in (sys.stdout, sys.stderr):
        with suppress(Exception):  # closed, or its reader is gone
            stream.flush()


@contextmanager
def at_once(last: Callable[[], object]) -> Iterator[None]:
    """Calls `last` too if the process ends inside without anything else: soon, or not at all."""
    _LAST.append(last)
    try:
        yield
    finally:
        _LAST.remove(last)


def with_parent() -> None:
    """From now on this process ends soon after the one that started it, if that is killed."""

    def watch(parent: int) -> None:
        while os.getppid() == parent:
            time.sleep(OFTEN)
        _at_once()

    if hasattr(os, "getppid") and not _WATCHED:
        _WATCHED.append(threading.Thread(target=watch, args=(os.getppid(),), daemon=True))
        _WATCHED[0].start()


def known_signals() -> list[signal.Signals]:
    """The signals among `SIGNALS` that this system has."""
    return [getattr(signal, name) for name in SIGNALS if hasattr(signal, name)]


def block_signals() -> None:
    """Let signals wait in this thread, and in the processes that it starts."""
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_BLOCK, known_signals())


@contextmanager
def signals_blocked() -> Iterator[None]:
    """Let signals wait until the block ends; a process that it starts inherits the waiting."""
    block_signals()
    try:
        yield
    finally:
        if hasattr(signal, "pthread_sigmask"):
            signal.pthread_sigmask(signal.SIG_UNBLOCK, known_signals())


def leave_signals_to_parent() -> None:
    """Ignore what the terminal sends to all of its processes; SIGTERM ends this one."""
    for number in known_signals():
        signal.signal(number, signal.SIG_IGN)
    signal.signal(signal.SIGTERM, signal.SIG_DFL)
    if hasattr(signal, "pthread_sigmask"):
        signal.pthread_sigmask(signal.SIG_UNBLOCK, known_signals())


def _interrupt(*_: Any) -> None:
    """Raises an interruption; ends at once if nobody handles it, or at a second signal."""
    for number in known_signals():
        signal.signal(number, _at_once)
    timer = threading.Timer(GRACE, _at_once)
    timer.daemon = True
    timer.start()
    raise KeyboardInterrupt


def _at_once(*_: Any) -> None:
    """Ends the process at once: its workers see that their parent is gone."""
    for last in reversed(_LAST):
        with suppress(Exception):
            last()
    os._exit(INTERRUPTED)
