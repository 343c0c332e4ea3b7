"""steps.csv: which steps a ladder has.

Its errors are not compared: the judged step's is in tolerance.csv, and what the others say together
is in convergence.csv.
"""

from .change import Change, Place, Seen
from .file import File, column, number
from .rule import Rule
from .table import Row


def place(row: Row) -> Place:
    """The quantity of a case in an engine, at a step of one of its ladders."""
    what = f"{row['quantity']} ({row['ladder']}, h = {row['step']} s)"
    return Place(row["case"], column(row), what)


def seen(row: Row) -> Seen:
    """The error."""
    return Seen("", number(row, "error"))


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """Nothing: a step that both have is no difference."""
    return None


STEPS = File(
    name="steps.csv",
    keys=("case", "engine", "setting", "realised", "ladder", "quantity", "step"),
    numbers=("error",),
    words=(),
    compare=compared,
    place=place,
    seen=seen,
)
