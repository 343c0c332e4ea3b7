"""The positions at the start: Newton's method from what is near, or the only way there is."""

from collections.abc import Iterator
from functools import partial

import numpy as np

from ...cases.mistake import CaseError
from ..system import Array
from . import messages
from .planar_closure import PlanarClosure
from .search import (
    BESIDE,
    CLOSED,
    DEAD,
    FAR,
    NEAR,
    RANK,
    SAME,
    least_of,
    newton,
    null,
    search,
)
from .spatial_closure import SpatialClosure

ASIDE = 1e-2  # of the size, or rad: beside a dead centre
ELSEWHERE = 0.5  # of the size, or rad: rows that repeat others there do so for good

EitherClosure = PlanarClosure | SpatialClosure


def positions(closure: EitherClosure) -> Array:
    """q that satisfies all equations, with what is given in its place.

    Raises CaseError if there is none, more than one to choose from, or a coordinate is left open.
    """
    closure.refuse_words()
    candidates, (gap, nearest) = search(closure, partial(_guesses, closure), closure.is_assembly)
    if not candidates:
        raise _cannot_close(closure, nearest, gap)
    ways = nearest_ways(closure, candidates)
    _determined(closure, ways[0])
    if len(ways) > 1:
        raise _several_ways(closure, ways)
    if max(closure.near_errors(ways[0], turns=True).values(), default=0.0) > FAR:
        raise _none_near(closure, ways[0], candidates)
    closure.refuse_turns(ways[0])
    return ways[0]


def _guesses(closure: EitherClosure, ways: list[Array]) -> Iterator[Array]:
    """First guesses of q: what is near, some beside it, and any; ways: what was found of them.

    Where one way is so near to what `near` says that only nearer ones would matter, the last are
    left out.
    """
    yield closure.guess()
    if ways:
        _determined(closure, ways[0])
        if not closure.several():
            return
    if closure.case.near:
        yield from closure.beside_near(BESIDE)
        if ways and min(closure.distance(q) for q in ways) < NEAR:
            return
    yield from closure.anywhere()


def nearest_ways(closure: EitherClosure, ways: list[Array]) -> list[Array]:
    """The one that is nearest to what `near` says, or several that are as near as each other."""
    return closure.preferred(least_of(ways, [closure.distance(q) for q in ways], SAME))


def _determined(closure: EitherClosure, q: Array) -> None:
    """Refuses what leaves coordinates open: for good, or at a dead centre."""
    rows = closure.equations(q)[1][:, closure.free]
    for below in (RANK, DEAD):
        ways = null(rows, len(closure.free), below)
        if len(ways):
            loose = np.zeros((len(ways), closure.n))
            loose[:, closure.free] = ways
            # What the smallest values that count leave of what is determined is as small as they.
            names = closure.open_names(q, loose, max(SAME, 10 * below))
            if below == RANK and not _only_here(closure, q):
                missing = messages.missing(closure.case, len(ways), names)
                if (part := _repeated(closure, q, loose)) is not None:  # with any that were given
                    mistakes = messages.dependent(closure.case, part).mistakes
                    raise CaseError([*mistakes, *missing.mistakes])
                raise missing
            raise messages.dead_centre(closure.case, names)


def _repeated(closure: EitherClosure, q: Array, loose: Array) -> str | None:
    """The part whose rows repeat those of others here and elsewhere along the open directions."""
    part = closure.dependent(q, RANK)
    if part is None:
        return None
    along = np.random.default_rng(seed=1).uniform(-1.0, 1.0, len(loose)) @ loose
    there, gap = newton(closure, closure.moved(q, ELSEWHERE * along * closure.units))
    closes = gap < CLOSED * closure.rounding
    return part if closes and closure.dependent(there, RANK) is not None else None


def _only_here(closure: EitherClosure, q: Array) -> bool:
    """Whether nothing is open beside q: at a dead centre what is given is enough, but there."""
    change = np.zeros(closure.n)
    change[closure.free] = np.random.default_rng(seed=1).uniform(-1.0, 1.0, len(closure.free))
    beside = closure.moved(q, ASIDE * change * closure.units)
    return not len(null(closure.equations(beside)[1][:, closure.free], len(closure.free)))


# Why there is no start, in words that name the part and the number.


def _cannot_close(closure: EitherClosure, q: Array, gap: float) -> CaseError:
    """No positions satisfy the equations; q is the best that was found."""
    if not np.isfinite(gap):
        return messages.flat(closure.case)
    residual, _ = closure.equations(q)
    worst = int(np.argmax(np.abs(residual)))
    part, turns = closure.owners(q)[worst]
    why = "the initial state violates a constraint"
    if len(closure.free):
        why = "the mechanism cannot be assembled from what is given"
    size = abs(float(residual[worst]))
    return messages.stays_open(closure.case, why, part, size, closure.size, turns=turns)


def _several_ways(closure: EitherClosure, ways: list[Array]) -> CaseError:
    """Names the coordinate in which the ways differ most, and those that tell one from all others.

    The first with its values, all of them as they are in one of the ways.
    """
    name = closure.distinguishing(ways)
    values = list(dict.fromkeys(closure.shown(q, name) for q in ways))
    first, near, candidates = ways[0], dict[str, str](), ways
    while len(candidates) > 1:
        tells = closure.distinguishing(candidates)
        near[tells] = closure.shown(first, tells)
        alike = [q for q in candidates if closure.shown(q, tells) == near[tells]]
        candidates = alike if len(alike) < len(candidates) else [first]
    return messages.several(closure.case, len(ways), name, values, near)


def _none_near(closure: EitherClosure, way: Array, candidates: list[Array]) -> CaseError:
    """No way is where `near` says; told by what is farthest from it, and from the nearest on."""
    errors = closure.near_errors(way, turns=True)
    name = max(errors, key=errors.__getitem__)
    nearest_first = sorted(candidates, key=closure.distance)
    return messages.none_near(closure.case, name, [closure.shown(q, name) for q in nearest_first])
