"""The equations that the positions at the start satisfy, and what the case gives of them.

Lengths are counted in the mechanism's size, so that a watch and a crane are treated alike.
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np

from ...cases.case import Case, Placement
from ...cases.scene import Anchor
from ..generated.constraint import Constraint, Lock, constraints
from ..generated.coordinates import Coordinates
from ..generated.rolling import Roll
from ..system import Array

POSITIONS = {"x": 0, "y": 1, "angle": 2}
RATES = {"vx": 0, "vy": 1, "omega": 2}


class Closure:
    """Residuals f (2.14) of the joints, contacts and placed points of one case at t = 0."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.where = Coordinates(case.scene)
        self.n = len(self.where.names)
        self.parts = constraints(case.scene, self.where)
        self.places = [c for c in self.parts if not isinstance(c, Roll)]  # C₁ of (2.17) is free
        self.locks = [c for c in self.parts if isinstance(c, Lock)]
        self.placed = placed(case.initial)
        self.given = held(self.locks, self.numbers(case.initial, POSITIONS))
        self.free = np.array([i for i in range(self.n) if i not in self.given], int)
        self.turning = self.where.turning
        self.reach = self._reach()
        self.size = self._size()
        self.rounding = max(1.0, self.reach / self.size)  # of places, in sizes
        self.units = np.where(self.turning, 1.0, self.size)  # of the coordinates: rad, or lengths

    def numbers(
        self, placements: Mapping[str, Placement], fields: Mapping[str, int]
    ) -> dict[int, float]:
        """Those of `fields` that are given, by their column in q or v."""
        return {
            self.where.columns[body][0] + fields[key]: value
            for body, placement in placements.items()
            for key, value in placement.given.items()
            if key in fields
        }

    def equations(self, q: Array) -> tuple[Array, Array]:
        """f = 0 in units of the mechanism's size: residuals (m,) and rows (m, n)."""
        numbers = q.tolist()
        residual = [self._residual(c, numbers) for c in self.places]
        rows = [self.rows(self.places, q)]
        for anchor, at in self.placed:
            p = self.where.point(anchor, 0.0, numbers, numbers)
            residual.append([(p.r[0] - at[0]) / self.size, (p.r[1] - at[1]) / self.size])
            place = np.zeros((2, self.n))
            assert p.xy is not None  # only bodies are placed
            place[[0, 1], [p.xy, p.xy + 1]] = 1.0
            if p.phi is not None:
                place[:, p.phi] = -p.d[1] / self.size, p.d[0] / self.size
            rows.append(place)
        return np.array([entry for part in residual for entry in part]), np.vstack(rows)

    def _residual(self, part: Constraint, q: list[float]) -> list[float]:
        if isinstance(part, Lock):  # a body turned once more is in the same place
            return [math.remainder(part.f(0.0, q)[0], math.tau)]
        return [entry / self.size for entry in part.f(0.0, q)]

    def rows(self, parts: Sequence[Constraint], q: Array) -> Array:
        """The rows f_a (2.15) of some constraints in units of the size, (r, n)."""
        return self.linear(parts, q)[0]

    def linear(self, parts: Sequence[Constraint], q: Array) -> tuple[Array, Array]:
        """The rows (r, n) and right sides g (r,) of f_a q̇ᵃ = g (2.15), in units of the size."""
        size = sum(c.size for c in parts)
        rows, g, at = np.zeros((size, self.n)), np.zeros(size), 0
        for c in parts:
            c.fill(0.0, q.tolist(), [0.0] * self.n, rows, g, np.zeros(size), at)
            at += c.size
        units = np.array([self.unit(c) for c in parts for _ in range(c.size)])
        return rows * self.units / units[:, None], g / units

    def unit(self, part: Constraint) -> float:
        """What a residual of 1 means: 1 rad for a held angle, else the mechanism's size [m]."""
        return 1.0 if isinstance(part, Lock) else self.size

    def _size(self) -> float:
        """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
        bodies = self.case.scene.bodies.values()
        lengths = [abs(x) for body in bodies for p in body.points.values() for x in p]
        lengths += [body.radius for body in bodies if body.radius]
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


def held(locks: Sequence[Lock], known: Mapping[int, float]) -> dict[int, float]:
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
