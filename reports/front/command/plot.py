"""`textmech plot`."""

from pathlib import Path
from typing import TYPE_CHECKING

import click

from ....cases.mistake import CaseError, nearest, plain
from ...tables.row import FAILS
from ..show.console import say
from .done import DONE
from .looking import looked_at, named
from .options import allow_long, named_engines, overwrite

if TYPE_CHECKING:
    from ...runs.request import Request
    from ...runs.suite import Report

KINDS = (".png", ".svg")


@click.command()
@click.argument("case")
@click.option("--quantity", metavar="Q", help="As the case names it; by default the worst one.")
@named_engines()
@click.option(
    "-o",
    "--out",
    "file",
    type=click.Path(dir_okay=False, path_type=Path),
    required=True,
    metavar="FILE",
    help="Where to draw it: a .png, or an .svg with text that stays text.",
)
@overwrite
@allow_long
def plot(
    case: str,
    quantity: str | None,
    names: tuple[str, ...],
    file: Path,
    overwrite: bool,
    allow_long: bool,
) -> None:
    """One case as a picture: its mechanism, a quantity in its tube, its error, its ladder.

    Of a model, an MJCF or URDF file, the right motion is its own equations' limit for h → 0.

    \b
      textmech plot four_bar -o four_bar.png
      textmech plot my_case.yaml --quantity rod.angle --engine mujoco -o rod.svg
      textmech plot robot.xml -o robot.png
    """
    if file.suffix.lower() not in KINDS:
        raise click.UsageError(f"{file.name} is no picture that can be drawn: {' or '.join(KINDS)}")
    if not file.parent.is_dir():
        raise click.UsageError(f"there is no folder {file.parent}")
    from ...tables.ownership import unasked
    from ..page.motions import motions
    from ..page.paint import save
    from ..page.picture import picture

    unasked(file.parent, [file.name], overwrite=overwrite)
    request = _request_of(case, names, allow_long)
    report = looked_at(request)
    if report.mistakes:
        raise CaseError(report.mistakes)
    name = next(iter([*report.cases, *(model.case for model in report.models)])).name
    motion = motions(report).get(name)
    if motion is None:
        why = next((model.because for model in report.models), "")
        still = plain(f": {why}") if why else " is a claim about states: nothing moves"
        raise click.UsageError(f"{plain(name)}{still}")
    chosen = _quantity(quantity, report)
    rows = report.comparisons, report.rungs, report.steps
    save(picture(name, chosen, motion, *rows), file)
    DONE.append(f"the picture is {file}")
    say(f"written to {file}: {plain(chosen)}")
    if until := motion["curves"].get("until"):
        say(f"later than {until:.3g} s nothing is judged")
    if failing := next((row.because for row in report.comparisons if row.verdict == FAILS), None):
        say(f"FAILS: {failing}")


def _request_of(case: str, engines: tuple[str, ...], long: bool) -> "Request":
    """Returns what is asked of the one case or model. Raises click.UsageError of several."""
    request = named([case], engines, long=long)
    chosen = [*request.cases, *request.models]
    if len(chosen) > 1:
        names = ", ".join(plain(engine.name) for engine in chosen)
        what = "is a folder of models" if Path(case).is_dir() else "has variants"
        raise click.UsageError(f"{case} {what}; plot one of: {names}")
    return request


def _quantity(asked: str | None, report: "Report") -> str:
    """Returns the quantity that was asked for, or without one the worst.

    Raises click.UsageError where the case does not observe it.
    """
    rows = [row for row in report.comparisons if row.quantity != "audit"]
    known = list(dict.fromkeys(row.quantity for row in rows))
    if asked is None:
        return max(rows, key=lambda row: row.ratio or 0.0).quantity
    if asked not in known:
        hint = nearest(asked, known) or f"; it observes {', '.join(known)}"
        raise click.UsageError(f"no such quantity in this case: {asked}{hint}")
    return asked
