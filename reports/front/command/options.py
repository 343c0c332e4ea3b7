"""Arguments and options that several commands have, said in the same words."""

import atexit
import os
from collections.abc import Callable, Sequence
from contextlib import suppress
from functools import wraps
from math import isfinite
from pathlib import Path
from typing import Any

import click

from ....cases.mistake import CaseError, Mistake
from ...compare.trial.limit import choose
from ...tables.ownership import OVERWRITE

Decorated = Callable[[Any], Any]

named_cases = click.argument("cases", nargs=-1, metavar="[CASES]...")


MOST_JOBS = 1024
processes = click.option(
    "--jobs",
    type=click.IntRange(min=1, max=MOST_JOBS),
    help="Processes; as many as cores by default.",
)


class Finite(click.FloatRange):
    """A number in a range; nan, which compares with no bound, and inf are none."""

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Returns the number, or fails if it is out of range."""
        number = super().convert(value, param, ctx)
        if not isfinite(number):
            self.fail(f"{number} is no finite number", param, ctx)
        return number


def _chosen(context: click.Context, option: click.Parameter, seconds: float | None) -> None:
    try:
        choose(seconds)
    except ValueError as error:
        if str(error).startswith("$"):  # of the environment
            raise click.UsageError(str(error), context) from None
        raise click.BadParameter(str(error), context, option) from None


def jobs(command: Any) -> Any:
    """How the work is spread over processes, and how long one of them may take for a task."""
    decorated = click.option(
        "--time-limit",
        type=Finite(min=0, min_open=True),
        expose_value=False,
        callback=_chosen,
        metavar="S",
        help="How long an engine may take for one run, beyond ten times what its steps are worth; "
        "120 s by default, or $TEXTMECH_TIME_LIMIT.",
    )(command)
    return processes(decorated)


no_cache = click.option(
    "--no-cache",
    is_flag=True,
    help="Compute everything anew. Else results lie in $TEXTMECH_CACHE, by default the cache of "
    "the user (~/.cache/textmech), and are used while nothing they depend on has changed.",
)
overwrite = click.option(
    f"--{OVERWRITE}",
    is_flag=True,
    help="Overwrite files of the names that are written there which textmech did not write.",
)
allow_long = click.option(
    "--allow-long", is_flag=True, help="Do any amount of work, and not only what takes minutes."
)


def named_engines(beside: str = "") -> Decorated:
    """The option that chooses engines; beside: what else it takes."""
    return click.option(
        "--engine",
        "names",
        multiple=True,
        metavar="E",
        help=f"An installed engine, as mujoco, pymunk; {beside}or with its setting, as "
        "mujoco.tuned. May be repeated.",
    )


def own_settings(becomes: str = "stands beside them, by its name") -> Decorated:
    """The option for one setting alone; becomes: what a file of own options does."""
    return click.option(
        "--settings",
        multiple=True,
        metavar="shipped|recommended|tuned|FILE",
        help=f"Only this setting; a FILE of your own engine options {becomes}. May be repeated.",
    )


# The option `--json`: a command answers with one document, whatever becomes of it.


FAILED = 1
BAD_INPUT = 2


def as_json(command: Callable[..., None]) -> Callable[..., None]:
    """Adds the option, as `wants_json`; mistakes that end the command are its document then."""

    @wraps(command)
    def answered(*args: Any, wants_json: bool, **kwargs: Any) -> None:
        try:
            command(*args, wants_json=wants_json, **kwargs)
        except (CaseError, click.ClickException, OSError) as error:
            if not wants_json or isinstance(error, BrokenPipeError | click.UsageError):
                raise  # a wrong option is told in words, as where it is none of ours
            from ..show import console, document

            if console.gone():
                raise  # it is the output itself: the reason goes where somebody may read it

            mistakes = document.mistakes(_mistakes(error))
            document.write({"mistakes": mistakes, "exit_code": BAD_INPUT})
            raise click.exceptions.Exit(BAD_INPUT) from None

    what = "Print one JSON document, for scripts."
    return click.option("--json", "wants_json", is_flag=True, help=what)(answered)


def _mistakes(error: CaseError | click.ClickException | OSError) -> Sequence[Mistake]:
    if isinstance(error, CaseError):
        return error.mistakes
    if isinstance(error, OSError):
        return [Mistake(str(error.filename or ""), 0, 0, "", error.strerror or str(error))]
    return [Mistake("", 0, 0, "", error.format_message())]


# A folder that is named on the command line.


class Folder(click.Path):
    """A folder to write into, by a name that is not empty."""

    def __init__(self) -> None:
        super().__init__(file_okay=False, path_type=Path)

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """The folder, made where there was none: before the work, not after it."""
        if not value:
            self.fail("the folder's name is empty; the current one is '.'", param, ctx)
        folder = Path(str(super().convert(value, param, ctx)))
        missing = [each for each in (folder, *folder.parents) if not os.path.lexists(each)]
        atexit.register(_unmade, missing)
        try:
            folder.mkdir(parents=True, exist_ok=True)
            _try_writing(folder)
        except OSError as error:
            self.fail(f"cannot write to {folder}: {error.strerror}", param, ctx)
        return folder


def _unmade(folders: Sequence[Path]) -> None:
    """Removes the empty folders that a refused command made, the innermost first."""
    with suppress(OSError):
        for folder in folders:
            folder.rmdir()


def _try_writing(folder: Path) -> None:
    """Checks a folder for writing: makes a folder in it and removes it. Raises OSError."""
    probe = f"{folder}{os.sep}.writing-{os.getpid()}"
    try:
        os.mkdir(probe)
    finally:
        # Not by `suppress`: an interruption may come where that is entered.
        try:  # noqa: SIM105
            os.rmdir(probe)
        except OSError:  # it was never made, or another run has swept it
            pass
