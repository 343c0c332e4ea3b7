"""The command `textmech`: run, causes, advise, check, list, show, bench."""

import sys
import warnings

import click

from ..cases.mistake import CaseError, Mistake
from . import ending
from .command.advise import advise
from .command.bench import bench
from .command.causes import causes
from .command.done import done
from .command.run import BAD_INPUT, FAILED, allow_long, run
from .show.say import prepare, say, tell


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
        tell(f"\ninterrupted: {done()}")
        sys.exit(ending.INTERRUPTED)
    except CaseError as error:
        tell(str(error))
        count = len(error.mistakes)
        tell(f"{count} mistake{'s' if count > 1 else ''}; {done()}")
        sys.exit(BAD_INPUT)
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        tell(f"Error: {where}{error.strerror or error}; {done()}")
        sys.exit(BAD_INPUT)


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
      textmech causes bar_pendulum            why it is off, by experiment
      textmech advise bar_pendulum            which setting it needs, and what to paste
      textmech check my_case.yaml             all mistakes of a file, without running it
      textmech show bar_pendulum --engine mujoco.tuned > pendulum.xml

    \b
    Exit codes:
      0    all is as expected; findings (`beyond`) are no failures
      1    a verdict FAILS
      2    a mistake in the command or in a file, which is left out; the other files run
      130  interrupted
    """


command.add_command(run)
command.add_command(bench)
command.add_command(advise)
command.add_command(causes)


@command.command()
@click.argument("files", nargs=-1, required=True, metavar="FILE...")
@allow_long
def check(files: tuple[str, ...], allow_long: bool) -> None:
    """All mistakes of case files, without running an engine."""
    from ..reference.solve import solve
    from .events.states import mistaken
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
            for mistake in mistaken(case, solution.trajectory)
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


if __name__ == "__main__":
    main()
