"""Which release moved which number, on a terminal: a line for each release, and a table."""

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby

from ..output.diff.columns import ERRORS, Row, number
from ..output.diff.compare import Change, Place, place
from ..output.diff.forms import fitted
from .release import Release
from .table import Step

MOST = 40  # rows of a table; the CSV has them all
NONE = "–"


def text(steps: Sequence[Step], width: int) -> str:
    """By engine."""
    lines: list[str] = []
    for engine, some in groupby(sorted(steps, key=_engine), key=_engine):
        its = [*some]
        told = [line for i, step in enumerate(its) for line in _told(step, its[i - 1 : i])]
        lines += ["", engine, *(part for line in told for part in fitted(line, width))]
        lines += _table(its, width)
    return "\n".join(lines[1:])


def _engine(step: Step) -> str:
    return step.now.release.engine


def _told(step: Step, before: Sequence[Step]) -> Iterator[str]:
    """How many numbers a release gave, how many moved, and what the one before did not lack."""
    version = step.now.release.version
    if not step.now.folder:
        yield f"  {version}: {step.now.verdict}: {step.now.because}"
        return
    measured = sum(row["error"] != "" for row in step.rows)
    moved = f", {len(_numbers(step))} moved since {step.before.version}" if step.before else ""
    yield f"  {version}: {measured} number{'' if measured == 1 else 's'}{moved}"
    known = {why for one in before for why in _lacking(one)}
    for why, count in _lacking(step).items():
        if why not in known:
            yield f"    {count} without: {why}"


def _lacking(step: Step) -> Mapping[str, int]:
    """Why it has no number, and of how many rows."""
    lacking = (row for row in step.rows if not row["error"])
    return Counter(": ".join(filter(None, (row["verdict"], row["because"]))) for row in lacking)


def _numbers(step: Step) -> list[Change]:
    """Returns the changes where both releases have a number."""
    return [
        change
        for change in step.changes
        if change.was and change.now and None not in (change.was.number, change.now.number)
    ]


def _table(steps: Sequence[Step], width: int) -> Iterator[str]:
    """Quantities by releases, as many as fit: a release that moved nothing is as its left one."""
    moved = {s.now.release: {change.place for change in _numbers(s)} for s in steps}
    places = sorted({place for found in moved.values() for place in found}, key=_sorted)
    if not places:
        return
    shown = [step for step in steps if step.now.folder]
    lines = _lines(shown, places[:MOST], moved)
    if max(map(len, lines)) > width:
        lines = _lines(
            [s for s in shown if moved[s.now.release] or s is shown[0]], places[:MOST], moved
        )
    yield ""
    yield from lines
    if len(places) > MOST:
        yield f"  and {len(places) - MOST} more"


def _sorted(place: Place) -> tuple[str, str, str]:
    return place.case, place.column, place.what


def _lines(
    steps: Sequence[Step], places: Sequence[Place], moved: Mapping[Release, set[Place]]
) -> list[str]:
    versions = [step.now.release.version for step in steps]
    cells = {p: [_cell(step, p, p in moved[step.now.release]) for step in steps] for p in places}
    widths = [max(map(len, column)) for column in zip(versions, *cells.values(), strict=True)]
    names = {p: f"    {p.what} {_unit(steps, p)}" for p in places}
    name = max(map(len, names.values()))
    lines = [_line(f"{'* moved':{name}}", versions, widths)]
    for (case, column), some in groupby(places, key=lambda p: (p.case, p.column)):
        lines.append(f"  {case} {column}")
        lines += [_line(f"{names[p]:{name}}", cells[p], widths) for p in some]
    return lines


def _line(name: str, cells: Sequence[str], widths: Sequence[int]) -> str:
    told = (f"{cell:>{width}}" for cell, width in zip(cells, widths, strict=True))
    return "  ".join([name, *told])


def _cell(step: Step, where: Place, moved: bool) -> str:
    row = _row(step, where)
    error = None if row is None else number(row, "error")
    return NONE if error is None else f"{'*' if moved else ''}{error:.2g}"


def _unit(steps: Sequence[Step], where: Place) -> str:
    return next(row["unit"] for step in steps if (row := _row(step, where)) is not None)


def _row(step: Step, where: Place) -> Row | None:
    return next((row for row in step.rows if place(ERRORS, row) == where), None)
