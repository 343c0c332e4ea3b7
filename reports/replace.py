"""Files of one folder replaced all together or not at all, whatever strikes where.

The new files are made in a folder beside the old ones. The renaming of that folder decides: before
it the old files count, after it the new ones, and whoever comes next can finish what was decided.
"""

import os
import shutil
import tempfile
from collections.abc import Mapping
from contextlib import suppress
from pathlib import Path

from .lock import locked

MAKING, DECIDED = ".writing-", ".written-"
NEW, OLD, NAMES = "new", "old", "names"


def replace(folder: Path, texts: Mapping[str, str | bytes]) -> None:
    """Writes the texts, or bytes, under their names; waits while another process writes there.

    Raises OSError if the folder cannot take them: then it holds what it held.
    """
    folder.mkdir(parents=True, exist_ok=True)
    with locked(folder):
        _settled(folder)
        try:
            _decide(folder, texts)
        finally:
            _settled(folder)


def settle(folder: Path) -> None:
    """Finishes what an earlier process decided and could not finish, where that may be done."""
    if any(folder.glob(f"{DECIDED}*")):
        with suppress(OSError), locked(folder):
            _settled(folder)


def _decide(folder: Path, texts: Mapping[str, str | bytes]) -> None:
    made = Path(tempfile.mkdtemp(prefix=MAKING, dir=folder))
    (made / NEW).mkdir()
    (made / OLD).mkdir()
    (made / NAMES).write_text("\n".join(texts), encoding="utf-8")
    for name, text in texts.items():
        if (folder / name).exists():
            shutil.copy2(folder / name, made / OLD / name)
        with (made / NEW / name).open("wb") as file:
            file.write(text.encode() if isinstance(text, str) else text)
            file.flush()
            os.fsync(file.fileno())  # the decision must not reach the disk before the text
    made.rename(made.with_name(made.name.replace(MAKING, DECIDED)))


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
    """With the lock, what stands there belongs to nobody any more."""
    for decided in folder.glob(f"{DECIDED}*"):
        _finish(decided, folder)
        _swept(decided)
    for made in folder.glob(f"{MAKING}*"):
        _swept(made)


def _swept(folder: Path) -> None:
    try:
        shutil.rmtree(folder, ignore_errors=True)
    except OSError as error:  # of a folder that it closes twice when it is interrupted there
        if isinstance(error.__context__, KeyboardInterrupt):
            raise error.__context__ from None


def _finish(decided: Path, folder: Path) -> None:
    if not (decided / NAMES).exists():
        return  # finished, and killed while it was swept
    names = (decided / NAMES).read_text(encoding="utf-8").splitlines()
    try:
        for name in names:
            if (decided / NEW / name).exists():
                (decided / NEW / name).replace(folder / name)
    except OSError:  # the folder refuses one of them: then it keeps all old ones
        _undo(decided, folder, names)
        raise


def _undo(decided: Path, folder: Path, names: list[str]) -> None:
    for name in names:
        if (decided / OLD / name).exists():
            (decided / OLD / name).replace(folder / name)
        elif not (decided / NEW / name).exists():
            (folder / name).unlink(missing_ok=True)
    decided.rename(decided.with_name(decided.name.replace(DECIDED, MAKING)))
