"""events.csv: when each event happens. Whether that is right, tolerance.csv judges."""

from math import floor, isfinite, log10

from .change import CHANGED, Change, Place, Seen
from .file import File, column, number
from .rule import Rule
from .table import Row

LEAST = 1e-9  # s: below it a time is rounding's
DIGITS = 9  # of a time as it is written


def place(row: Row) -> Place:
    """The k-th time of an event."""
    return Place(row["case"], column(row), f"{row['event']} {row['k']}")


def seen(row: Row) -> Seen:
    """The time."""
    return Seen("", number(row, "time"))


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """Another time: by more than rounding, and by more than the last digit that is written."""
    was, now = seen(old), seen(new)
    same = was.number == now.number
    if was.number is not None and now.number is not None:
        same = same or abs(now.number - was.number) <= max(LEAST, 1.5 * _digit(was.number))
    return None if same else Change(CHANGED, INSTANTS.name, place(new), was, now, "s")


def _digit(time: float) -> float:
    """The last one that is written."""
    return 10.0 ** (floor(log10(abs(time))) + 1 - DIGITS) if time and isfinite(time) else 0.0


INSTANTS = File(
    name="events.csv",
    keys=("case", "engine", "setting", "realised", "event", "k"),
    numbers=("time",),
    words=(),
    compare=compared,
    place=place,
    seen=seen,
)
