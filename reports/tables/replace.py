"""Files of one folder that are replaced together.

The new files are written whole in a folder beside the old ones, and then renamed one after the
other, the list of the run last. Whoever is killed between two of the renames leaves files that the
list does not fit, which every reader refuses in words; the next run replaces them.
"""

import errno
import os
import shutil
import stat
from collections.abc import Callable, Iterable, Mapping
from contextlib import suppress
from pathlib import Path

from . import run_list
from .lock import locked

MAKING = ".textmech-writing"
Texts = Mapping[str, str | bytes]
"""What is written, by the files' names."""


def replace(folder: Path, texts: Texts | Callable[[], Texts]) -> None:
    """Writes the texts, or bytes, under their names; waits while another process writes there.

    texts: also as a function, which is asked when no other process can write there any more.
    Raises OSError if the folder cannot take them: then it holds what it held, or, where a file
    resists after another is renamed, what every reader refuses as it does after a kill.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder):
        made = folder / MAKING
        shutil.rmtree(made, ignore_errors=True)  # of a run that was killed
        made.mkdir()
        try:
            written = texts() if callable(texts) else texts
            for name, text in written.items():
                _check_place(folder, name)
                _write(made / name, text.encode() if isinstance(text, str) else text)
            names = sorted(written, key=lambda name: name == run_list.NAME)
            try:
                _rename(names, made, folder)
            except KeyboardInterrupt:  # they belong together
                _rename(names, made, folder)
                raise
        finally:
            shutil.rmtree(made, ignore_errors=True)


def _check_place(folder: Path, name: str) -> None:
    """Raises OSError for what is no name of a file, and where something else stands there."""
    if name in ("", ".", "..") or set(name) & {"/", os.sep, "\0"}:
        raise OSError(errno.EINVAL, "is no file's name", name)
    with suppress(FileNotFoundError):
        mode = (folder / name).lstat().st_mode
        if stat.S_ISDIR(mode):
            raise IsADirectoryError(errno.EISDIR, os.strerror(errno.EISDIR), str(folder / name))
        if not (stat.S_ISREG(mode) or stat.S_ISLNK(mode)):
            raise OSError(errno.EINVAL, "is no file", str(folder / name))


def _write(path: Path, data: bytes) -> None:
    with path.open("wb") as file:
        file.write(data)
        file.flush()
        os.fsync(file.fileno())  # the name must not reach the disk before the text


def _rename(names: Iterable[str], made: Path, folder: Path) -> None:
    """Renames the files still to be moved; a link in a file's place is replaced, not followed."""
    for name in names:
        if os.path.lexists(made / name):
            (made / name).replace(folder / name)
