"""`textmech page`."""

from dataclasses import replace
from pathlib import Path

import click

from ....cases.mistake import CaseError
from ..show.console import say, tell
from .done import DONE
from .looking import looked_at, named
from .options import (
    BAD_INPUT,
    Folder,
    allow_long,
    jobs,
    named_cases,
    named_engines,
    no_cache,
    overwrite,
    own_settings,
)

OWN = Path("textmech-page")  # of what was named: the committed reports are of everything


@click.command()
@named_cases
@named_engines("book; ")
@own_settings("is a further column, with its name")
@jobs
@click.option(
    "--out",
    type=Folder(),
    help="Where to write index.html. By default beside the reports of all cases; of cases, engines "
    "or settings that are named, ./textmech-page, with their reports.",
)
@overwrite
@no_cache
@allow_long
def page(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    settings: tuple[str, ...],
    jobs: int | None,
    out: Path | None,
    overwrite: bool,
    no_cache: bool,
    allow_long: bool,
) -> None:
    """One HTML file to look at: heat map, animations, curves, ladders, causes. It needs no network.

    Without CASES it shows the reports that `textmech run` wrote. Motions come from the store of
    results; what is not there is run again, which a first time takes minutes.

    \b
      textmech page                                of all cases, beside their reports
      textmech page my_case.yaml --out look        of your own case: reports and page in look/
      textmech page robot.xml --out look           of a model of yours, MJCF or URDF
      textmech page --settings mine.yaml           all cases, with your settings as a column
    """
    from ...tables import write
    from ...tables.ownership import unasked
    from ..page.folder import Missing
    from ..page.page import NAME, write_committed, write_measured

    partial = bool(cases or names or settings)
    rows = write.by_default()
    folder = out or Folder().convert(str(OWN if partial else rows), None, None)
    try:
        unasked(folder, [*(write.FILES if partial else ()), NAME], overwrite=overwrite)
        if not partial:
            _there(rows)
        request = replace(named(cases, names, settings, long=allow_long), jobs=jobs)
        report = looked_at(request, cached=not no_cache)
        if partial:
            write_measured(report, folder, overwrite=overwrite)
        else:
            write_committed(report, report.cases, rows, folder, overwrite=overwrite)
    except (Missing, ValueError) as error:
        raise click.ClickException(str(error)) from None
    DONE.append(f"the page is {folder / NAME}")
    say(f"written to {folder / NAME}")
    if report.mistakes:
        tell(f"{CaseError(report.mistakes)}\nthese files are left out")
        raise click.exceptions.Exit(BAD_INPUT)


def _there(rows: Path) -> None:
    """Checks the reports before minutes of work. Raises Missing or ValueError."""
    from ..page.folder import folder

    folder(rows)
