"""causes.csv: the cures of a row, where both runs have searched for them."""

from collections.abc import Sequence
from functools import partial

from ...data.row import UNSEARCHED
from .file import File
from .other import compared, place, seen
from .table import Row

ROW = ("case", "engine", "setting", "quantity")
KEYS = (*ROW, "cure")
_NAMED = ROW[:3]
_REST = ("error", "allowed", "options", "step", "error_after", "cost", "law")


def both_searched(old: Sequence[Row], new: Sequence[Row]) -> tuple[list[Row], list[Row]]:
    """The rows of each but those about what one of them has not searched."""
    left = {_about(row) for row in (*old, *new) if row["cure"] == UNSEARCHED}
    before, after = ([row for row in rows if _about(row) not in left] for rows in (old, new))
    return before, after


def _about(row: Row) -> tuple[str, ...]:
    return tuple(row[name] for name in ROW)


CAUSES = File(
    name="causes.csv",
    keys=KEYS,
    numbers=(),
    words=_REST,
    compare=partial(compared, "causes.csv", KEYS, _REST),
    place=partial(place, _NAMED, KEYS),
    seen=partial(seen, _REST),
    both=both_searched,
)
