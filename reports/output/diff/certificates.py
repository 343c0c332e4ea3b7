"""reference.csv: whether each check of each reference holds, and to what it is certified."""

from ...data.row import FAILS
from .change import BETTER, CHANGED, NEW, WORSE, Change, Place, Seen
from .file import File, number
from .rule import Rule
from .table import Row

DECADES = 11.0  # what is certified is a power of ten: the next one may be rounding's


def place(row: Row) -> Place:
    """A check of a case's reference."""
    return Place(row["case"], f"reference ({row['system']})", row["check"])


def seen(row: Row) -> Seen:
    """Whether it holds, and what the reference is known to."""
    return Seen(row["verdict"], number(row, "certified"))


def compared(old: Row, new: Row, rule: Rule, allowed: float | None) -> Change | None:
    """A check that fails or holds again, or a certificate that is another by decades."""
    was, now = seen(old), seen(new)
    if was.words != now.words:
        kind = WORSE if now.words == FAILS else BETTER
    elif _apart(was.number, now.number):
        kind = CHANGED
    else:
        return None
    return Change(kind, CERTIFICATES.name, place(new), was, now, new["unit"], label="certified to")


def _apart(was: float | None, now: float | None) -> bool:
    if was is None or now is None:
        return was is not now
    return not max(was, now) <= DECADES * min(was, now)


CERTIFICATES = File(
    name="reference.csv",
    keys=("case", "system", "check"),
    numbers=("certified",),
    words=("unit", "verdict"),
    compare=compared,
    place=place,
    seen=seen,
    new=lambda row: WORSE if row["verdict"] == FAILS else NEW,
    verdicts=lambda word: word in ("holds", FAILS),
)
