"""The columns of the page: an engine with a setting, in one of the ways it was run."""

from collections.abc import Iterable
from dataclasses import dataclass

from ....engines import SETTINGS, place
from ...compare.own_steps import OWN
from ...runs.selection import BOOK
from ...tables.row import Comparison, Instant, Rungs, StepError
from ...tables.spoken import spoken

WAYS = {"native": 0, "driver": 1, "law": 2}


@dataclass(frozen=True, order=True)
class Column:
    """`mujoco.tuned.law` as its rows and its motion name it."""

    engine: str
    setting: str
    realised: str

    @property
    def key(self) -> str:
        """Its name in the data."""
        return f"{self.engine}.{self.setting}.{self.realised}"

    @property
    def own(self) -> bool:
        """Says whether the setting is a person's own: no engine offers one of that name."""
        return self.engine != BOOK and self.setting not in SETTINGS

    @property
    def title(self) -> str:
        """Its name for a person."""
        way = "" if self.realised == "native" else f" + {spoken(self.realised)}"
        return f"{self.engine} {self.setting}{way}"


def column(row: Comparison | Rungs | StepError | Instant) -> Column:
    """Returns the column of a row."""
    return Column(row.engine, row.setting, row.realised)


def columns(rows: Iterable[Comparison]) -> list[Column]:
    """Returns every column of the rows in order, the book's approximations last."""
    return ordered(map(column, rows))


def ordered(columns: Iterable[Column]) -> list[Column]:
    """Returns each of them once, by engine and setting, the book's approximations last."""
    return sorted(set(columns), key=_place)


def _place(of: Column) -> tuple[bool, str, float, str, int]:
    setting = place(of.setting) if of.setting != OWN else -1.0  # a model's own comes first
    return (of.engine == BOOK, of.engine, setting, of.setting, WAYS.get(of.realised, 0))
