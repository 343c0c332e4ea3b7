"""How a command ends when it is told to: soon, with its workers, and with one line."""

import os
import signal
import threading
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from typing import Any

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


def deaf() -> None:
    """Nothing more is heard: as it shuts down Python takes its handlers back, and dies of a signal.

    After an interruption, what hangs then is still ended after the time of grace.
    """
    for number in known_signals():
        signal.signal(number, signal.SIG_IGN)


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


def with_stdin() -> None:
    """From now on this process ends when its stdin does, whose other end its parent holds."""

    def watch() -> None:
        while os.read(0, 1):
            pass
        os._exit(1)

    threading.Thread(target=watch, daemon=True).start()


def known_signals() -> list[signal.Signals]:
    """The signals among `SIGNALS` that this system has."""
    return [getattr(signal, name) for name in SIGNALS if hasattr(signal, name)]


def _interrupt(*_: Any) -> None:
    """Ends as an error does; at once if nobody hears it, or if it is said again."""
    for number in known_signals():
        signal.signal(number, _at_once)
    timer = threading.Timer(GRACE, _at_once)
    timer.daemon = True
    timer.start()
    raise KeyboardInterrupt


def _at_once(*_: Any) -> None:
    """Workers see that their parent is gone."""
    for last in reversed(_LAST):
        with suppress(Exception):
            last()
    os._exit(INTERRUPTED)
