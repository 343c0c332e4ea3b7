"""A folder that is named on the command line."""

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import click


class Folder(click.Path):
    """A folder to write into, by a name that is not empty."""

    def __init__(self) -> None:
        super().__init__(file_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The folder, made where there was none: before the work, not after it."""
        if not value:
            self.fail("the folder's name is empty; the current one is '.'", param, ctx)
        folder = Path(str(super().convert(value, param, ctx)))
        try:
            folder.mkdir(parents=True, exist_ok=True)
            TemporaryDirectory(prefix=".writing-", dir=folder).cleanup()
        except OSError as error:
            self.fail(f"cannot write to {folder}: {error.strerror}", param, ctx)
        return folder
