"""Where the page is written: beside its reports, all files of a run together."""

from collections.abc import Sequence
from pathlib import Path

from ...cases.case import Case
from ..batch.suite import Report
from ..data import runs
from ..data.ownership import unasked
from ..output import write
from ..system.replace import replace
from ..system.temporary_folder import passing
from .folder import folder
from .motions import motions
from .page import page

NAME = "index.html"


def write_committed(
    report: Report, cases: Sequence[Case], rows: Path, out: Path, *, overwrite: bool = False
) -> None:
    """The page of reports that are there, and of the motions behind them.

    overwrite: also what is no page of ours. Raises Missing where there are none, and OSError: then
    the folder holds what it held.
    """
    unasked(out, [NAME], overwrite=overwrite)
    replace(out, {NAME: page(folder(rows), cases, motions(report))})


def write_measured(report: Report, out: Path, *, overwrite: bool = False) -> None:
    """The reports of a run and their page. Raises OSError: then the folder holds what it held."""
    frames = write.tables(report, report.cases)
    unasked(out, [*frames, runs.NAME, NAME], overwrite=overwrite)
    with passing("textmech-page-") as made:
        write.write(frames, made)
        found = folder(made, beside=out)
    made_of = page(found, report.cases, motions(report))
    replace(out, lambda: write.texts(frames, out) | {NAME: made_of})
