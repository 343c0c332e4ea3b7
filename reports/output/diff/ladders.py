"""convergence.csv: up to which step a quantity is usable, and what its ladder shows.

Digits of order and limit are not compared, for they are rounding's where an error is small.
"""

from ...data.row import OF_A_LADDER
from .change import BETTER, CHANGED, WORSE, Change, Place, Seen
from .file import File, column, number
from .rule import Rule
from .table import Row


def place(row: Row) -> Place:
    """The quantity of a case in an engine, on one of its ladders."""
    return Place(row["case"], column(row), f"{row['quantity']} ({row['ladder']})")


def seen(row: Row) -> Seen:
    """Returns the verdict on a ladder of steps, and its usable step [s]."""
    return Seen(row["verdict"], number(row, "usable_step"))


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """Another usable step; or other words, where they do not depend on rounding."""
    was, now = seen(old), seen(new)
    unsure = [number(row, "uncertainty") or 0.0 for row in (old, new)]
    words = was.words != now.words and max(unsure) > rule.floor * (allowed or 0.0)
    steps = rule.differ(was.number, now.number, None)
    if not (words or steps):
        return None
    kind = CHANGED
    if steps:
        kind = WORSE if (now.number or 0.0) < (was.number or 0.0) else BETTER
    return Change(kind, LADDERS.name, place(new), was, now, "s", label="usable step")


LADDERS = File(
    name="convergence.csv",
    keys=("case", "engine", "setting", "realised", "ladder", "quantity"),
    numbers=("uncertainty", "usable_step"),
    words=("verdict",),
    compare=compared,
    place=place,
    seen=seen,
    verdicts=lambda word: word in OF_A_LADDER,
)
