"""The cause of an error by experiment: the smallest sets of changes that bring it within bounds.

What one change does alone tells no cause: put in and taken out name different ones, and shares do
not add up. So all sets of a size are tried, and those of the smallest size that cures are named.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

from .candidate import Candidate
from .errors import of
from .law import law
from .lever import STEP, Field, Lever, Turned
from .together import Asking, Known

LARGEST = 4  # levers in a set whose smaller ones have all been tried
MANY = 6  # levers, from which on it pays to ask first which of them matter
SAME = 0.1  # of an error: a change of less than that is none


@dataclass(frozen=True)
class Cure:
    """A smallest set, at the largest step of the ladder from which on it keeps the bound."""

    turned: Turned
    candidate: Candidate
    error: float  # over what is allowed
    law: str


@dataclass(frozen=True)
class Cured:
    """Of one row: its cures of the smallest size, or none.

    elsewhere: they cure what is not beside an instant; with the instant nothing does.
    """

    cures: Sequence[Cure] = ()
    elsewhere: bool = False


@dataclass(frozen=True)
class _Search:
    """What cures are looked for in; elsewhere: whether beside instants anything may be."""

    field: Field
    known: Known
    elsewhere: bool

    def error(self, candidate: Candidate, row: str) -> float:
        return of(self.known[candidate], row, elsewhere=self.elsewhere)


def cures(field: Field, known: Known, rows: Sequence[str]) -> Asking[dict[str, Cured]]:
    """For each row, a quantity's name: of the whole error, or else of the one away from instants."""
    yield [field.base]
    whole, away = (_Search(field, known, elsewhere) for elsewhere in (False, True))
    found = yield from _smallest(whole, rows)
    left = [
        row
        for row in rows
        if row not in found and 1.0 < away.error(field.base, row) < whole.error(field.base, row)
    ]
    others = yield from _smallest(away, left)
    cured = {row: Cured(sets) for row, sets in found.items()}
    cured |= {row: Cured(sets, elsewhere=True) for row, sets in others.items()}
    return {row: cured.get(row, Cured()) for row in rows}


def _smallest(search: _Search, rows: Sequence[str]) -> Asking[dict[str, Sequence[Cure]]]:
    """The cures of each row that has any."""
    field, found = search.field, dict[str, Sequence[Cure]]()
    matter: Mapping[str, Sequence[Lever]] = dict.fromkeys(rows, field.levers)
    for size in range(1, LARGEST + 2):
        left = [row for row in rows if row not in found]
        if size == 2 and len(field.levers) >= MANY and left:
            matter = yield from _that_matter(search, left)
        sets = {row: _sets(matter[row], size) for row in left}
        yield {field.candidate(turned) for row in left for turned in sets[row]}
        within = {
            row: [t for t in sets[row] if search.error(field.candidate(t), row) <= 1.0]
            for row in left
        }
        yield {c for row in left for turned in within[row] for c in _asked(field, turned)}
        for row in left:
            if lasting := list(_lasting(search, row, within[row])):
                found[row] = lasting
    return found


def _sets(matter: Sequence[Lever], size: int) -> list[Turned]:
    """All of that size; beyond the largest, all levers that matter, together."""
    if size > LARGEST:
        return [tuple(matter)] if len(matter) > LARGEST else []
    return list(combinations(matter, size))


def _rungs(field: Field, turned: Turned) -> list[Candidate]:
    """The steps by which it is seen whether a set cures for good, coarse to fine.

    Of one with the step all between; of any other its own and the next finer one: at one step
    alone an error beside an event may be small by luck.
    """
    candidate = field.candidate(turned)
    if STEP in turned:
        return [candidate.at(step) for step in field.steps[1:]]
    return [candidate, candidate.at(candidate.step / 2)]


def _asked(field: Field, turned: Turned) -> list[Candidate]:
    return [*_rungs(field, turned), *field.along(turned)[1].values()]


def _lasting(search: _Search, row: str, sets: Iterable[Turned]) -> Iterator[Cure]:
    """Those that keep the bound from a step on, at the largest such step."""
    for turned in sets:
        rungs, usable = _rungs(search.field, turned), None
        for candidate in reversed(rungs):
            if not search.error(candidate, row) <= 1.0:
                break
            usable = candidate
        if usable is not None and (STEP in turned or usable == rungs[0]):
            number, along = search.field.along(turned)
            told = law(number, {x: search.error(c, row) for x, c in along.items()})
            yield Cure(turned, usable, search.error(usable, row), told)


def _that_matter(search: _Search, rows: Sequence[str]) -> Asking[dict[str, list[Lever]]]:
    """Of each row the levers that change its error, put in alone or taken out of all.

    Both are asked: from afar a motion may be as far off with a lever as without it.
    """
    field = search.field
    every = field.candidate(field.levers)
    without = {one: field.candidate(k for k in field.levers if k is not one) for one in field.levers}
    yield [every, *without.values()]

    def matters(lever: Lever, row: str) -> bool:
        ends = (field.base, field.candidate([lever])), (every, without[lever])
        return any(_differ(*(search.error(c, row) for c in end)) for end in ends)

    return {row: [lever for lever in field.levers if matters(lever, row)] for row in rows}


def _differ(one: float, other: float) -> bool:
    """Two that are inf tell nothing of a lever: it is kept."""
    return not abs(one - other) <= SAME * max(one, other)
