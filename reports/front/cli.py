"""The command `textmech`: run, causes, advise, check, list, show, and what compares and shows."""

from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

import click

from ...cases.mistake import CaseError
from ..runs.processes import termination as ending
from .command.advise import advise
from .command.causes import causes
from .command.check import check
from .command.check_engine import check_engine
from .command.diff import diff
from .command.done import done
from .command.list import list_
from .command.options import BAD_INPUT, allow_long
from .command.page import page
from .command.plot import plot
from .command.run import run
from .command.versions import versions
from .show.console import prepare, say, tell
from .show.progress import aloud

if TYPE_CHECKING:
    from ...cases.case import Case
    from ...engines.engine import Engine


def main() -> None:
    """The entry point."""
    ending.listen()
    prepare()
    try:
        with aloud():
            code = _answered()
        ending.ignore_signals()
    except (click.Abort, KeyboardInterrupt):
        tell(f"\ninterrupted: {done()}")
        code = ending.INTERRUPTED
    ending.end(code)


def _answered() -> int | None:
    """The exit code; None is 0 too."""
    try:
        return command(prog_name="textmech", standalone_mode=False)
    except click.exceptions.NoArgsIsHelpError as error:
        tell(error.format_message())
    except click.ClickException as error:
        tell(f"Error: {error.format_message()}")
    except CaseError as error:
        tell(str(error))
        count = len(error.mistakes)
        tell(f"{count} mistake{'s' if count > 1 else ''}; {done()}")
    except OSError as error:
        where = f"{error.filename}: " if error.filename else ""
        tell(f"Error: {where}{error.strerror or error}; {done()}")
    return BAD_INPUT


@click.group(context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100})
@click.version_option(package_name="textmech")
def command() -> None:
    """Measures physics engines against textbook mechanics.

    A CASE is the name of a shipped case (`textmech list`), one of its variants
    (`rolling_wheel.pushed`), the path of a YAML file anywhere, or the function of yours that makes
    a pymunk.Space, as `mygame:make_space`.

    \b
      textmech run                            all cases: regenerates reports/*.csv
      textmech run bar_pendulum               one case: prints its rows, writes nothing
      textmech run --settings mine.yaml       your own engine options beside them, as mine
      textmech causes bar_pendulum            why it is off, by experiment
      textmech advise bar_pendulum            which setting it needs, and what to paste
      textmech check my_case.yaml             all mistakes of a file, without running it
      textmech check robot.xml                an MJCF: its equations against the textbook's
      textmech run robot.xml                  its steps against its own equations
      textmech show bar_pendulum --engine mujoco.tuned > pendulum.xml
      textmech diff before after              what changed between two report folders
      textmech versions pymunk==7.0.1 pymunk==7.3.1     and between releases of an engine
      textmech check-engine toy               an adapter of your own, from the easiest on

    \b
    Exit codes:
      0    all is as expected; findings (`beyond`) are no failures
      1    of run and check a verdict FAILS; of diff something got worse; of check-engine a mistake
      2    a mistake in the command or in a file, which is left out; the other files run
      130  interrupted
    """


command.add_command(run)
command.add_command(check)
command.add_command(check_engine)
command.add_command(list_)
command.add_command(advise)
command.add_command(causes)
command.add_command(diff)
command.add_command(versions)
command.add_command(page)
command.add_command(plot)


@command.command(short_help="A scene as the engine's own file or script, with reasons.")
@click.argument("case")
@click.option(
    "--engine",
    "name",
    required=True,
    metavar="E",
    help="An engine's setting, as mujoco.shipped; of an engine alone its tuned one.",
)
@click.option(
    "--settings",
    metavar="FILE",
    help="Your own options in place of that, as `textmech advise` prints them.",
)
@allow_long
def show(case: str, name: str, settings: str | None, allow_long: bool) -> None:
    """The scene as the engine's own file or script, with the settings and their reasons.

    \b
      textmech show four_bar --engine pymunk > four_bar.py
      textmech show four_bar --engine mujoco --settings mine.yaml > four_bar.xml
    """
    from functools import partial

    from ...engines import Known, foreign
    from ...engines.probe import apart, guarded
    from ..compare.trial.limit import limit
    from ..compare.trial.table_text import why
    from ..runs.selection import choose_cases, choose_engines
    from .show.script import script

    known = Known([name.partition(".")[0]])  # no other is imported
    chosen = choose_cases([case], known=known, long=allow_long)
    if len(chosen) > 1:
        names = ", ".join(c.name for c in chosen)
        raise click.UsageError(f"{case} has variants; show one of: {names}")
    engines = choose_engines([name], [settings] if settings else [])
    if not engines:
        raise click.UsageError(f"{name} is no engine, and has no file of its own")
    # Of a bare name the tuned setting, or what else the engine offers.
    wanted = Path(settings).stem if settings else "tuned"
    engine = next((e for e in engines if e.setting == wanted), None if settings else engines[0])
    if engine is None:
        raise click.UsageError(f"{settings} holds no options of {name}")
    if foreign(engine.name):  # which may end its process, or never answer
        _, lost = apart(_shows, chosen[0], engine, most=limit())
        if lost:
            raise click.ClickException(f"{name} has no file to show: {lost}")
    text, error = guarded(partial(script, chosen[0], engine))
    if isinstance(error, CaseError | click.ClickException):
        raise error
    if error is not None:
        raise click.ClickException(f"{name} has no file to show: {why(error)}")
    if not isinstance(text, str):
        raise click.ClickException(f"{name} gives no text to show: a {type(text).__name__}")
    say(text, nl=False)


def _shows(case: "Case", engine: "Engine") -> None:
    """Asks for the file, in a process of its own; what it raises is asked for once more."""
    from .show.script import script

    with suppress(Exception):
        script(case, engine)


if __name__ == "__main__":
    main()
