"""The cause of an error by experiment: the smallest sets of changes that bring it within bounds.

What one change does alone tells no cause: put in and taken out name different ones, and shares do
not add up. So all sets of a size are tried, and those of the smallest size that cures are named.
"""

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np

from .candidate import Candidate
from .change import STEP, Change, Changes, Field
from .errors import of
from .search import Ladder, Runs, fewest

LARGEST = 4  # changes in a set whose smaller ones have all been tried
LARGEST_FINER = 3  # with a smaller step: each such run takes as long as ten others
PAIR = 2  # changes: so many are tried with the step whatever else cures
MANY = 6  # changes, from which on it pays to ask first which of them matter
SAME = 0.1  # of an error: a change of less than that is none


@dataclass(frozen=True)
class Cure:
    """A smallest set, at the largest step of the ladder from which on it keeps the bound."""

    changes: Changes
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


@dataclass(frozen=True)
class RowErrors:
    """The errors of a row's quantity over what is allowed; elsewhere: away from instants."""

    field: Field
    runs: Runs
    quantity: str
    elsewhere: bool = False

    def __call__(self, candidate: Candidate) -> float:
        return of(self.runs.known[candidate], self.quantity, elsewhere=self.elsewhere)


def cured(field: Field, runs: Runs, quantity: str) -> Cured:
    """The cures of the whole error, or else of the one away from instants."""
    runs.need([field.base])
    whole, away = (RowErrors(field, runs, quantity, elsewhere) for elsewhere in (False, True))
    if cures := _cures(whole):
        return Cured(cures)
    if 1.0 < away(field.base) < whole(field.base) and (cures := _cures(away)):
        return Cured(cures, elsewhere=True)
    return Cured()


def _cures(errors: RowErrors) -> list[Cure]:
    field, runs = errors.field, errors.runs
    sets = ([_ladder(field, each) for each in group] for group in _groups(errors))
    cures = fewest(runs, sets, lambda candidate: errors(candidate) <= 1.0)
    least = min((len(changes) for changes, _ in cures), default=0)
    cures = [(changes, usable) for changes, usable in cures if len(changes) == least]
    along = [field.along(changes) for changes, _ in cures]
    runs.need(candidate for _, candidates in along for candidate in candidates.values())
    return [
        Cure(changes, usable, errors(usable), law(name, {x: errors(c) for x, c in by_x.items()}))
        for (changes, usable), (name, by_x) in zip(cures, along, strict=True)
    ]


def _ladder(field: Field, changes: Changes) -> Ladder[Changes]:
    """The steps by which it is seen whether a set cures for good.

    Of one with the step all below its own; of any other its own and the next finer one: at one step
    alone an error beside an event may be small by luck.
    """
    own, *finer = field.ladder(changes)
    if STEP in changes:
        return Ladder(changes, finer, confirmed=False)
    return Ladder(changes, [own, own.at(own.step / 2)])


def _groups(errors: RowErrors) -> Iterator[Iterable[Changes]]:
    """Sets of changes, the smallest first; beyond the largest, all that matter, and all there are.

    Beside more than one other a smaller step is tried where nothing else is enough: it costs most,
    to try as to use. Alone it is known from an engine's ladder. At last presets, which a set that
    only goes on the way to the tuned recipe never meets.
    """
    field, changes = errors.field, errors.field.changes
    for size in range(1, LARGEST + 1):
        if size == 2 and len(changes) >= MANY:
            changes = _that_matter(errors)
        kept, finer = _by_step(combinations(changes, size))
        if size <= PAIR:
            yield [*kept, *finer]
        else:
            yield kept
            yield finer if size <= LARGEST_FINER else ()
    knobs = tuple(change for change in changes if change is not STEP)
    every = (knobs, (*knobs, STEP), (*field.changes, *field.rest))
    yield from _by_step(each for each in every if len(each) > LARGEST_FINER)
    yield [(preset,) for preset in field.presets]
    yield [(preset, STEP) for preset in field.presets]


def _by_step(sets: Iterable[Changes]) -> tuple[list[Changes], list[Changes]]:
    """Returns those that keep the step, and those that do not."""
    every = list(sets)
    return [each for each in every if STEP not in each], [each for each in every if STEP in each]


def _that_matter(errors: RowErrors) -> list[Change]:
    """The changes that move the error, put in alone or taken out of all: most do not.

    Both are asked, the second at a step half-way down: from afar a motion may be as far off with a
    change as without it. Alone they have been asked before.
    """
    field = errors.field
    step = field.steps[len(field.steps) // 2]
    knobs = [change for change in field.changes if change is not STEP]
    every = field.candidate(knobs).at(step)
    without = {one: field.candidate(k for k in knobs if k is not one).at(step) for one in knobs}
    errors.runs.need([every, *without.values()])

    def differ(a: Candidate, b: Candidate) -> bool:
        return not abs(errors(a) - errors(b)) <= SAME * max(errors(a), errors(b))  # of two inf too

    return [
        change
        for change in field.changes
        if change is STEP
        or differ(field.base, field.candidate([change]))
        or differ(every, without[change])
    ]


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
