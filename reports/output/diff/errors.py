"""tolerance.csv: each quantity's largest error, and the verdict on it."""

from ...data.row import FAILS, LADDER, rank
from .change import BETTER, CHANGED, LOST, NEW, WORSE, Change, Place, Seen
from .file import File, arrow, column, number
from .rule import Rule, factor
from .table import Row

MEASURED = LADDER.index("refused")
"""Verdicts below this rank judge a number: who loses one knows less than before."""


def place(row: Row) -> Place:
    """The quantity of a case in an engine."""
    return Place(row["case"], column(row), row["quantity"])


def seen(row: Row) -> Seen:
    """The verdict and the largest error."""
    return Seen(row["verdict"], number(row, "error"))


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """A verdict that changed, an error that moved, or another question."""
    was, now = seen(old), seen(new)
    unit, bar = (arrow(name, old[name], new[name]) for name in ("unit", "allowed"))
    step = arrow("step", old["step"], new["step"]) if old["step"] and new["step"] else ""
    asked = unit or bar  # another question
    moved = not unit and rule.differ(was.number, now.number, allowed)
    if not (moved or asked or was.words != now.words):
        return None
    return Change(
        kind=_kind(was, now, rule, allowed) if moved or was.words != now.words else CHANGED,
        file=ERRORS.name,
        place=place(new),
        was=was,
        now=now,
        unit=new["unit"],
        allowed=allowed,
        times=factor(was.number, now.number) if moved else None,
        note=", ".join(filter(None, (unit, bar, step))),
    )


def _kind(was: Seen, now: Seen, rule: Rule, allowed: float | None) -> str:
    before, after = rank(was.words), rank(now.words)
    if after != before:
        return WORSE if after > before else BETTER
    numbers = was.number, now.number, allowed
    if not rule.differ(*numbers):
        return CHANGED
    if rule.grown(*numbers):
        return WORSE
    return BETTER if rule.shrunk(*numbers) else CHANGED


ERRORS = File(
    name="tolerance.csv",
    keys=("case", "engine", "setting", "realised", "quantity"),
    numbers=("step", "error", "allowed"),
    words=("version", "unit", "verdict"),
    compare=compared,
    place=place,
    seen=seen,
    lost=lambda row: WORSE if rank(row["verdict"]) < MEASURED else LOST,
    new=lambda row: WORSE if rank(row["verdict"]) == rank(FAILS) else NEW,
    verdicts=lambda word: rank(word) < len(LADDER),
)
