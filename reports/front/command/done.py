"""Notes what a run has written so far, which is said if it is ended before the rest."""

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

DONE: list[str] = []  # in words, as it comes


def done() -> str:
    """Returns in words what has been written."""
    return "; ".join(DONE) or "nothing was written"


@contextmanager
def finished(stored: bool) -> Iterator[None]:
    """Notes on Ctrl-C that nothing was written; stored: that finished tasks are kept."""
    try:
        yield
    except KeyboardInterrupt:
        if stored:
            DONE.append("nothing was written, but what was finished is kept for the next run")
        raise


def written(frames: "Mapping[str, pd.DataFrame]", out: Path, *, overwrite: bool = False) -> None:
    """Notes that they are there, if they are: an interruption may come after the last of them.

    Looking whether they are takes as long as writing them, and may be interrupted itself: it is
    asked only where the writing was.
    """
    from ...tables import write

    there = f"the reports are in {out}"
    try:
        write.write(frames, out, overwrite=overwrite)
        DONE.append(there)
    except BaseException:
        if there not in DONE and write.holds(frames, out):
            DONE.append(there)
        raise
