"""A folder for one run, which goes with it."""

import shutil
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from . import termination


@contextmanager
def temporary_folder(prefix: str, among: Path | None = None) -> Iterator[Path]:
    """The folder, which is deleted with the block, in whatever way but SIGKILL that ends.

    among: where it is made, by default where temporary files are.
    """
    folder = Path(tempfile.mkdtemp(prefix=prefix, dir=among))

    def delete() -> None:
        shutil.rmtree(folder, ignore_errors=True)

    with termination.at_once(delete):
        try:
            yield folder
        finally:
            delete()
