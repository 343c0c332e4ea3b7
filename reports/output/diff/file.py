"""Describes how a file of a report folder is compared: what names a row, and what a change means.

Each known file has such a description in a module of its own, by which `compare` goes; any other
is compared cell by cell. One side is the old folder, the other the new one.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .change import LOST, NEW, Change, Place, Seen
from .rule import Rule
from .scope import Scope
from .table import Row

Compare = Callable[[Row, Row, Rule, float | None], Change | None]
"""Returns the change between a row of the old folder and that of the new one, or None.

The last argument is the error that is allowed of the row's quantity; None where there is none.
"""


@dataclass(frozen=True)
class File:
    """The description of one file.

    keys: the columns that name a row. numbers, words: further ones that are compared. compare,
    place, seen: the change between two rows, where it stands, and what one row says. lost, new:
    the kind of change that it is if only the old, or only the new folder has a row. within: the
    row, as far as it is about cases and engines of the scope, or None. verdicts: whether a word
    is a verdict that the file may hold. both: of the rows of two folders those about what both
    runs looked for.
    """

    name: str
    keys: tuple[str, ...]
    numbers: tuple[str, ...]
    words: tuple[str, ...]
    compare: Compare
    place: Callable[[Row], Place]
    seen: Callable[[Row], Seen]
    lost: Callable[[Row], str] = lambda row: LOST
    new: Callable[[Row], str] = lambda row: NEW
    within: Callable[[Row, Scope], Row | None] = lambda row, scope: scope.within(row)
    verdicts: Callable[[str], bool] = lambda word: True
    both: Callable[[Sequence[Row], Sequence[Row]], tuple[Sequence[Row], Sequence[Row]]] = (
        lambda old, new: (old, new)
    )

    @property
    def needed(self) -> tuple[str, ...]:
        """The columns that the file must have."""
        return (*self.keys, *self.numbers, *self.words)


def number(row: Row, column: str) -> float | None:
    """Returns the number in a cell, or None if the cell is empty."""
    return float(row[column]) if row[column] else None


def column(row: Row) -> str:
    """Names engine, setting and realisation: `mujoco.tuned`, `mujoco.tuned (law)`, `reference`."""
    name = ".".join(part for part in (row["engine"], row["setting"]) if part)
    return name if row["realised"] in ("", "native") else f"{name} ({row['realised']})"


def arrow(name: str, was: str, now: str) -> str:
    """Returns a note of what else differs, `step 0.01 → 0.002`, or "" where it is the same."""
    return f"{name} {was or 'none'} → {now or 'none'}" if was != now else ""
