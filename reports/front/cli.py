"""The command `textmech`: run, causes, advise, check, list, show, and what compares and shows."""

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
from .command.options import BAD_INPUT
from .command.page import page
from .command.plot import plot
from .command.run import run
from .command.show import show
from .command.versions import versions
from .show.console import prepare, tell
from .show.progress import aloud


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
    """Returns the exit code; None is 0 too."""
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
    a pymunk.Space, as `mygame:make_space`. To run, check, advise, show, plot and versions it may be
    a model of yours as well, robot.xml in MJCF or URDF; to run and check a folder of them too.

    \b
      textmech run                            all cases: regenerates reports/*.csv
      textmech run bar_pendulum               one case: prints its rows, writes nothing
      textmech run --settings mine.yaml       your own engine options beside them, as mine
      textmech causes bar_pendulum            why it is off, by experiment
      textmech advise bar_pendulum            which setting it needs, and what to paste
      textmech check my_case.yaml             all mistakes of a file, without running it
      textmech check robot.xml                an MJCF: its equations against the textbook's
      textmech run robot.xml                  its steps against its own equations
      textmech show robot.xml                 what it is, and how much of it is compared
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
command.add_command(show)
command.add_command(advise)
command.add_command(causes)
command.add_command(diff)
command.add_command(versions)
command.add_command(page)
command.add_command(plot)


if __name__ == "__main__":
    main()
