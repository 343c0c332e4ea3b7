"""Files of one folder replaced all together or not at all, whatever strikes where.

The new files are made in a folder beside the old ones. The renaming of that folder decides: before
it the old files count, after it the new ones, and whoever writes there next finishes what was
decided. Who only reads leaves it alone: the files of two runs have two names.

A folder may come from anywhere, and hold anything. What is finished or swept was made here: it is
the user's own, and its list of names begins with our mark, which names it as the disk knows it, so
that a copy is none. Nothing is written or deleted by a name that leads elsewhere.
"""

import errno
import os
import re
import stat
import tempfile
from collections.abc import Callable, Iterator, Mapping
from contextlib import suppress
from pathlib import Path

from ..data.file_content import content
from .lock import locked

MAKING, DECIDED = ".writing-", ".written-"
NEW, OLD, BACK, NAMES = "new", "old", "back", "names"
Texts = Mapping[str, str | bytes]
"""What is written, by the files' names."""
_ENDING = re.compile(r"[a-z0-9_]+")


def replace(folder: Path, texts: Texts | Callable[[], Texts]) -> None:
    """Writes the texts, or bytes, under their names; waits while another process writes there.

    texts: also as a function, which is asked when no other process can write there any more.
    Raises OSError if the folder cannot take them: then it holds what it held.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder):
        _settled(folder)
        try:
            _decide(folder, texts() if callable(texts) else texts)
        finally:
            _settled(folder)


def _decide(folder: Path, texts: Texts) -> None:
    for name in texts:
        if not _plain(name):
            raise OSError(errno.EINVAL, "is no file's name", name)
    made = Path(tempfile.mkdtemp(prefix=MAKING, dir=folder))
    (made / NAMES).write_text("\n".join([_mark(made), *texts]), encoding="utf-8")
    (made / NEW).mkdir()
    (made / OLD).mkdir()
    for name, told in texts.items():
        _copied(folder / name, made / OLD / name)
        _written(made / NEW / name, told.encode() if isinstance(told, str) else told)
    made.rename(made.with_name(made.name.replace(MAKING, DECIDED)))


def _copied(file: Path, kept: Path) -> None:
    """Copies the file or link to `kept`, if one stands there. Raises OSError for anything else."""
    with suppress(FileNotFoundError):
        found = file.lstat()
        if stat.S_ISLNK(found.st_mode):
            kept.symlink_to(file.readlink())
            return
        if stat.S_ISDIR(found.st_mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(file))
        _written(kept, content(file, links=False))
        os.chmod(kept, stat.S_IMODE(found.st_mode))
        os.utime(kept, ns=(found.st_atime_ns, found.st_mtime_ns))


def _written(path: Path, data: bytes) -> None:
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())  # the decision must not reach the disk before the text


def _settled(folder: Path) -> None:
    try:
        _settle(folder)
    except OSError:
        _settle(folder)  # what was refused is undone; what is left is swept
        raise
    except BaseException:  # an interruption between two files: they belong together
        _settle(folder)
        raise


def _settle(folder: Path) -> None:
    """With the lock, what stands there of ours belongs to no process any more."""
    for decided in _left(folder, DECIDED):
        names = _names(decided)
        if names is not None:
            _finish(decided, folder, names)
        _swept(decided, names)
    for made in _left(folder, MAKING):
        _swept(made, _names(made))


def _left(folder: Path, prefix: str) -> Iterator[Path]:
    """The user's own folders of such a name."""
    for found in list(os.scandir(folder)):
        if found.name.startswith(prefix) and _ENDING.fullmatch(found.name, len(prefix)):
            own = found.stat(follow_symlinks=False)
            mine = not hasattr(os, "geteuid") or own.st_uid == os.geteuid()
            if mine and stat.S_ISDIR(own.st_mode):
                yield Path(found.path)


def _names(made: Path) -> list[str] | None:
    """The names of its files; None where it was not made here, or was killed before it said."""
    with suppress(OSError, ValueError):
        for part in (NEW, OLD):
            if (made / part).is_symlink():
                return None
        mark, *names = content(made / NAMES, links=False).decode().split("\n")
        if mark == _mark(made) and all(map(_plain, names)):
            return names
    return None


def _mark(made: Path) -> str:
    return f"textmech {made.lstat().st_ino}"


def _plain(name: str) -> bool:
    """Whether it names a file of the folder itself."""
    return name not in ("", ".", "..") and not set(name) & {"/", os.sep, "\0", "\n"}


def _swept(made: Path, names: list[str] | None) -> None:
    """Away with what we put there, and with nothing else; the names last, by which it is ours."""
    for name in names or ():
        for part in (NEW, OLD):
            _gone(made / part / name)
    if names is not None:
        _gone(made / BACK)
    for part in (NEW, OLD):
        _empty(made / part)
    with suppress(OSError):
        known = names is not None or (made / NAMES).lstat().st_size == 0  # killed before it said
        if known and not any(_stands(made / part) for part in (NEW, OLD)):
            (made / NAMES).unlink()
    _empty(made)


def _gone(file: Path) -> None:
    with suppress(OSError):
        file.unlink()


def _empty(folder: Path) -> None:
    with suppress(OSError):  # not empty: whatever is in it is not ours
        folder.rmdir()


def _finish(decided: Path, folder: Path, names: list[str]) -> None:
    try:
        for name in names:
            if _stands(decided / NEW / name):
                (decided / NEW / name).replace(folder / name)
    except OSError:  # the folder refuses one of them: then it keeps all old ones
        _undo(decided, folder, names)
        raise


def _undo(decided: Path, folder: Path, names: list[str]) -> None:
    """Puts back what was moved, from copies that stay: whatever strikes, it is done once more."""
    for name in names:
        if _stands(decided / NEW / name):
            continue  # it never moved, and may be what the folder refused
        if _stands(decided / OLD / name):
            _gone(decided / BACK)
            _copied(decided / OLD / name, decided / BACK)
            (decided / BACK).replace(folder / name)
        else:
            (folder / name).unlink(missing_ok=True)
    decided.rename(decided.with_name(decided.name.replace(DECIDED, MAKING)))


def _stands(file: Path) -> bool:
    return os.path.lexists(file)
