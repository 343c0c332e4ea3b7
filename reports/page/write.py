"""Where the page is written: beside its reports, all files of a run together."""

from collections.abc import Sequence
from pathlib import Path
from tempfile import TemporaryDirectory

from ...cases.case import Case
from .. import write
from ..replace import replace
from ..suite import Report
from .folder import folder
from .motions import motions
from .page import page

NAME = "index.html"


def write_committed(report: Report, cases: Sequence[Case], rows: Path, out: Path) -> None:
    """The page of reports that are there, and of the motions behind them.

    Raises Missing where there are none, and OSError: then the folder holds what it held.
    """
    replace(out, {NAME: page(folder(rows), cases, motions(report))})


def write_measured(report: Report, out: Path) -> None:
    """The reports of a run and their page. Raises OSError: then the folder holds what it held."""
    frames = write.tables(report, report.cases)
    with TemporaryDirectory() as made:
        write.write(frames, Path(made))
        found = folder(Path(made), beside=out)
    replace(out, write.texts(frames) | {NAME: page(found, report.cases, motions(report))})
