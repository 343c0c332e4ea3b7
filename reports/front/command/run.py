"""`textmech run`."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import replace
from importlib import import_module
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, Mistake
from ..show.console import tell
from .done import DONE, written
from .looking import left_out, looked_at, named
from .options import (
    BAD_INPUT,
    FAILED,
    Folder,
    allow_long,
    as_json,
    jobs,
    named_cases,
    named_engines,
    no_cache,
    overwrite,
    own_settings,
)

if TYPE_CHECKING:
    from concurrent.futures import Executor


@click.command()
@named_cases
@named_engines("book; ")
@own_settings()
@click.option(
    "--causes",
    is_flag=True,
    help="Search for what cures each row above its tolerance: the smallest sets of options between "
    "shipped and tuned. It takes twice as long; `make reports` does so.",
)
@jobs
@click.option(
    "--out",
    type=Folder(),
    help="Where to write the CSV files. A full run writes the committed reports of a checkout by "
    "default, and outside of one ./textmech-reports; a partial run writes nothing.",
)
@click.option(
    "--keep",
    type=Folder(),
    help="Write the trajectories too, one CSV a case, reference and engines side by side, one "
    "with the times of its events, and one long table of all poses (Parquet where pyarrow is).",
)
@click.option(
    "--page",
    is_flag=True,
    help="Write their page beside the CSV files too, as `textmech page` does, which would read all "
    "of this again.",
)
@overwrite
@no_cache
@click.option(
    "--cluster",
    metavar="ADDRESS",
    help="A Dask scheduler, as tcp://host:8786, whose workers do the work.",
)
@as_json
@allow_long
def run(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    settings: tuple[str, ...],
    causes: bool,
    jobs: int | None,
    out: Path | None,
    keep: Path | None,
    page: bool,
    overwrite: bool,
    no_cache: bool,
    cluster: str | None,
    wants_json: bool,
    allow_long: bool,
) -> None:
    """Compare engines with the reference and report the differences.

    A file with mistakes is left out: the other files run, and the exit code is 2.

    Of MJCF or URDF files MuJoCo's steps are compared with the model's own continuous equations:
    textmech run robot.xml.
    """
    from ...runs import motion_files as kept
    from ...tables import write
    from ...tables.ownership import unasked
    from ..show import cures, document, terminal

    full = not (cases or names or settings)
    if out is None and full:
        out = Folder().convert(str(write.by_default()), None, None)
    if out is not None and keep is not None and out.resolve() == keep.resolve():
        raise click.UsageError("--out and --keep are one folder: a case may be called as a report")
    if page and out is None:
        raise click.UsageError("--page stands beside the CSV files, and needs --out DIRECTORY")
    if out is not None:
        unasked(out, [*write.FILES, *(["index.html"] if page else [])], overwrite=overwrite)

    request = named(cases, names, settings, long=allow_long)
    if keep is not None:
        unasked(keep, kept.names(request.cases), overwrite=overwrite)
    with _executor(cluster) as executor:
        request = replace(request, jobs=jobs, executor=executor)
        report = looked_at(request, causes=causes, cached=not no_cache)
    mistakes = report.mistakes
    if full and mistakes:
        out = None  # what is left is no full run
    known = cures.known(report.cases, report.causes)
    try:
        if out is not None:
            written(write.tables(report, report.cases), out, overwrite=overwrite)
            if page:
                from ..page.page import write_committed

                write_committed(report, report.cases, out, out, overwrite=overwrite)
                DONE.append(f"their page is in {out}")
        if keep is not None:
            kept.keep(report, keep, overwrite=overwrite)
            DONE.append(f"the trajectories are in {keep}")
    except OSError as error:  # such as a full disk: what was computed is said all the same
        if not wants_json:
            terminal.show(report, detailed=bool(cases), written=None, cures=known)
            raise
        what = error.strerror or str(error)
        mistakes = [*mistakes, Mistake(str(error.filename or ""), 0, 0, "", what)]
        document.write(
            document.of_run(report, mistakes, cures=known, written=None, exit_code=BAD_INPUT)
        )
        raise click.exceptions.Exit(BAD_INPUT) from None
    code = BAD_INPUT if mistakes else FAILED if report.fails else 0
    if wants_json:
        document.write(document.of_run(report, mistakes, cures=known, written=out, exit_code=code))
    else:
        terminal.show(report, detailed=bool(cases), written=out, cures=known)
    if mistakes:
        tell(left_out(mistakes))  # again: by now it has scrolled away
    raise click.exceptions.Exit(code)


@contextmanager
def _executor(address: str | None) -> "Iterator[Executor | None]":
    """Yields the Dask scheduler's executor at the address; None without one. Raises CaseError."""
    if address is None:
        yield None
        return
    try:
        dask = import_module("distributed")
    except ImportError:
        what = "needs Dask: pip install 'textmech[dask]'"
        raise CaseError([Mistake("--cluster", 0, 0, "", what)]) from None
    try:
        client = dask.Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise CaseError([Mistake("--cluster", 0, 0, address, str(error))]) from None
    with client:
        yield client.get_executor()
