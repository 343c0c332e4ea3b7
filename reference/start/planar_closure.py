"""A start in the plane: angles that count their turns, points that stand on planes, guesses."""

import math
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import NamedTuple

import numpy as np

from ...cases.case import Case, Placement
from ...cases.scene import Anchor
from ...cases.scene.joint import Joint
from ...cases.scene.pair import Pair
from ...cases.scene.plane import LEVEL
from ..mechanism.constraints.constraint import Constraint, tracked
from ..mechanism.constraints.constraint_terms import FIRST, Along
from ..mechanism.constraints.joint_constraints import gliding
from ..mechanism.kinematics.coordinates import Coordinates
from ..mechanism.modes.unilateral import pair_normal, pair_tangent
from ..system import Array
from . import messages
from .closure import Closure, Coordinate, Equation, product_size, value_text
from .search import CLOSED, NEAR, rank

FULL_TURN = 1e-9  # rad: −180° within rounding is written 180°


class Lock(NamedTuple):
    """φ_b − φ_a = angle [rad]: the columns of the angles, None on the ground."""

    a: int | None
    b: int | None
    angle: float


class PlanarClosure(Closure):
    """q = v's columns: x, y and angle of each body."""

    seeds = 200  # starts from which other assemblies are looked for
    attitude_word = "angle"
    where: Coordinates

    def __init__(self, case: Case) -> None:
        self._standing = [Anchor(b, point) for b, p in case.initial.items() for point in p.on]
        super().__init__(case, Coordinates(case.scene))
        self.standing = [str(anchor) for anchor in self._standing]
        self._on = [_on_plane(anchor, self.where) for anchor in self._standing]
        self._still = [
            (anchor, part) for anchor in self._standing for part in _still(anchor, self.where)
        ]
        self._gliding = [
            gliding(edge, speed, self.where)
            for name, edge in case.scene.constraints.items()
            if name in case.initial and (speed := case.initial[name].given.get("speed")) is not None
        ]

    def givens(self) -> tuple[Mapping[int, float], Collection[int]]:
        """Returns what is given, and the angles that slides, welds and joints hold against it."""
        self._locks = [lock for part in self.parts for lock in self._held_by(part)]
        self._locks += self._turned(self.case.initial)
        self._guessed = self._turned(self.case.near)
        angles = held_angles(self._locks, self.body_coordinates(self.case.initial))
        return angles, angles.keys()

    def _turned(self, placements: Mapping[str, Placement]) -> list[Lock]:
        """Locks of the angles that placements give of joints."""
        said = [
            (self.scene.joints[name], placement.given["angle"])
            for name, placement in placements.items()
            if name in self.scene.joints and "angle" in placement.given
        ]
        return [Lock(self._column(j.a), self._column(j.b), angle) for j, angle in said]

    def _held_by(self, part: Constraint) -> Iterator[Lock]:
        for angle, angular in zip(part.held or (), part.angular, strict=part.holonomic):
            if angular and angle is not None:
                a, b = map(self._column, part.ends)
                yield Lock(a, b, angle)

    def _column(self, end: Anchor) -> int | None:
        return self.where.columns.get(end.body, (0, None))[1]

    def attitude_of(self, placement: Placement) -> Sequence[float] | None:
        """Returns the angle that a placement gives."""
        angle = placement.given.get("angle")
        return None if angle is None else (angle,)

    def turned(self, wanted: Sequence[float], q: Array, at: int) -> Sequence[float]:
        """Returns the difference [rad] of both angles."""
        return (float(q[at]) - wanted[0],)

    def turns(self, joint: Joint, q: Array) -> Iterator[Coordinate]:
        """Yields the turn of a joint, φ_B − φ_A."""
        for freedom in joint.turns:
            row, value = np.zeros(self.n), 0.0
            for end, sign in zip(joint.refers(), (-1.0, 1.0), strict=True):
                if (column := self._column(end)) is not None:
                    row[column] += sign
                    value += sign * float(q[column])
            yield Coordinate(freedom, value, row, 0.0)

    def equations_by_word(
        self, placements: Mapping[str, Placement], q: Array
    ) -> Iterator[Equation]:
        """Yields that the points which stand on planes are on them."""
        if placements is self.case.initial:
            for part in self._on:
                rows, _ = self._rows([part], q)
                yield Equation(part.part, float(part.f(0.0, q.tolist())[0]), rows[0])

    def rates_by_word(self, q: Array) -> Iterator[Equation]:
        """Yields the speeds of edges, and that the points which stand on planes do not move."""
        named = [(part.part, part) for part in self._gliding]
        for name, part in [*named, *((str(anchor), part) for anchor, part in self._still)]:
            rows, g = self._rows([part], q)
            yield from (Equation(name, -float(x), row) for row, x in zip(rows, g, strict=True))

    def moved(self, q: Array, change: Array) -> Array:
        """q after a change (n,)."""
        return q + change

    def settled(self, q: Array) -> Array:
        """q with angles that nobody gave in (−π, π], or next to their guess; held ones follow."""
        near = self.body_coordinates(self.case.near)
        known = dict(self.given)
        for i in self.free[self.turning[self.free]].tolist():
            if i not in known:
                base = held_angles(self._guessed, {**near, **known}).get(i, 0.0)
                turned = math.remainder(q[i] - base, math.tau)
                known[i] = base + (turned if turned > FULL_TURN - math.pi else turned + math.tau)
                known = held_angles(self._locks, known)
        q = q.copy()
        q[list(known)] = list(known.values())
        return q

    def difference(self, a: Array, b: Array) -> float:
        """The largest difference, to whole turns of angles."""
        pairs = zip((a - b).tolist(), self.turning.tolist(), strict=True)
        return max(
            abs(math.remainder(x, math.tau)) if turns else abs(x) / self.size for x, turns in pairs
        )

    # Guesses, and which of the ways that they lead to is meant.

    def guess(self) -> Array:
        """Returns the first guess: what is near, and the places that fit it best."""
        return self._laid_out(
            self._said(np.zeros(self.n)), keep=self.body_coordinates(self.case.near)
        )

    def several(self) -> bool:
        """Whether there may be more than one way to assemble it: some coordinate is to be found."""
        return bool(len(self.free))

    def beside_near(self, count: int) -> Iterator[Array]:
        """Yields guesses with what is near kept, ever less so, and the free angles anywhere."""
        near, rng = self.body_coordinates(self.case.near), np.random.default_rng(seed=1)
        kept = np.zeros(self.n)
        turned = [i for lock in self._guessed for i in (lock.a, lock.b) if i is not None]
        kept[[i for i in (*near, *turned) if i not in self.given]] = 1.0
        for k, q in enumerate(self._scattered(count, rng)):
            off = kept * self.units * rng.uniform(-NEAR, NEAR, self.n) * k / count
            yield self._laid_out(self._said(q) + off)

    def anywhere(self) -> Iterator[Array]:
        """Yields guesses with the free angles anywhere."""
        rng = np.random.default_rng(seed=1)  # any: the same starts in every run
        yield from map(self._laid_out, self._scattered(self.seeds, rng))

    def _scattered(self, count: int, rng: np.random.Generator) -> Iterator[Array]:
        """Yields q with what is given, and the free angles anywhere: without one all is linear."""
        angles = [i for i in self.free if self.turning[i]]
        rods = any(joint.swings for joint in self.scene.joints.values())
        places = [i for i in self.free if not self.turning[i]] if rods else []
        for _ in range(count if angles or places else 0):
            q = self.with_given(np.zeros(self.n))
            q[angles] = rng.uniform(-math.pi, math.pi, len(angles))
            q[places] = self.reach * rng.uniform(-2.0, 2.0, len(places))
            yield q

    def _said(self, q: Array) -> Array:
        """q with what is near and what is given in their places; a joint turns its second part."""
        known = {**self.body_coordinates(self.case.near), **self.given}
        locks = [*self._locks, *self._guessed]
        for a, b, _ in self._guessed:
            known = held_angles(locks, known)
            if a is not None and a not in known and b not in known:
                known = held_angles(locks, {**known, a: float(q[a])})
        q[list(known)] = list(known.values())
        return q

    def _laid_out(self, guess: Array, keep: Collection[int] = ()) -> Array:
        """The guess with the places that fit its angles best: that much is linear."""
        columns = [i for i in self.free if not self.turning[i] and i not in keep]
        q = guess.copy()
        residual, jacobian = self.equations(q)
        change = np.linalg.lstsq(jacobian[:, columns], residual, rcond=None)[0]
        q[columns] -= change * self.size
        return q

    def refuse_words(self) -> None:
        """Refuses nothing: each word of a start in the plane says something."""

    def is_assembly(self, q: Array) -> bool:
        """Returns True: in the plane every solution is one, for angles have no second zero."""
        return True

    def preferred(self, ways: list[Array]) -> list[Array]:
        """Returns all of the ways: in the plane none is preferred."""
        return ways

    def refuse_turns(self, q: Array) -> None:
        """Raises CaseError for a joint's angle that is whole turns from that of its bodies."""
        for name, placement in self.case.initial.items():
            for c in self.placed(name, placement, q):
                turn = c.value - placement.given[c.freedom.name]
                if c.freedom.kind == "turn" and abs(turn) > math.pi:
                    raise messages.another_turn(self.case, name, turn)

    # In which words.

    def distinguishing(self, ways: list[Array]) -> str:
        """The coordinate in which ways differ most: rather an angle, which is easier to guess."""
        differ = np.abs(ways[0] - ways[1])
        differ = np.where(self.turning, np.abs(np.sin(differ / 2)), differ / self.size)
        turning = self.turning & (differ > np.max(differ) / 10)
        return self.where.names[
            int(np.argmax(np.where(turning, differ, 0.0) if np.any(turning) else differ))
        ]

    def shown(self, q: Array, name: str) -> str:
        """Returns the value of a coordinate as a file has it, that of a body's angle too."""
        part, _, field = name.partition(".")
        at = self.where.columns.get(part, (0, None))[1]
        if field == "angle" and at is not None:
            return value_text(float(q[at]), "turn")
        return super().shown(q, name)

    def open_names(self, q: Array, loose: Array, small: float) -> list[str]:
        """The coordinates that change by more than `small` along the directions `loose` (k, n)."""
        return [self.where.names[i] for i in np.flatnonzero(np.max(np.abs(loose), axis=0) > small)]

    def refuse_rates(self, q: Array, v: Array) -> None:
        """Raises CaseError where a joint gives its place, and has a rate that nothing says.

        v: in units of the size.
        """
        held = self.velocities(q)
        free = [i for i in range(self.n) if i not in self.given_rates()]
        known = rank(held.rows[:, free])
        for name, placement in self.case.initial.items():
            for f, _, row, _ in self.placed(name, placement, q):
                angular = f.kind == "turn"
                (rate,) = self.scaled([Equation(name, 0.0, row, angular)]).rows
                moves = abs(rate @ v) > CLOSED * product_size(rate[None], v)
                if f.rate in placement.given or not moves:
                    continue
                if rank(np.vstack([held.rows, rate])[:, free]) > known:
                    raise messages.rate_unsaid(self.case, name, angular=angular)


def _on_plane(anchor: Anchor, where: Coordinates) -> Constraint:
    """n·r_P = n·r₀ of the plane or face that it touches, or of the floor."""
    for pair in _pairs(anchor, where):
        return pair_normal(pair, where)
    touching = (c.plane for c in where.scene.touching.values() if c.at == anchor)
    plane = next(touching, LEVEL)
    row, at = (Along(FIRST, plane.normal),), -plane.height(0.0, 0.0)
    return Constraint(str(anchor), (anchor,), (row,), ((),), (at,), where)


def _still(anchor: Anchor, where: Coordinates) -> list[Constraint]:
    """Constraints of a point that stands: it neither rises nor slips on ground or body."""
    for pair in _pairs(anchor, where):
        return [pair_normal(pair, where), pair_tangent(pair, where)]
    return [tracked(anchor, where)]


def _pairs(anchor: Anchor, where: Coordinates) -> list[Pair]:
    return [pair for pair in where.scene.pairs.values() if pair.at == anchor]


def held_angles(locks: Sequence[Lock], known: Mapping[int, float]) -> dict[int, float]:
    """The known angles, and those that slides and welds hold against them, on the same turn."""
    angles = dict(known)
    for _ in locks:  # the longest chain
        for lock in locks:
            a = 0.0 if lock.a is None else angles.get(lock.a)
            b = 0.0 if lock.b is None else angles.get(lock.b)
            if lock.b is not None and b is None and a is not None:
                angles[lock.b] = a + lock.angle
            elif lock.a is not None and a is None and b is not None:
                angles[lock.a] = b - lock.angle
    return angles
