"""The command `textmech`: run, check, list, show, bench."""

import sys
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import click

from ..cases.mistake import CaseError, Mistake
from . import ending
from .show.say import prepare, say, tell

if TYPE_CHECKING:
    import pandas as pd

    from ..cases.case import Case
    from ..engines.engine import Engine

FAILED, BAD_INPUT = 1, 2
_DONE: list[str] = []  # what was written and kept so far: said if the rest is not

allow_long = click.option(
    "--allow-long", is_flag=True, help="Do any amount of work, and not only what takes minutes."
)


def main() -> None:
    """The entry point."""
    ending.listen()
    prepare()
    try:
        sys.exit(command(standalone_mode=False))  # an exit code, or None
    except click.ClickException as error:
        tell(f"Error: {error.format_message()}")
        sys.exit(BAD_INPUT)
    except (click.Abort, KeyboardInterrupt):
        tell(f"\ninterrupted: {_done()}")
        sys.exit(ending.INTERRUPTED)
    except CaseError as error:
        tell(str(error))
        count = len(error.mistakes)
        tell(f"{count} mistake{'s' if count > 1 else ''}; {_done()}")
        sys.exit(BAD_INPUT)
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        tell(f"Error: {where}{error.strerror or error}; {_done()}")
        sys.exit(BAD_INPUT)


def _done() -> str:
    return "; ".join(_DONE) or "nothing was written"


@contextmanager
def _kept(stored: bool) -> Iterator[None]:
    try:
        yield
    except KeyboardInterrupt:
        if stored:
            _DONE.append("nothing was written, but what was finished is kept for the next run")
        raise


def _write(frames: "Mapping[str, pd.DataFrame]", out: Path) -> None:
    """Notes that they are there, if they are: an interruption may come after the last of them."""
    from . import write

    try:
        write.write(frames, out)
    finally:
        if write.holds(frames, out):
            _DONE.append(f"the reports are in {out}")


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


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="textmech")
def command() -> None:
    """Measures physics engines against textbook mechanics.

    A CASE is the name of a shipped case (`textmech list`), one of its variants
    (`rolling_wheel.pushed`), or the path of a YAML file anywhere.

    \b
      textmech run                            all cases: regenerates reports/*.csv
      textmech run bar_pendulum               one case: prints its rows, writes nothing
      textmech run --settings mine.yaml       your own engine options as a further column, mine
      textmech check my_case.yaml             all mistakes of a file, without running it
      textmech show bar_pendulum --engine mujoco.tuned > pendulum.xml

    \b
    Exit codes:
      0    all is as expected; findings (`beyond`) are no failures
      1    a verdict FAILS
      2    a mistake in the command or in a file, which is left out; the other files run
      130  interrupted
    """


@command.command()
@click.argument("cases", nargs=-1, metavar="[CASES]...")
@click.option(
    "--engine",
    "names",
    multiple=True,
    metavar="E",
    help="An installed engine, as mujoco, pymunk; book; or with its setting, as mujoco.tuned.",
)
@click.option(
    "--settings",
    multiple=True,
    metavar="shipped|tuned|FILE",
    help="Only this setting; a FILE of your own engine options is a further column, with its name. "
    "May be repeated.",
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
    from . import keep as kept
    from . import pool, suite, write
    from .cache import store
    from .cluster import executor
    from .selection import choose_book, choose_engines, sound, sound_cases
    from .show import terminal
    from .trial.work import too_long

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
    with terminal.progress() as progress, executor(cluster) as working, _kept(used is not None):
        report = suite.measure(
            chosen,
            engines,
            jobs=jobs or pool.workers(),
            progress=progress,
            book=book,
            store=used,
            executor=working,
        )
    mistakes += report.mistakes
    if used is not None:
        used.trim()
    if full and mistakes:
        out = None  # what is left is no full run
    if out is not None:
        _write(write.tables(report, report.cases), out)
    if keep is not None:
        kept.keep(report, keep)
        _DONE.append(f"the trajectories are in {keep}")
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
    from .trial.book import producers

    silent = [case.name for case in cases if not producers(case, engines, book=book)]
    what = "the book approximates dry friction alone, in Examples 2.3 and 2.4"
    if len(silent) == len(cases):
        raise click.UsageError(f"no row for {', '.join(silent)}: {what}")
    if named and silent:
        tell(f"no row for {', '.join(silent)}: {what}")


@command.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@allow_long
def check(files: tuple[str, ...], allow_long: bool) -> None:
    """All mistakes of case files, without running an engine."""
    from ..reference.solve import solve
    from .events.times import never
    from .selection import choose_cases, choose_engines
    from .trial.work import too_long

    mistakes: list[Mistake] = []
    failed = False
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an engine that is broken is no mistake of a case
        engines = choose_engines([], [])
    for file in files:
        try:
            chosen = choose_cases([file], long=allow_long)
            if long := too_long(chosen, engines):
                raise CaseError(long)
            solutions = [solve(case) for case in chosen]
        except CaseError as error:
            mistakes += error.mistakes
            continue
        found = [
            mistake
            for case, solution in zip(chosen, solutions, strict=True)
            for mistake in never(case, solution.trajectory)
        ]
        mistakes += found
        broken = [check for solution in solutions for check in solution.checks if not check.holds]
        if not found and not broken:
            say(f"{file}: {len(chosen)} case{'s' if len(chosen) > 1 else ''}, no mistakes")
        for check in broken:
            numbers = f"{check.difference:.2e} is above {check.bound:.1e}"
            say(f"{file}: FAILS: the reference's {check.name}: {numbers}")
        failed = failed or bool(broken)
    if mistakes:
        raise CaseError(mistakes)
    if failed:
        raise click.exceptions.Exit(FAILED)


@command.command("list")
def list_() -> None:
    """The shipped cases, with their sources and titles."""
    from .selection import choose_cases

    cases = choose_cases([], known=None)
    width = max(len(case.name) for case in cases)
    for case in cases:
        say(f"{case.name:{width}}  {case.title}\n{'':{width}}    {case.origin}")


@command.command()
@click.argument("case")
@click.option(
    "--engine",
    "name",
    required=True,
    metavar="E",
    help="An engine, or engine.setting.",
)
@allow_long
def show(case: str, name: str, allow_long: bool) -> None:
    """The scene as the engine's own file or script, with the settings and their reasons."""
    from .selection import choose_cases, choose_engines
    from .show.script import script

    chosen = choose_cases([case], long=allow_long)
    if len(chosen) > 1:
        names = ", ".join(c.name for c in chosen)
        raise click.UsageError(f"{case} has variants; show one of: {names}")
    engines = choose_engines([name], [])
    if not engines:
        raise click.UsageError(f"{name} is no engine, and has no file of its own")
    # Of a bare name the tuned setting, or what else the engine offers.
    engine = next((e for e in engines if e.setting == "tuned"), engines[0])
    say(script(chosen[0], engine), nl=False)


@command.command()
def bench() -> None:
    """What the adapters cost: ratios to the engines' bare loops, and to scipy's integrator."""
    from .show.bench import table

    for line in table():
        say(line)


if __name__ == "__main__":
    main()
