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
    """Locks the folder, or the file, which is made; waits, and says so, while another does.

    A lock that cannot be had is none: another user's file in a cache that two share, a network
    file system without locks. Who needs it to write learns that from the writing.
    """
    descriptor = _opened(path)
    if descriptor is None:
        yield
        return
    _DESCRIPTORS.add(descriptor)
    try:
        if not _lock(descriptor, waits=False):
            if waiting:
                waiting()
            _lock(descriptor)
        yield
    finally:
        _close(descriptor)


_DESCRIPTORS: set[int] = set()
"""Of the locks: a process that an engine forks would hold them as long as it lives."""


def _lock(descriptor: int, *, waits: bool = True) -> bool:
    """Locks a file; False while another process has it; True where the file system has no locks."""
    from filelock import lock_descriptor  # a quarter of a second

    with suppress(OSError):
        return lock_descriptor(descriptor, blocking=waits)
    return True


def _close(descriptor: int) -> None:
    if descriptor in _DESCRIPTORS:
        _DESCRIPTORS.discard(descriptor)
        with suppress(OSError):
            os.close(descriptor)


def _close_all() -> None:
    for descriptor in [*_DESCRIPTORS]:
        _close(descriptor)


if hasattr(os, "register_at_fork"):
    os.register_at_fork(after_in_child=_close_all)


def _opened(path: Path) -> int | None:
    """Opens the folder, or the file, made where there was none."""
    folder = path.is_dir()
    if folder and WINDOWS:  # it opens no folder: a temporary file of the user's stands for it
        digest = sha256(os.fsencode(path.resolve())).hexdigest()
        path, folder = Path(tempfile.gettempdir(), f"textmech-{digest[:32]}.lock"), False
    kind = os.O_RDONLY if folder else os.O_RDWR | os.O_CREAT
    with suppress(OSError):
        return os.open(path, kind | _PLAIN, 0o600)
    return None
