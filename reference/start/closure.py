"""The equations that the positions at the start satisfy, and what the case gives of them.

Lengths are counted in the mechanism's size, so that a watch and a crane are treated alike.
"""

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import NamedTuple

import numpy as np

from ...cases.case import Case, Placement
from ...cases.scene import Anchor, Joint, Signal, Vector
from ...cases.scene.joint import Freedom
from ...cases.scene.pair import Pair
from ...cases.scene.plane import LEVEL
from ..mechanism.constraints.constraint import Constraint, tracked
from ..mechanism.constraints.constraint_terms import (
    FIRST,
    SECOND,
    Along,
    Given,
    Line,
    Term,
    Turning,
)
from ..mechanism.constraints.equation_table import Table
from ..mechanism.constraints.joint_constraints import constraints, gliding
from ..mechanism.kinematics.coordinates import Coordinates
from ..mechanism.modes.unilateral import along, apart
from ..system import Array

POSITIONS = {"x": 0, "y": 1, "angle": 2}
FULL_TURN = 1e-9  # rad: −180° within rounding is written 180°
RATES = {"vx": 0, "vy": 1, "omega": 2}


class Lock(NamedTuple):
    """φ_b − φ_a = angle [rad]: the columns of the angles, None on the ground."""

    a: int | None
    b: int | None
    angle: float


class Closure:
    """Residuals f (2.14) of the joints, contacts and placed points of one case at t = 0."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.where = Coordinates(case.scene)
        self.n = len(self.where.names)
        self._tables: dict[tuple[int, ...], Table] = {}
        self.parts = constraints(case.scene, self.where)
        self.placed = placed(case.initial)
        self.places = [c for c in self.parts if c.holonomic]  # C₁ of (2.17) is free
        self.places += [_at(anchor, place, self.where) for anchor, place in self.placed]
        standing = [Anchor(b, point) for b, p in case.initial.items() for point in p.on]
        self.places += [_on_plane(anchor, self.where) for anchor in standing]
        self.posed = list(posed(case, self.where))
        self.places += self.posed
        self.gliding = [
            gliding(edge, speed, self.where)
            for name, edge in case.scene.constraints.items()
            if name in case.initial and (speed := case.initial[name].given.get("speed")) is not None
        ]
        self.gliding += moving(case, self.where)
        self.still = [part for anchor in standing for part in _still(anchor, self.where)]
        self.locks = [lock for c in (*self.parts, *self.posed) for lock in self._locks(c)]
        self.given = held_angles(self.locks, self.numbers(case.initial, POSITIONS))
        self.free = np.array([i for i in range(self.n) if i not in self.given], int)
        self.turning = self.where.turning
        self.reach = self._reach()
        self.size = self._size()
        self.rounding = max(1.0, self.reach / self.size)  # of places, in sizes
        self.units = np.where(self.turning, 1.0, self.size)  # of the coordinates: rad, or lengths

    def numbers(
        self, placements: Mapping[str, Placement], fields: Mapping[str, int]
    ) -> dict[int, float]:
        """The values of `fields` that are given, by their column in q or v."""
        return {
            self.where.columns[body][0] + fields[key]: value
            for body, placement in placements.items()
            for key, value in placement.given.items()
            if key in fields and body in self.where.columns
        }

    def equations(self, q: Array) -> tuple[Array, Array]:
        """f = 0 in units of the mechanism's size: residuals (m,) and rows (m, n)."""
        numbers = q.tolist()
        residual = [entry for c in self.places for entry in self._residual(c, numbers)]
        return np.array(residual), self.rows(self.places, q)

    def moved(self, q: Array, change: Array) -> Array:
        """q after a change (n,)."""
        return q + change

    def settled(self, q: Array) -> Array:
        """q with angles that nobody gave in (−π, π], or next to their guess; held ones follow."""
        near = self.numbers(self.case.near, POSITIONS)
        known = dict(self.given)
        for i in self.free[self.turning[self.free]].tolist():
            if i not in known:
                base = near.get(i, 0.0)
                turned = math.remainder(q[i] - base, math.tau)
                known[i] = base + (turned if turned > FULL_TURN - math.pi else turned + math.tau)
                known = held_angles(self.locks, known)
        q = q.copy()
        q[list(known)] = list(known.values())
        return q

    def apart(self, a: Array, b: Array) -> float:
        """The largest difference of two solutions, in sizes and rad."""
        off = (a - b).tolist()
        return max(abs(self.turned(i, x)) / self.units[i] for i, x in enumerate(off))

    def turned(self, column: int, difference: float) -> float:
        """The difference of two values of a coordinate, to whole turns of an angle."""
        return math.remainder(difference, math.tau) if self.turning[column] else difference

    def _residual(self, part: Constraint, q: list[float]) -> list[float]:
        return [
            math.remainder(f, math.tau) if angle else f / self.size  # a turn more is the same place
            for f, angle in zip(part.f(0.0, q), part.angular, strict=True)
        ]

    def _locks(self, part: Constraint) -> Iterator[Lock]:
        for angle, angular in zip(part.held or (), part.angular, strict=part.holonomic):
            if angular and angle is not None:
                a, b = (self.where.columns.get(end.body, (0, None))[1] for end in part.ends)
                yield Lock(a, b, angle)

    def rows(self, parts: Sequence[Constraint], q: Array) -> Array:
        """The rows f_a (2.15) of some constraints in units of the size, (r, n)."""
        return self.linear(parts, q)[0]

    def linear(self, parts: Sequence[Constraint], q: Array) -> tuple[Array, Array]:
        """The rows (r, n) and right sides g (r,) of f_a q̇ᵃ = g (2.15), in units of the size.

        What a residual of 1 means: 1 rad for a held angle, else the mechanism's size [m].
        """
        key = tuple(map(id, parts))
        if key not in self._tables:  # Newton asks for the same rows again and again
            self._tables[key] = Table(self.where, parts)
        f, g, _ = self._tables[key].rows(0.0, q, np.zeros(self.n))
        units = np.array([1.0 if angle else self.size for c in parts for angle in c.angular])
        return f * self.units / units[:, None], g / units

    def _size(self) -> float:
        """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
        bodies = self.case.scene.bodies.values()
        lengths = [abs(x) for body in bodies for p in body.points.values() for x in p]
        lengths += [body.radius for body in bodies if body.radius]
        lengths += [joint.length for joint in self.case.scene.joints.values() if joint.length]
        return max(lengths) or self.reach

    def _reach(self) -> float:
        """The largest given distance [m] from the origin: what rounding is relative to."""
        lengths = [x for p in self.case.scene.points.values() for x in p.at]
        lengths += [x for _, at in self.placed for x in at]
        lengths += [x for i, x in self.given.items() if not self.turning[i]]
        return max(map(abs, lengths), default=1.0) or 1.0


def placed(placements: Mapping[str, Placement]) -> list[tuple[Anchor, tuple[float, float]]]:
    """The points whose places are given."""
    return [
        (Anchor(body, point), at)
        for body, placement in placements.items()
        for point, at in placement.points.items()
    ]


def _at(anchor: Anchor, place: Vector, where: Coordinates) -> Constraint:
    """r_P = place, for the search only: nothing holds the point there later."""
    return replace(tracked(anchor, where), held=place)


def _on_plane(anchor: Anchor, where: Coordinates) -> Constraint:
    """n·r_P = n·r₀ of the plane or face that it touches, or of the floor; for the search only."""
    for pair in _pairs(anchor, where):
        return apart(pair, where)
    touching = (c.plane for c in where.scene.touching.values() if c.at == anchor)
    plane = next(touching, LEVEL)
    row, at = (Along(FIRST, plane.normal),), -plane.height(0.0, 0.0)
    return Constraint(str(anchor), (anchor,), (row,), ((),), (at,), where)


def _still(anchor: Anchor, where: Coordinates) -> list[Constraint]:
    """Neither slips nor rises where it stands: on the ground, or on another body that may move."""
    for pair in _pairs(anchor, where):
        return [apart(pair, where), along(pair, where)]
    return [_at(anchor, (0.0, 0.0), where)]


def _pairs(anchor: Anchor, where: Coordinates) -> list[Pair]:
    return [pair for pair in where.scene.pairs.values() if pair.at == anchor]


def held_angles(locks: Sequence[Lock], known: Mapping[int, float]) -> dict[int, float]:
    """The known angles, and those that slides and welds hold against them, on the same turn."""
    found = dict(known)
    for _ in locks:  # the longest chain
        for lock in locks:
            a = 0.0 if lock.a is None else found.get(lock.a)
            b = 0.0 if lock.b is None else found.get(lock.b)
            if lock.b is not None and b is None and a is not None:
                found[lock.b] = a + lock.angle
            elif lock.a is not None and a is None and b is not None:
                found[lock.a] = b - lock.angle
    return found


# The start of joints: places and rates of the second part against the first, where given.
#
# They hold at the start only.


Row = tuple[Term, ...]


def posed(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """φ_B − φ_A = angle, u·(r_B − r_A) = shift."""
    for joint, freedom in _freedoms(case):
        given = case.initial[joint.name].given
        if freedom.name in given:
            row, place = difference(freedom), given[freedom.name]
            yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), (place,), where)


def moving(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A = omega, d/dt u·(r_B − r_A) = speed."""
    for joint, freedom in _freedoms(case):
        rate = case.initial[joint.name].given.get(freedom.rate)
        if rate is not None:
            row = difference(freedom)
            given = Given(Signal("constant", (rate,)), angular=row[0].angular)
            yield Constraint(joint.name, (joint.a, joint.b), ((*row, given),), ((),), None, where)


def silent(case: Case, where: Coordinates) -> Iterator[Constraint]:
    """ω_B − ω_A and d/dt u·(r_B − r_A) of joints that give the place of these, and not the rate."""
    for joint, freedom in _freedoms(case):
        given = case.initial[joint.name].given
        if freedom.name in given and freedom.rate not in given:
            row = difference(freedom)
            yield Constraint(joint.name, (joint.a, joint.b), (row,), ((),), None, where)


def _freedoms(case: Case) -> Iterator[tuple[Joint, Freedom]]:
    """Yields the freedoms that have names, of the joints by which a part starts."""
    for joint in case.scene.joints.values():
        if joint.name in case.initial:
            yield from ((joint, freedom) for freedom in joint.rates.values())


def difference(freedom: Freedom) -> Row:
    """φ_B − φ_A, or u·(r_B − r_A) with u fixed in the first part."""
    if freedom.kind == "shift":
        return (Line(FIRST, SECOND, freedom.axis),)
    return Turning(SECOND), Turning(FIRST, -1.0)
