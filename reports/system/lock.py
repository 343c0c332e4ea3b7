"""A lock between processes, which dies with the one that holds it."""

import os
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

try:
    import fcntl
except ImportError:  # Windows has none of this kind: two runs at once are the user's care there
    fcntl = None


@contextmanager
def locked(path: Path, waiting: Callable[[], None] | None = None) -> Iterator[None]:
    """Holds the folder, or the file, which is made; waits, and says so, while another does.

    A lock that cannot be had is none: another user's file in a cache that two share, a network
    file system without locks. Who needs it to write learns that from the writing.
    """
    held = None if fcntl is None else _opened(path)
    if fcntl is None or held is None:
        yield
        return
    _HELD.add(held)
    try:
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            if waiting:
                waiting()
            fcntl.flock(held, fcntl.LOCK_EX)
        except OSError:
            pass  # a network file system without locks
        yield
    finally:
        _close(held)


_HELD: set[int] = set()
"""The locks' descriptors: a process that an engine forks would hold them as long as it lives."""


def _close(held: int) -> None:
    if held in _HELD:
        _HELD.discard(held)
        with suppress(OSError):
            os.close(held)


def _let_go() -> None:
    for held in [*_HELD]:
        _close(held)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_let_go)


def _opened(path: Path) -> int | None:
    """The folder, or the file, made where there was none; never what a link leads to, or a pipe."""
    kind = os.O_RDONLY if path.is_dir() else os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW
    with suppress(OSError):
        return os.open(path, kind | os.O_NONBLOCK, 0o600)
    return None


def abandoned(path: Path) -> bool:
    """Whether nobody holds the file any more; False where locks cannot tell."""
    if fcntl is None:
        return False
    with suppress(OSError):
        held = os.open(path, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK)
        try:
            fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
        finally:
            os.close(held)
        return True
    return False
