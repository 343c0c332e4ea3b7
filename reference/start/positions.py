"""The positions at the start in the plane: from what is near, or the only way there is."""

import math
from collections.abc import Collection, Iterator
from functools import partial

import numpy as np

from ..mechanism.constraints.constraint import tracked
from ..system import Array
from . import messages, refusal
from .closure import POSITIONS, Closure, placed
from .search import BESIDE, DEAD, FAR, NEAR, RANK, SAME, null, rank, search

SEEDS = 200  # starts from which other assemblies are looked for


def positions(closure: Closure) -> Array:
    """q (n,) that closes all joints.

    Raises CaseError if there is none, more than one to choose from, or a coordinate is left open.
    """
    wanted = _Near(closure)
    found, (_, nearest) = search(closure, partial(_guesses, closure, wanted))
    if not found:
        raise refusal.cannot_close(closure, nearest)
    found.sort(key=wanted.distance)  # all 0 without `near`
    ways = [q for q in found if wanted.distance(q) < wanted.distance(found[0]) + SAME]
    _determined(closure, ways[0])
    if len(ways) > 1:
        raise refusal.several_ways(closure, ways)
    if wanted.given and max(abs(off) for _, off, _ in wanted.apart(ways[0], turns=True)) > FAR:
        told = [max(wanted.apart(q, turns=True), key=lambda each: abs(each[1])) for q in found]
        raise messages.none_near(closure.case, told[0][0], [value for *_, value in told])
    _on_its_turns(closure, ways[0])
    return ways[0]


def _on_its_turns(closure: Closure, q: Array) -> None:
    """Refuses a joint's angle that is a turn more or less than its bodies' angles are apart."""
    for part in closure.posed:
        for off, angular in zip(part.f(0.0, q.tolist()), part.angular, strict=True):
            if angular and abs(off) > math.pi:
                raise refusal.another_turn(closure, part.part, off)


class _Near:
    """The guess that the case gives, and how far a solution is from it."""

    def __init__(self, closure: Closure) -> None:
        self.closure = closure
        self.numbers = closure.numbers(closure.case.near, POSITIONS)
        near = placed(closure.case.near)
        self.points = [(tracked(anchor, closure.where), at) for anchor, at in near]
        self.given = bool(self.numbers or self.points)

    def guess(self) -> Array:
        return _laid_out(self.closure, self.said(np.zeros(self.closure.n)), keep=self.numbers)

    def said(self, q: Array) -> Array:
        """q with what is near and what is given in their places."""
        for i, value in (self.numbers | self.closure.given).items():
            q[i] = value
        return q

    def distance(self, q: Array) -> float:
        """In rad and sizes; 0 if nothing is said."""
        return max((abs(off) for _, off, _ in self.apart(q)), default=0.0)

    def apart(self, q: Array, *, turns: bool = False) -> Iterator[tuple[str, float, str]]:
        """For all that is said: its name, how far q is from it, in rad or sizes, and what q has.

        turns: whether whole ones count, which what is given elsewhere may hold.
        """
        c = self.closure
        for i, value in self.numbers.items():
            off = (q[i] - value if turns else c.turned(i, q[i] - value)) / c.units[i]
            yield c.where.names[i], off, refusal.shown(q[i], turns=bool(c.turning[i]))
        for point, at in self.points:
            r = point.places(0.0, q.tolist())
            off = math.hypot(r[0] - at[0], r[1] - at[1]) / c.size
            yield point.part, off, f"[{r[0]:.4g}, {r[1]:.4g}]"


def _guesses(closure: Closure, wanted: "_Near", ways: list[Array]) -> Iterator[Array]:
    """First guesses of q: what is near, and others beside it or anywhere; ways: what was found."""
    yield wanted.guess()
    if ways:
        _determined(closure, ways[0])
        if wanted.given and wanted.distance(ways[0]) < NEAR:  # but another may be nearer still
            yield from _seeds(closure, BESIDE, around=wanted)
            return
    yield from _seeds(closure, SEEDS)


def _seeds(closure: Closure, count: int, around: _Near | None = None) -> Iterator[Array]:
    """Guesses with the free angles anywhere; without free angles the equations are linear.

    around: what is near is kept, ever less so.
    """
    angles = [i for i in closure.free if closure.turning[i]]
    q = np.zeros(closure.n)
    q[list(closure.given)] = list(closure.given.values())
    rng = np.random.default_rng(seed=1)  # any: the same starts in every run
    rods = any(joint.swings for joint in closure.case.scene.joints.values())
    places = [i for i in closure.free if not closure.turning[i]] if rods else []
    for k in range(count if angles or places else 0):
        q[angles] = rng.uniform(-math.pi, math.pi, len(angles))
        q[places] = closure.reach * rng.uniform(-2.0, 2.0, len(places))
        if around is None:
            yield _laid_out(closure, q)
        else:
            beside = np.zeros(closure.n)
            beside[list(around.numbers)] = 1.0
            beside[list(closure.given)] = 0.0
            beside *= closure.units * rng.uniform(-NEAR, NEAR, closure.n) * k / count
            yield _laid_out(closure, around.said(q.copy()) + beside)


def _laid_out(closure: Closure, guess: Array, keep: Collection[int] = ()) -> Array:
    """The guess with the places that fit its angles best: that much is linear."""
    columns = [i for i in closure.free if not closure.turning[i] and i not in keep]
    q = guess.copy()
    residual, jacobian = closure.equations(q)
    change = np.linalg.lstsq(jacobian[:, columns], residual, rcond=None)[0]
    q[columns] -= change * closure.size
    return q


def _determined(closure: Closure, q: Array) -> None:
    """Refuses what leaves coordinates open: for good, or at a dead centre."""
    free = closure.free
    names = [closure.where.names[i] for i in free]
    jacobian = closure.equations(q)[1][:, free]
    if loose := undetermined(jacobian, names, RANK):
        raise refusal.open_ended(closure, loose, rank(jacobian, RANK))
    if loose := undetermined(jacobian, names, DEAD):
        raise messages.dead_centre(closure.case, loose)


def undetermined(jacobian: Array, names: list[str], below: float) -> list[str]:
    """The names of the unknowns that linear equations leave open."""
    if not jacobian.size:
        return names
    # What the smallest values that count leave of what is determined is as small as they are.
    loose = np.abs(null(jacobian, len(names), below))
    open_ = np.max(loose, axis=0, initial=0.0) > max(SAME, 10 * below)
    return [name for name, is_open in zip(names, open_, strict=True) if is_open]
