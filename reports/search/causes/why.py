"""Which rows have a cause to be found, and of which nothing needs to be tried to know it."""

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from ...compare.judge.cause import STEPS
from ...tables.row import AGREES, BEYOND, DEVIATES, DIVERGED, UNSETTLED, Cause, Comparison, Rungs

OFF = (BEYOND, DEVIATES, DIVERGED)
OURS = {
    "law": "our force law in place of its own",
    "driver": "our driver, which cuts its steps at events",
}
Key = tuple[str, str, str, str]
"""A row's case, engine, setting and quantity."""


def key_of(row: Comparison | Cause) -> Key:
    """Returns the case, engine, setting and quantity of a row."""
    return row.case, row.engine, row.setting, row.quantity


@dataclass(frozen=True)
class Rows:
    """Every row of a run, and its ladders."""

    comparisons: Sequence[Comparison]
    ladders: Sequence[Rungs] = ()

    def off(self) -> Iterator[Comparison]:
        """Yields the native rows above their tolerance, whatever the verdict is called."""
        for row in self.comparisons:
            over = row.ratio is None or not row.ratio <= 1.0
            if row.verdict in OFF and row.realised == "native" and over:
                yield row

    def ours(self, row: Comparison) -> list[Comparison]:
        """Returns the rows of a law or driver of ours that agree, if only such do.

        Nothing says so where the engine's own ladder, with the row's setting or the tuned one, ends
        within or blames the step, nor where that of the tuned one is too short to blame anything.
        """
        agree = self._tuned.get((row.case, row.engine, row.quantity), {})
        steps = {(row.case, row.engine, s, row.quantity) for s in (row.setting, "tuned")}
        if "native" in agree or steps & self._by_steps:
            return []
        return [agree[way] for way in OURS if way in agree]

    @cached_property
    def _by_steps(self) -> set[Key]:
        """Returns the keys of all that smaller steps of the engine's own may bring within."""
        return {
            (ladder.case, ladder.engine, ladder.setting, ladder.quantity)
            for ladder in self.ladders
            if ladder.realised == "native"
            and (
                ladder.usable_step
                or ladder.verdict in STEPS
                or (ladder.setting == "tuned" and ladder.verdict == UNSETTLED)
            )
        }

    @cached_property
    def _tuned(self) -> Mapping[tuple[str, str, str], dict[str, Comparison]]:
        tuned: dict[tuple[str, str, str], dict[str, Comparison]] = {}
        for row in self.comparisons:
            if row.setting == "tuned" and row.verdict == AGREES:
                tuned.setdefault((row.case, row.engine, row.quantity), {})[row.realised] = row
        return tuned
