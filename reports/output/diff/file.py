"""Describes a report's file: what names a row, what is compared, and what a change means."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from .change import LOST, NEW, Change, Place, Seen
from .rule import Rule
from .scope import Scope
from .table import Row

Compare = Callable[[Row, Row, Rule, float | None], Change | None]
"""Of a row of the old folder and of the new one, and of what is allowed of their quantity."""


@dataclass(frozen=True)
class File:
    """keys: the columns that name a row. numbers, words: further ones that are compared.

    lost, new: what it is that only one of the folders has a row. within: the row as far as both
    folders look at it, or None. both: of the rows of two folders those about what both looked for.
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
    verdicts: Callable[[str], bool] = lambda word: True  # whether it is one
    both: Callable[[Sequence[Row], Sequence[Row]], tuple[Sequence[Row], Sequence[Row]]] = (
        lambda old, new: (old, new)
    )

    @property
    def needed(self) -> tuple[str, ...]:
        """The columns it must have."""
        return (*self.keys, *self.numbers, *self.words)


def number(row: Row, column: str) -> float | None:
    """None where the report says nothing."""
    return float(row[column]) if row[column] else None


def column(row: Row) -> str:
    """`mujoco.tuned`, `mujoco.tuned (law)`, `reference`."""
    name = ".".join(part for part in (row["engine"], row["setting"]) if part)
    return name if row["realised"] in ("", "native") else f"{name} ({row['realised']})"


def arrow(name: str, was: str, now: str) -> str:
    """A note: what else is not the same."""
    return f"{name} {was or 'none'} → {now or 'none'}" if was != now else ""
