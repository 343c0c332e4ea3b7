"""coverage.csv: whether each item of the chapter is still covered by the cases of both runs."""

from .change import WORSE, Change, Place, Seen
from .file import File
from .rule import Rule
from .scope import Scope
from .table import Row


def place(row: Row) -> Place:
    """`equation (2.10)`, of no case and no engine."""
    return Place("", "coverage", f"{row['kind']} {row['number']}")


def seen(row: Row) -> Seen:
    """The cases that cover it, or what else does."""
    return Seen(row["cases"] or row["otherwise"])


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """An item that nothing covers any more. Which of many cases do is of no matter."""
    was, now = seen(old), seen(new)
    if not was.words or now.words:
        return None
    return Change(WORSE, COVERED.name, place(new), was, now, note="not covered any more")


def within(row: Row, scope: Scope) -> Row:
    """Returns the row with those of its cases that both runs have."""
    names = [name for name in row["cases"].split() if name in scope.cases]
    return {**row, "cases": " ".join(names)}


COVERED = File(
    name="coverage.csv",
    keys=("kind", "number"),
    numbers=(),
    words=("cases", "otherwise"),
    compare=compared,
    place=place,
    seen=seen,
    within=within,
)
