"""The cause of an error by experiment: the smallest sets of changes that bring it within bounds.

What one change does alone tells no cause: put in and taken out name different ones, and shares do
not add up. So all sets of a size are tried, and those of the smallest size that cures are named.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise

from .candidate import Candidate
from .errors import of
from .lever import Field, Lever, Turned
from .together import Asking, Known

LARGEST = 3  # levers in a set
LARGEST_OF_ALL = 4  # where no smaller set cures
MANY = 4  # levers from which on it pays to ask first which of them matter
SAME = 0.1  # of an error: a change of less than that is none


@dataclass(frozen=True)
class Cure:
    """A smallest set, and the largest step [s] of the ladder from which on it keeps the bound."""

    turned: Turned
    candidate: Candidate
    error: float  # over what is allowed


@dataclass(frozen=True)
class Cured:
    """Of one row: its error before, and all cures of the smallest size; none where none is found.

    elsewhere: they cure what is not beside an instant; with the instant nothing does.
    """

    before: float
    cures: Sequence[Cure]
    elsewhere: bool = False


def cures(field: Field, known: Known, rows: Sequence[str]) -> Asking[dict[str, Cured]]:
    """For each row: a quantity's name."""
    yield [field.base]
    names = {row: field.levers for row in rows}
    found: dict[str, Cured] = {}
    for size in range(1, LARGEST_OF_ALL + 1):
        left = [row for row in rows if row not in found]
        if size == 2 and len(field.levers) >= MANY and left:
            names |= yield from _that_matter(field, known, left)
        sets = {row: list(combinations(names[row], size)) for row in left}
        yield {field.candidate(turned) for row in left for turned in sets[row]}
        cured = {row: list(_within(field, known, row, sets[row])) for row in left}
        yield {finer for row in left for turned in cured[row] for finer in _rungs(field, turned)}
        for row in left:
            if lasting := list(_lasting(field, known, row, cured[row])):
                found[row] = Cured(of(known[field.base], row), lasting)
    return {row: found.get(row) or Cured(of(known[field.base], row), ()) for row in rows}


def _within(
    field: Field, known: Known, row: str, sets: Iterable[Turned]
) -> Iterator[Turned]:
    for turned in sets:
        if of(known[field.candidate(turned)], row) <= 1.0:
            yield turned


def _rungs(field: Field, turned: Turned) -> list[Candidate]:
    """The steps by which it is seen whether a set cures for good, coarse to fine.

    Of one with the step all between; of any other its own and the next finer one: at one step
    alone errors beside an event may be small by luck.
    """
    candidate = field.candidate(turned)
    if any(lever.finer for lever in turned):
        return [candidate.at(step) for step in field.steps[1:]]
    return [candidate, candidate.at(candidate.step / 2)]


def _lasting(
    field: Field, known: Known, row: str, sets: Iterable[Turned]
) -> Iterator[Cure]:
    """Those that keep the bound from a step on, at the largest such step."""
    for turned in sets:
        rungs = _rungs(field, turned)
        usable = None
        for candidate in reversed(rungs):
            if not of(known[candidate], row) <= 1.0:
                break
            usable = candidate
        finer = any(lever.finer for lever in turned)
        if usable is not None and (finer or usable == rungs[0]):
            yield Cure(turned, usable, of(known[usable], row))


def _that_matter(
    field: Field, known: Known, rows: Sequence[str]
) -> Asking[dict[str, list[Lever]]]:
    """Of each row the levers that change its error put in alone, or taken out of all others."""
    knobs = [lever for lever in field.levers if not lever.finer]
    every = field.candidate(knobs)
    without = {lever: field.candidate(k for k in knobs if k != lever) for lever in knobs}
    yield [every, *without.values()]

    def matters(lever: Lever, row: str) -> bool:
        if lever.finer:
            return True
        alone = field.candidate([lever])
        ends = (field.base, alone), (every, without[lever])
        return any(_differ(*(of(known[c], row) for c in end)) for end in ends)

    return {row: [lever for lever in field.levers if matters(lever, row)] for row in rows}


def _differ(one: float, other: float) -> bool:
    """Two that are inf tell nothing of a lever: it is kept."""
    return not abs(one - other) <= SAME * max(one, other)
