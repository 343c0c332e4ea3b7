"""Reads a regular file whole: no pipe, no device and no endless file is waited for."""

import errno
import os
import stat
from pathlib import Path

LARGEST = 100_000_000  # bytes of a report: half a million rows; ours have five thousand
_FLAGS = ("O_NONBLOCK", "O_NOCTTY", "O_CLOEXEC", "O_BINARY")  # those that this system has


def content(path: Path, most: int = LARGEST, *, links: bool = True) -> bytes:
    """The file's bytes. Raises OSError if it is no regular file, or longer than `most`.

    links: whether a link to one will do.
    """
    flags = os.O_RDONLY | sum(getattr(os, name, 0) for name in _FLAGS)
    held = os.open(path, flags if links else flags | getattr(os, "O_NOFOLLOW", 0))
    with open(held, "rb", buffering=0) as file:
        status = os.fstat(held)
        if not stat.S_ISREG(status.st_mode):
            raise OSError(errno.EINVAL, "is no file", str(path))
        data = bytearray()
        while len(data) <= most:  # what says 0 bytes, as in /proc, may have more, and no end
            if not (more := file.read(max(1, min(most + 1 - len(data), status.st_size + 1)))):
                break
            data += more
        if len(data) > most:
            size = f"{status.st_size / 1e6:.0f} MB, at most {most / 1e6:.0f}"
            raise OSError(errno.EFBIG, f"is too large: {size}", str(path))
    return bytes(data)


def text(path: Path, most: int = LARGEST) -> str:
    """The file's content as text. Raises OSError, and ValueError for bytes that are no UTF-8."""
    try:
        return content(path, most).decode("utf-8-sig")
    except UnicodeDecodeError as error:
        what = f"is no text in UTF-8: byte {error.start} cannot be read"
        raise ValueError(f"{path}: {what}") from None
