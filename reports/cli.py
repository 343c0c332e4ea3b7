"""The command `textmech`: run, check, list, show, bench."""

import signal
import sys
import warnings
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ..cases.mistake import CaseError, Mistake

if TYPE_CHECKING:
    from ..cases.case import Case
    from ..engines.engine import Engine
    from .suite import Report

FAILED, BAD_INPUT, INTERRUPTED = 1, 2, 130

allow_long = click.option(
    "--allow-long", is_flag=True, help="Do any amount of work, and not only what takes minutes."
)


def main() -> None:
    """The entry point."""
    signal.signal(signal.SIGTERM, _end)  # as Ctrl-C does: else the workers stay behind
    try:
        sys.exit(command(standalone_mode=False))  # an exit code, or None
    except click.ClickException as error:
        error.show()
        sys.exit(BAD_INPUT)
    except (click.Abort, KeyboardInterrupt):
        click.echo("\ninterrupted: nothing was written", err=True)
        sys.exit(INTERRUPTED)
    except CaseError as error:
        click.echo(str(error), err=True)
        count = len(error.mistakes)
        click.echo(f"{count} mistake{'s' if count > 1 else ''}; nothing was written", err=True)
        sys.exit(BAD_INPUT)


def _end(*_: object) -> None:
    raise KeyboardInterrupt


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
    type=click.Path(file_okay=False, writable=True, path_type=Path),
    help="Where to write the CSV files. A full run writes the committed reports of a checkout by "
    "default, and outside of one ./textmech-reports; a partial run writes nothing.",
)
@click.option(
    "--keep",
    type=click.Path(file_okay=False, path_type=Path),
    help="Write the trajectories too, one CSV a case, reference and engines side by side.",
)
@allow_long
def run(
    cases: tuple[str, ...],
    names: tuple[str, ...],
    settings: tuple[str, ...],
    jobs: int | None,
    out: Path | None,
    keep: Path | None,
    allow_long: bool,
) -> None:
    """Compare engines with the reference and report the differences.

    A file with mistakes is left out: the other files run, and the exit code is 2.
    """
    from . import keep as kept
    from . import pool, suite, write
    from .selection import choose_book, choose_engines, sound_cases
    from .show import terminal
    from .trial.work import too_long

    found, mistakes = sound_cases(cases, long=allow_long)
    with warnings.catch_warnings(record=True) as broken:
        engines = choose_engines(names, settings, long=allow_long)
    mistakes += too_long(found, engines)
    chosen = _sound(found, mistakes)
    if not chosen:
        raise CaseError(mistakes)
    if mistakes:
        click.echo(_left_out(mistakes), err=True)
    for warning in broken:
        click.echo(f"warning: {warning.message}", err=True)
    book = choose_book(names, settings)
    _answered(chosen, engines, book=book, named=bool(cases))
    for folder in (out, keep):
        if folder is not None:
            _prepare(folder)  # before the work, not after it
    with terminal.progress() as progress:
        measure = partial(
            suite.measure,
            engines=engines,
            jobs=jobs or pool.workers(),
            progress=progress,
            book=book,
        )
        report, unsolved = _each_for_itself(measure, chosen)
    mistakes += unsolved
    chosen = _sound(chosen, unsolved)
    if out is None and not (cases or names or settings or mistakes):
        out = write.by_default()
    if out is not None:
        write.write(write.tables(report, chosen), out)
    if keep is not None:
        kept.keep(report, keep)
    terminal.show(report, detailed=bool(cases), written=out)
    if mistakes:
        click.echo(_left_out(mistakes), err=True)  # again: by now it has scrolled away
        raise click.exceptions.Exit(BAD_INPUT)
    if report.fails:
        raise click.exceptions.Exit(FAILED)


def _sound(cases: "list[Case]", mistakes: list[Mistake]) -> "list[Case]":
    """The cases of the files without mistakes."""
    mistaken = {mistake.file for mistake in mistakes}
    return [case for case in cases if case.source.file not in mistaken]


def _each_for_itself(
    measure: "Callable[[list[Case]], Report]", cases: "list[Case]"
) -> "tuple[Report, list[Mistake]]":
    """The report, and the mistakes that only solving finds: they cost their own files.

    All of these are found at once, so what is left is measured in one more go.
    """
    try:
        return measure(cases), []
    except CaseError as error:
        left = _sound(cases, error.mistakes)
        if not left or left == cases:
            raise
        return measure(left), error.mistakes


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
        click.echo(f"no row for {', '.join(silent)}: {what}", err=True)


def _prepare(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise click.UsageError(f"cannot write to {folder}: {error.strerror}") from None


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
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an engine that is broken is no mistake of a case
        engines = choose_engines([], [])
    failed = False
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
            click.echo(f"{file}: {len(chosen)} case{'s' if len(chosen) > 1 else ''}, no mistakes")
        for check in broken:
            numbers = f"{check.difference:.2e} is above {check.bound:.1e}"
            click.echo(f"{file}: FAILS: the reference's {check.name}: {numbers}")
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
        click.echo(f"{case.name:{width}}  {case.title}\n{'':{width}}    {case.origin}")


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
    click.echo(script(chosen[0], engine), nl=False)


@command.command()
def bench() -> None:
    """What the adapters cost: ratios to the engines' bare loops, and to scipy's integrator."""
    from .show.bench import table

    for line in table():
        click.echo(line)


if __name__ == "__main__":
    main()
