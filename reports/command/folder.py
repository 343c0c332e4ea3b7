"""A folder that is named on the command line."""

import atexit
import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import click

from ..system.temporary_folder import adopt


class Folder(click.Path):
    """A folder to write into, by a name that is not empty."""

    def __init__(self) -> None:
        super().__init__(file_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The folder, made where there was none: before the work, not after it."""
        if not value:
            self.fail("the folder's name is empty; the current one is '.'", param, ctx)
        folder = Path(str(super().convert(value, param, ctx)))
        missing = [each for each in (folder, *folder.parents) if not os.path.lexists(each)]
        atexit.register(_unmade, missing)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            _tried(folder)
            adopt(folder)
        except OSError as error:
            self.fail(f"cannot write to {folder}: {error.strerror}", param, ctx)
        return folder


def _unmade(folders: Sequence[Path]) -> None:
    """Away with what was made, the innermost first, and has nothing in it: a refused command's."""
    with suppress(OSError):
        for folder in folders:
            folder.rmdir()


def _tried(folder: Path) -> None:
    """Makes something there and takes it away, if it is interrupted too. Raises OSError."""
    probe = f"{folder}{os.sep}.writing-{os.getpid()}"
    try:
        os.mkdir(probe)
    finally:
        # Not by `suppress`: an interruption may come where that is entered.
        try:  # noqa: SIM105
            os.rmdir(probe)
        except OSError:  # it was never made, or another run has swept it
            pass
