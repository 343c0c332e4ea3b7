"""`textmech run`."""

import warnings
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from ...cases.mistake import CaseError, Mistake
from ..show.say import tell
from .done import DONE, finished, written
from .folder import Folder

if TYPE_CHECKING:
    from ...cases.case import Case
    from ...engines.engine import Engine

FAILED, BAD_INPUT = 1, 2
named_cases = click.argument("cases", nargs=-1, metavar="[CASES]...")
allow_long = click.option(
    "--allow-long", is_flag=True, help="Do any amount of work, and not only what takes minutes."
)


def named_engines(beside: str = "") -> Callable[[Any], Any]:
    """The option that chooses engines; beside: what else it takes."""
    return click.option(
        "--engine",
        "names",
        multiple=True,
        metavar="E",
        help=f"An installed engine, as mujoco, pymunk; {beside}or with its setting, as "
        "mujoco.tuned.",
    )


@click.command()
@named_cases
@named_engines("book; ")
@click.option(
    "--settings",
    multiple=True,
    metavar="shipped|tuned|FILE",
    help="Only this setting; a FILE of your own engine options is a further column, with its name. "
    "May be repeated.",
)
@click.option(
    "--causes",
    is_flag=True,
    help="Search for what cures each row above its tolerance: the smallest sets of options between "
    "shipped and tuned. It takes about half as long again; `make reports` does so.",
)
@click.option("--jobs", type=click.IntRange(min=1), help="Processes; as many as cores by default.")
@click.option(
    "--out",
    type=Folder(),
    help="Where to write the CSV files. A full run writes the committed reports of a checkout by "
    "default, and outside of one ./textmech-reports; a partial run writes nothing.",
)
@click.option(
    "--keep",
    type=Folder(),
    help="Write the trajectories too, one CSV a case, reference and engines side by side, and one "
    "with the times of its events.",
)
@click.option(
    "--no-cache",
    is_flag=True,
    help="Compute everything anew. Else results lie in $TEXTMECH_CACHE, by default "
    "~/.cache/textmech, and are used while nothing they depend on has changed.",
)
@click.option(
    "--cluster",
    metavar="ADDRESS",
    help="A Dask scheduler, as tcp://host:8786, whose workers do the work.",
)
@allow_long
def run(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    settings: tuple[str, ...],
    causes: bool,
    jobs: int | None,
    out: Path | None,
    keep: Path | None,
    no_cache: bool,
    cluster: str | None,
    allow_long: bool,
) -> None:
    """Compare engines with the reference and report the differences.

    A file with mistakes is left out: the other files run, and the exit code is 2.
    """
    from .. import keep as kept
    from .. import pool, suite, write
    from ..cache import store
    from ..cluster import executor
    from ..selection import choose_book, choose_engines, sound, sound_cases
    from ..show import terminal
    from ..trial.work import too_long

    full = not (cases or names or settings)
    if out is None and full:
        out = Folder().convert(str(write.by_default()), None, None)
    if out is not None and keep is not None and out.resolve() == keep.resolve():
        raise click.UsageError("--out and --keep are one folder: a case may be called as a report")
    found, mistakes = sound_cases(cases, long=allow_long)
    with warnings.catch_warnings(record=True) as broken:
        engines = choose_engines(names, settings, long=allow_long)
    mistakes += too_long(found, engines)
    chosen = sound(found, mistakes)
    if not chosen:
        raise CaseError(mistakes)
    if mistakes:
        tell(_left_out(mistakes))
    for warning in broken:
        tell(f"warning: {warning.message}")
    book = choose_book(names, settings)
    _answered(chosen, engines, book=book, named=bool(cases))
    used = None if no_cache else store.usable()
    with terminal.progress() as progress, executor(cluster) as working, finished(used is not None):
        report = suite.measure(
            chosen,
            engines,
            jobs=jobs or pool.workers(),
            progress=progress,
            book=book,
            causes=causes,
            store=used,
            executor=working,
        )
    mistakes += report.mistakes
    if used is not None:
        used.trim()
    if full and mistakes:
        out = None  # what is left is no full run
    if out is not None:
        written(write.tables(report, report.cases), out)
    if keep is not None:
        kept.keep(report, keep)
        DONE.append(f"the trajectories are in {keep}")
    terminal.show(report, detailed=bool(cases), written=out)
    if mistakes:
        tell(_left_out(mistakes))  # again: by now it has scrolled away
        raise click.exceptions.Exit(BAD_INPUT)
    if report.fails:
        raise click.exceptions.Exit(FAILED)


def _left_out(mistakes: list[Mistake]) -> str:
    files = len({mistake.file for mistake in mistakes})
    what = "1 file has mistakes and is" if files == 1 else f"{files} files have mistakes and are"
    return f"{CaseError(mistakes)}\n{what} left out"


def _answered(cases: "list[Case]", engines: "list[Engine]", *, book: bool, named: bool) -> None:
    """Says which of the named cases nobody would answer; where that is all, it is a mistake."""
    from ..trial.book import producers

    silent = [case.name for case in cases if not producers(case, engines, book=book)]
    what = "the book approximates dry friction alone, in Examples 2.3 and 2.4"
    if len(silent) == len(cases):
        raise click.UsageError(f"no row for {', '.join(silent)}: {what}")
    if named and silent:
        tell(f"no row for {', '.join(silent)}: {what}")
