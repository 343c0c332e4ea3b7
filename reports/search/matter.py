"""Which levers matter to a row: of many most do not, and sets with those need not be tried."""

from collections.abc import Sequence
from dataclasses import dataclass

from .candidate import Candidate
from .errors import of
from .lever import STEP, Field, Lever
from .together import Asking, Known

SAME = 0.1  # of an error: a change of less than that is none


@dataclass(frozen=True)
class Setting:
    """What cures are looked for in; elsewhere: whether beside instants anything may be."""

    field: Field
    known: Known
    elsewhere: bool

    def error(self, candidate: Candidate, row: str) -> float:
        """Of the row's quantity, over what is allowed."""
        return of(self.known[candidate], row, elsewhere=self.elsewhere)


def that_matter(search: Setting, rows: Sequence[str]) -> Asking[dict[str, list[Lever]]]:
    """Of each row the levers that change its error, put in alone or taken out of all.

    Both are asked, the second at a step half-way down: from afar a motion may be as far off with a
    lever as without it. Alone they have been asked before.
    """
    field = search.field
    step = field.steps[len(field.steps) // 2]
    knobs = [lever for lever in field.levers if lever is not STEP]
    every = field.candidate(knobs).at(step)
    without = {one: field.candidate(k for k in knobs if k is not one).at(step) for one in knobs}
    yield [every, *without.values()]

    def matters(lever: Lever, row: str) -> bool:
        if lever is STEP:
            return True
        ends = (field.base, field.candidate([lever])), (every, without[lever])
        return any(_differ(*(search.error(c, row) for c in end)) for end in ends)

    return {row: [lever for lever in field.levers if matters(lever, row)] for row in rows}


def _differ(one: float, other: float) -> bool:
    """Two that are inf tell nothing of a lever: it is kept."""
    return not abs(one - other) <= SAME * max(one, other)
