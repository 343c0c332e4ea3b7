"""`textmech run`."""

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import click

from ...cases.mistake import CaseError, Mistake
from ..show.say import tell
from .answer import BAD_INPUT, as_json
from .done import DONE, finished, written
from .folder import Folder

FAILED = 1
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
        "mujoco.tuned. May be repeated.",
    )


@click.command()
@named_cases
@named_engines("book; ")
@click.option(
    "--settings",
    multiple=True,
    metavar="shipped|tuned|FILE",
    help="Only this setting; a FILE of your own engine options stands beside them, by its name. "
    "May be repeated.",
)
@click.option(
    "--causes",
    is_flag=True,
    help="Search for what cures each row above its tolerance: the smallest sets of options between "
    "shipped and tuned. It takes twice as long; `make reports` does so.",
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
    help="Write the trajectories too, one CSV a case, reference and engines side by side, one "
    "with the times of its events, and one long table of all poses (Parquet where pyarrow is).",
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
    no_cache: bool,
    cluster: str | None,
    wants_json: bool,
    allow_long: bool,
) -> None:
    """Compare engines with the reference and report the differences.

    A file with mistakes is left out: the other files run, and the exit code is 2.
    """
    from .. import keep as kept
    from .. import pool, suite, write
    from ..asking import asked
    from ..cache import store
    from ..cluster import executor
    from ..selection import sound_cases
    from ..show import cures, document, progress, terminal

    full = not (cases or names or settings)
    if out is None and full:
        out = Folder().convert(str(write.by_default()), None, None)
    if out is not None and keep is not None and out.resolve() == keep.resolve():
        raise click.UsageError("--out and --keep are one folder: a case may be called as a report")
    found, mistakes = sound_cases(cases, long=allow_long)
    wanted = asked(found, names, settings, mistakes=mistakes, named=bool(cases), long=allow_long)
    if wanted.mistakes:
        tell(_left_out(wanted.mistakes))
    for warning in wanted.warnings:
        tell(warning)
    used = None if no_cache else store.usable()
    with progress.progress() as told, executor(cluster) as working, finished(used is not None):
        report = suite.measure(
            wanted.cases,
            wanted.engines,
            jobs=jobs or pool.workers(),
            progress=told,
            book=wanted.book,
            causes=causes,
            store=used,
            executor=working,
        )
    mistakes = [*wanted.mistakes, *report.mistakes]
    if used is not None:
        used.trim()
    if full and mistakes:
        out = None  # what is left is no full run
    if out is not None:
        written(write.tables(report, report.cases), out)
    if keep is not None:
        kept.keep(report, keep)
        DONE.append(f"the trajectories are in {keep}")
    known = {**cures.committed(report.cases), **cures.found(report.causes)}
    code = BAD_INPUT if mistakes else FAILED if report.fails else 0
    if wants_json:
        document.write(document.of_run(report, mistakes, cures=known, written=out, exit_code=code))
    else:
        terminal.show(report, detailed=bool(cases), written=out, cures=known)
    if mistakes:
        tell(_left_out(mistakes))  # again: by now it has scrolled away
    raise click.exceptions.Exit(code)


def _left_out(mistakes: Sequence[Mistake]) -> str:
    files = len({mistake.file for mistake in mistakes})
    what = "1 file has mistakes and is" if files == 1 else f"{files} files have mistakes and are"
    return f"{CaseError(mistakes)}\n{what} left out"
