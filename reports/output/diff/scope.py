"""Cases and engines that both folders look at: all others are counted, and not compared."""

from collections.abc import Iterable
from dataclasses import dataclass

from .table import Row

REFERENCE = ("reference", "")  # an engine's column in events.csv, of every run

Column = tuple[str, str]
"""An engine and its setting."""


@dataclass(frozen=True)
class Scope:
    """Cases and engines with their settings."""

    cases: frozenset[str]
    columns: frozenset[Column]

    @staticmethod
    def of(rows: Iterable[Row]) -> "Scope":
        """Returns the scope of rows of tolerance.csv.

        Each engine has one on each case, even if it refuses it.
        """
        told = [*rows]
        return Scope(
            frozenset(row["case"] for row in told),
            frozenset((row["engine"], row["setting"]) for row in told),
        )

    def __and__(self, other: "Scope") -> "Scope":
        return Scope(self.cases & other.cases, self.columns & other.columns)

    def __or__(self, other: "Scope") -> "Scope":
        return Scope(self.cases | other.cases, self.columns | other.columns)

    def within(self, row: Row) -> Row | None:
        """The row if it is about one of the cases and one of the engines, as far as it says."""
        if "case" in row and row["case"] not in self.cases:
            return None
        if "engine" not in row or "setting" not in row:
            return row
        column = row["engine"], row["setting"]
        return row if column == REFERENCE or column in self.columns else None
