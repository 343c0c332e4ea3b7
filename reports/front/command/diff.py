"""`textmech diff`."""

import math
import shutil
from pathlib import Path
from typing import Any

import click

from ..show.console import say
from .options import FAILED, as_json

COMMITTED = Path(__file__).parents[2]


class Number(click.ParamType):
    """A finite number of at least `least`."""

    name = "number"

    def __init__(self, least: float = 0.0) -> None:
        self.least = least

    def convert(self, value: Any, param: click.Parameter | None, ctx: click.Context | None) -> Any:
        """Raises click.BadParameter."""
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        if not self.least <= number < math.inf:
            self.fail(f"should be a number of at least {self.least:g}, is {value!r}", param, ctx)
        return number


@click.command()
@click.argument("folders", nargs=-1, type=click.Path(path_type=Path), metavar="[OLD] NEW")
@click.option("--markdown", "wants_markdown", is_flag=True, help="For a pull request.")
@click.option(
    "--all", "every", is_flag=True, help="Every change, and not the first thirty of a kind."
)
@click.option(
    "--whole",
    is_flag=True,
    help="Both are full runs: a case or an engine of one folder alone is lost or new. Else it is "
    "counted, and not looked at.",
)
@click.option(
    "--moved",
    type=Number(),
    default=0.011,
    show_default=True,
    help="The part of itself by which a number must change.",
)
@click.option(
    "--floor",
    type=Number(),
    default=1e-6,
    show_default=True,
    help="The part of what is allowed by which it must change too.",
)
@click.option(
    "--worse",
    type=Number(1.0),
    default=1.5,
    show_default=True,
    help="The factor by which an error must grow to be a regression, though its verdict stays.",
)
@click.option(
    "--matters",
    type=Number(),
    default=1e-3,
    show_default=True,
    help="The part of what is allowed above which a grown error is one.",
)
@as_json
def diff(
    folders: tuple[Path, ...],
    wants_json: bool,
    wants_markdown: bool,
    every: bool,
    whole: bool,
    **thresholds: float,
) -> None:
    """What changed between two report folders, and whether it got worse.

    Of one folder: since the committed reports.

    A row has changed if its verdict did, or if its error moved by more than rounding can: by more
    than --moved of itself and --floor of what is allowed, so that the same code on another machine
    shows no change. It is a regression if the verdict is worse, if the error grew by more than
    --worse, if a step is not usable any more, if a row that judged a number is gone, or if
    a reference's check fails or an equation is not covered any more.

    Folders may be of partial runs: their common cases and engines are compared.

    \b
      textmech run --out mine && textmech diff mine     my engine beside the committed reports
      textmech diff before after --markdown             two runs, for a pull request

    \b
    Exit codes: 0 no regression, 1 a regression, 2 a folder that is no report, or a mixed one
    """
    from ...tables.diff.columns import Rule
    from ...tables.diff.compare import difference
    from ...tables.diff.folder import opened
    from ...tables.diff.forms import as_json as document
    from ...tables.diff.forms import markdown, text

    if wants_json and wants_markdown:
        raise click.UsageError("--json or --markdown, please: both are one document")
    if not 1 <= len(folders) <= 2:
        raise click.UsageError(f"one folder or two, please: {len(folders)} are named")
    old, new = folders if len(folders) == 2 else (COMMITTED, *folders)
    if old.resolve() == new.resolve():
        raise click.UsageError(f"{old} and {new} are one folder: nothing can be compared")
    named = {str(old) if len(folders) == 2 else "the committed reports": old, str(new): new}
    before, after = opened(named)
    compared = difference(before, after, Rule(**thresholds), whole=whole)
    if wants_json:
        say(document(compared))
    elif wants_markdown:
        say(markdown(compared, every=every))
    else:
        say(text(compared, width=shutil.get_terminal_size().columns, every=every))
    if compared.regressed:
        raise click.exceptions.Exit(FAILED)
