"""Which rows have a cause to be found, and of which nothing needs to be tried to know it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from ...data.row import AGREES, BEYOND, DEVIATES, DIVERGED, Cause, Comparison

OFF = (BEYOND, DEVIATES, DIVERGED)
OURS = {
    "law": "our force law in place of its own",
    "driver": "our driver, which cuts its steps at events",
}
Key = tuple[str, str, str, str]
"""A row's case, engine, setting and quantity."""


def key_of(row: Comparison | Cause) -> Key:
    return row.case, row.engine, row.setting, row.quantity


@dataclass(frozen=True)
class Rows:
    """Every row of a run."""

    comparisons: Sequence[Comparison]

    def off(self) -> Iterator[Comparison]:
        """The engines' own that are above their tolerance, whatever the verdict is called."""
        for row in self.comparisons:
            over = row.ratio is None or not row.ratio <= 1.0
            if row.verdict in OFF and row.realised == "native" and over:
                yield row

    def ours(self, row: Comparison) -> list[Comparison]:
        """Rows that agree with a law or driver of ours, if only such do: its model is another."""
        agree = self._tuned.get((row.case, row.engine, row.quantity), {})
        return [] if "native" in agree else [agree[way] for way in OURS if way in agree]

    @cached_property
    def _tuned(self) -> Mapping[tuple[str, str, str], dict[str, Comparison]]:
        found: dict[tuple[str, str, str], dict[str, Comparison]] = {}
        for row in self.comparisons:
            if row.setting == "tuned" and row.verdict == AGREES:
                found.setdefault((row.case, row.engine, row.quantity), {})[row.realised] = row
        return found
