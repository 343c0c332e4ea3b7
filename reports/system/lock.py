"""A lock between processes, which dies with the one that holds it."""

import os
import tempfile
from collections.abc import Callable, Iterator
from contextlib import contextmanager, suppress
from hashlib import sha256
from pathlib import Path

WINDOWS = os.name == "nt"
# Never what a link leads to, nor does a pipe wait; Windows has neither word.
_PLAIN = getattr(os, "O_NOFOLLOW", 0) | getattr(os, "O_NONBLOCK", 0)


@contextmanager
def locked(path: Path, waiting: Callable[[], None] | None = None) -> Iterator[None]:
    """Holds the folder, or the file, which is made; waits, and says so, while another does.

    A lock that cannot be had is none: another user's file in a cache that two share, a network
    file system without locks. Who needs it to write learns that from the writing.
    """
    held = _opened(path)
    if held is None:
        yield
        return
    _HELD.add(held)
    try:
        if not _lock(held, waits=False):
            if waiting:
                waiting()
            _lock(held)
        yield
    finally:
        _close(held)


_HELD: set[int] = set()
"""The locks' descriptors: a process that an engine forks would hold them as long as it lives."""


def _lock(held: int, *, waits: bool = True) -> bool:
    """Locks it; False while another has it. On a network file system without locks none has."""
    from filelock import lock_descriptor  # a quarter of a second

    with suppress(OSError):
        return lock_descriptor(held, blocking=waits)
    return True


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
    """The folder, or the file, made where there was none."""
    folder = path.is_dir()
    if folder and WINDOWS:  # it opens no folder: a temporary file of the user's stands for it
        digest = sha256(os.fsencode(path.resolve())).hexdigest()
        path, folder = Path(tempfile.gettempdir(), f"textmech-{digest[:32]}.lock"), False
    kind = os.O_RDONLY if folder else os.O_RDWR | os.O_CREAT
    with suppress(OSError):
        return os.open(path, kind | _PLAIN, 0o600)
    return None


def abandoned(path: Path) -> bool:
    """Whether nobody holds the file any more, or it is gone; False where locks cannot tell."""
    from filelock import lock_descriptor

    try:
        held = os.open(path, os.O_RDONLY | _PLAIN)
    except OSError as error:
        return isinstance(error, FileNotFoundError)
    try:
        return lock_descriptor(held, blocking=False)
    except OSError:
        return False
    finally:
        os.close(held)
