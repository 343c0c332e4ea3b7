"""A folder for one run, of which nothing stays: neither of this one nor of one that was killed.

Temporary folders have room for anyone, and a name proves nothing. What is swept was made here: it
is the user's own, holds our mark, in which the folder itself is named as the disk knows it, so that
a copy is none; and no process holds it.
"""

import os
import re
import shutil
import stat
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

from ..data.file_content import text
from . import termination as ending
from .lock import abandoned, locked

MARK = ".textmech-passing"
LOCK = ".textmech-lock"  # beside the mark: Windows lets nobody read what is locked
LONGEST = 200  # bytes of a mark


@contextmanager
def passing(prefix: str, among: Path | None = None) -> Iterator[Path]:
    """The folder, with no name that is taken; away with the block in whatever way that ends.

    among: where it is made, by default where temporary files are; what killed processes left there
    under the same prefix goes too.
    """
    among = among or Path(tempfile.gettempdir())
    _sweep(prefix, among)
    folder = Path(tempfile.mkdtemp(prefix=prefix, dir=among))
    with ending.at_once(lambda: _away(folder)):
        try:
            with locked(folder / LOCK):
                (folder / MARK).write_text(_mark(folder), encoding="utf-8")
                yield folder
        finally:
            _away(folder)


def adopt(folder: Path) -> None:
    """Whatever was left there is a person's from now on, who has named the folder."""
    if _ours(folder):
        for name in (LOCK, MARK):
            (folder / name).unlink(missing_ok=True)


def _sweep(prefix: str, among: Path) -> None:
    """Away with those that are provably ours, and that nobody holds."""
    named = re.compile(re.escape(prefix) + r"[a-z0-9_]{8}")
    with suppress(OSError):
        for found in list(os.scandir(among)):
            if named.fullmatch(found.name) and _ours(Path(found.path)):
                _away(Path(found.path))


def _away(folder: Path) -> None:
    """Deletes the folder, its mark last: what is killed meanwhile is still known to be ours."""
    with suppress(OSError):
        for found in list(os.scandir(folder)):
            if found.is_dir(follow_symlinks=False):
                shutil.rmtree(found.path, ignore_errors=True)
            elif found.name != MARK:
                with suppress(OSError):
                    os.unlink(found.path)
    shutil.rmtree(folder, ignore_errors=True)


def _ours(folder: Path) -> bool:
    with suppress(OSError, ValueError):
        stands = folder.lstat()
        mine = not hasattr(os, "geteuid") or stands.st_uid == os.geteuid()
        told = stat.S_ISDIR(stands.st_mode) and mine and text(folder / MARK, LONGEST)
        return told == _mark(folder) and abandoned(folder / LOCK)
    return False


def _mark(folder: Path) -> str:
    return f"textmech made {folder.name} as {folder.lstat().st_ino}, and takes it away\n"
