"""The cause of an error by experiment: the smallest sets of changes that bring it within bounds.

What one change does alone tells no cause: put in and taken out name different ones, and shares do
not add up. So all sets of a size are tried, and those of the smallest size that cures are named.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from .candidate import Candidate
from .change import STEP, Field, Lever, Turned
from .errors import of
from .parallel_search import Asking, Known

# Which levers matter to a row: of many most do not, and sets with those need not be tried.


SAME = 0.1  # of an error: a change of less than that is none


@dataclass(frozen=True)
class Setting:
    """Levers and runs of a search for cures; elsewhere: whether beside instants anything may be."""

    field: Field
    known: Known
    elsewhere: bool

    def error(self, candidate: Candidate, row: str) -> float:
        """The error of the row's quantity, over what is allowed."""
        return of(self.known[candidate], row, elsewhere=self.elsewhere)


def that_matter(search: Setting, rows: Sequence[str]) -> Asking[dict[str, list[Lever]]]:
    """For each row the levers that change its error, put in alone or taken out of all.

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


# How an error follows one number: a power law, where there is one.


FEWEST, MOST = 3, 5  # values of the number, the finest of those that are known
FITS = 0.1  # of each error: how far it may be off the line
FLAT = 0.05  # of a power: below it the number makes no difference


def law(name: str, errors: Mapping[float, float]) -> str:
    """`h^2`, `impratio^-1`: the slope of log error over log number; nothing where none fits.

    errors: by the number, in the order in which a cure is approached.
    """
    x, y = np.array(list(errors)[-MOST:]), np.array(list(errors.values())[-MOST:])
    if len(x) < FEWEST or not np.all(np.isfinite(y)) or np.any(x <= 0) or np.any(y <= 0):
        return ""
    power, factor = np.polyfit(np.log(x), np.log(y), 1)
    off = np.abs(np.exp(factor) * x**power / y - 1)
    return f"{name}^{power:.2g}" if abs(power) >= FLAT and np.all(off <= FITS) else ""


LARGEST = 4  # levers in a set whose smaller ones have all been tried
LARGEST_FINER = 3  # with a smaller step: each such run takes as long as ten others
WHOLE = LARGEST + 2  # levers: in their place recipes as a whole, each alone and with the step
PAIR = 2  # levers, the step one of them: so many are tried whatever else cures
MANY = 6  # levers, from which on it pays to ask first which of them matter


@dataclass(frozen=True)
class Cure:
    """A smallest set, at the largest step of the ladder from which on it keeps the bound."""

    turned: Turned
    candidate: Candidate
    error: float  # over what is allowed
    law: str


@dataclass(frozen=True)
class Cured:
    """The cures of one row, of the smallest size, or none.

    elsewhere: they cure what is not beside an instant; with the instant nothing does.
    """

    cures: Sequence[Cure] = ()
    elsewhere: bool = False


def cures(field: Field, known: Known, rows: Sequence[str]) -> Asking[dict[str, Cured]]:
    """By quantity: of the whole error, or else of the one away from instants."""
    yield [field.base]
    whole, away = (Setting(field, known, elsewhere) for elsewhere in (False, True))
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


def _smallest(search: Setting, rows: Sequence[str]) -> Asking[dict[str, Sequence[Cure]]]:
    """The cures of each row that has any.

    Beside more than one other a smaller step is tried where nothing else is enough: it costs most,
    to try as to use. Alone it is known from an engine's ladder.
    """
    field, found = search.field, dict[str, Sequence[Cure]]()
    matter: Mapping[str, Sequence[Lever]] = dict.fromkeys(rows, field.levers)
    for size in range(1, WHOLE + 1):
        left = [row for row in rows if row not in found]
        if size == 2 and len(field.levers) >= MANY and left:
            matter = yield from that_matter(search, left)
        sets = {row: _sets(field, matter[row], size) for row in left}
        found |= yield from _cured(search, sets, finer=False)
        others = {row: of for row, of in sets.items() if size <= PAIR or row not in found}
        with_step = yield from _cured(search, others, finer=True)
        found |= {row: [*found.get(row, ()), *cures] for row, cures in with_step.items()}
    return found


def _cured(
    search: Setting, sets: Mapping[str, Sequence[Turned]], *, finer: bool
) -> Asking[dict[str, Sequence[Cure]]]:
    """For each row the smallest of its sets, with or without the step, that cure for good."""
    field = search.field
    among = {
        row: [turned for turned in of if (STEP in turned) == finer] for row, of in sets.items()
    }
    yield {field.candidate(turned) for of in among.values() for turned in of}
    within = {
        row: [turned for turned in of if search.error(field.candidate(turned), row) <= 1.0]
        for row, of in among.items()
    }
    yield {c for of in within.values() for turned in of for c in _asked(field, turned)}
    lasting = {row: list(_lasting(search, row, of)) for row, of in within.items()}
    return {row: _fewest(cures) for row, cures in lasting.items() if cures}


def _fewest(cures: Sequence[Cure]) -> list[Cure]:
    """The cures with the fewest levers: sets beyond the largest are not all of one size."""
    least = min(len(cure.turned) for cure in cures)
    return [cure for cure in cures if len(cure.turned) == least]


def _sets(field: Field, matter: Sequence[Lever], size: int) -> list[Turned]:
    """Every set of that size; beyond the largest, all levers that matter, and all there are.

    At last whole recipes, which a set that only goes on the way to the tuned one never meets.
    """
    if size == WHOLE:
        return [turned for whole in field.wholes for turned in ((whole,), (whole, STEP))]
    if size <= LARGEST:
        sets = combinations(matter, size)
        return [turned for turned in sets if size <= LARGEST_FINER or STEP not in turned]
    knobs = [lever for lever in matter if lever is not STEP]
    rest = [] if field.rest is None else [field.rest]
    every = [tuple(knobs), (*knobs, STEP), (*field.levers, *rest)]
    return [turned for turned in every if len(turned) > LARGEST_FINER]


def _rungs(field: Field, turned: Turned) -> list[Candidate]:
    """The steps by which it is seen whether a set cures for good, coarse to fine.

    Of one with the step all between; of any other its own and the next finer one: at one step
    alone an error beside an event may be small by luck.
    """
    candidate = field.candidate(turned)
    if STEP in turned:
        return [candidate.at(step) for step in field.ladder(turned)[1:]]
    return [candidate, candidate.at(candidate.step / 2)]


def _asked(field: Field, turned: Turned) -> list[Candidate]:
    return [*_rungs(field, turned), *field.along(turned)[1].values()]


def _lasting(search: Setting, row: str, sets: Iterable[Turned]) -> Iterator[Cure]:
    """The cures that keep the bound from a step on, each at the largest such step."""
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
