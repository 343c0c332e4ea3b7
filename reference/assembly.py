"""The start of a scene: what the case gives, and what the constraints make of it.

Positions by Newton's method from a guess, rates by linear algebra. Without a guess, seeded
starts look for a second way to assemble the same mechanism.
"""

import math
from collections.abc import Iterator, Mapping

import numpy as np

from cases.case import Case, Placement
from cases.mistake import CaseError, Mistake
from cases.scene import Anchor
from reference.constraint import Constraint, Roll, constraints
from reference.coordinates import Coordinates
from reference.system import Array

CLOSED = 1e-12  # residual relative to the mechanism's size; Newton reaches rounding or fails
RANK = 1e-9  # singular values below this part of the largest count as zero
SEEDS = 200  # starts from which a second assembly is looked for
SAME = 1e-6  # solutions nearer than this are the same one

_RATES = {"vx": 0, "vy": 1, "omega": 2}
_POSITIONS = {"x": 0, "y": 1, "angle": 2}


def assemble(case: Case) -> tuple[Array, Array]:
    """q (n,) and v (n,) at t = 0 in maximal coordinates.

    Raises CaseError if the constraints are not independent, the mechanism cannot be assembled
    or can be in two ways, or a coordinate or rate stays undetermined.
    """
    return Assembly(case).solve()


class Assembly:
    """The equations for the start of one case."""

    def __init__(self, case: Case) -> None:
        self.case = case
        self.where = Coordinates(case.scene)
        self.n = len(self.where.names)
        self.rows = constraints(case.scene, self.where)
        self.places = [c for c in self.rows if not isinstance(c, Roll)]  # C₁ of (2.17) is free
        self.given = self._given(case.initial, _POSITIONS)
        self.placed = [
            (Anchor(body, point), at)
            for body, placement in case.initial.items()
            for point, at in placement.points.items()
        ]
        self.free = np.array([i for i in range(self.n) if i not in self.given], int)

    def solve(self) -> tuple[Array, Array]:
        """The start, see `assemble`."""
        q = self._positions()
        self._independent(q)
        return q, self._rates(q)

    def _given(
        self, placements: Mapping[str, Placement], fields: Mapping[str, int]
    ) -> dict[int, float]:
        return {
            self.where.columns[body][0] + fields[key]: value
            for body, placement in placements.items()
            for key, value in placement.given.items()
            if key in fields
        }

    def _positions(self) -> Array:
        found: list[Array] = []
        nearest: tuple[float, Array] | None = None
        for guess in self._guesses():
            q, gap = self._newton(guess)
            if nearest is None or gap < nearest[0]:
                nearest = gap, q
            if gap < CLOSED and not any(self._same(q, other) for other in found):
                found.append(q)
        assert nearest is not None
        if not found:
            raise CaseError([self._cannot_close(nearest[1])])
        q = found[0]
        jacobian = self._equations(q)[1][:, self.free]
        self._determined(jacobian, [self.where.names[i] for i in self.free])
        if len(found) > 1:
            raise CaseError([self._two_ways(found)])
        return q

    def _guesses(self) -> Iterator[Array]:
        near = self._given(self.case.near, _POSITIONS)
        guess = np.zeros(self.n)
        for i, value in (near | self.given).items():
            guess[i] = value
        yield self._laid_out(guess)
        angles = [i for i in self.free if self.where.names[i].endswith(".angle")]
        if near or not angles:  # without free angles the equations are linear
            return
        rng = np.random.default_rng(seed=1)  # any: the same starts in every run
        for _ in range(SEEDS):
            guess[angles] = rng.uniform(-math.pi, math.pi, len(angles))
            yield self._laid_out(guess)

    def _laid_out(self, guess: Array) -> Array:
        """The guess with the places that fit its angles best: that much is linear."""
        q = guess.copy()
        near = self._given(self.case.near, _POSITIONS)
        columns = [i for i in self.free if not self.where.names[i].endswith(".angle")]
        columns = [i for i in columns if i not in near]
        residual, jacobian = self._equations(q)
        q[columns] -= np.linalg.lstsq(jacobian[:, columns], residual, rcond=None)[0]
        return q

    def _newton(self, guess: Array) -> tuple[Array, float]:
        """The root near the guess, and the residual left relative to the mechanism's size."""
        q = guess.copy()
        size = self._size()
        for _ in range(50):  # quadratic: more only where nothing closes
            residual, jacobian = self._equations(q)
            gap = float(np.max(np.abs(residual), initial=0.0)) / size
            if gap < 1e-3 * CLOSED or not len(self.free):
                break
            change = np.linalg.lstsq(jacobian[:, self.free], residual, rcond=RANK)[0]
            largest = np.max(np.abs(change), initial=0.0)
            if largest < 1e-15 * size:
                break
            q[self.free] -= change * min(1.0, size / largest)
        return self._wrapped(q), gap

    def _size(self) -> float:
        lengths = [abs(x) for b in self.case.scene.bodies.values() for p in b.points.values() for x in p]
        lengths += [abs(x) for p in self.case.scene.points.values() for x in p.at]
        return max([*lengths, *(abs(x) for x in self.given.values())], default=1.0) or 1.0

    def _wrapped(self, q: Array) -> Array:
        """Angles that nobody gave, brought into (−π, π] or next to their guess."""
        near = self._given(self.case.near, _POSITIONS)
        q = q.copy()
        for i in self.free:
            if self.where.names[i].endswith(".angle"):
                base = near.get(int(i), 0.0)
                q[i] = base + math.remainder(q[i] - base, 2 * math.pi)
        return q

    def _same(self, a: Array, b: Array) -> bool:
        return bool(np.max(np.abs(a - b)) < SAME * max(1.0, self._size()))

    def _equations(self, q: Array) -> tuple[Array, Array]:
        """Residuals of the constraints and of placed points, and their rows (·, n)."""
        numbers = q.tolist()
        residual = [entry for c in self.places for entry in c.f(0.0, numbers)]
        rows = [*_filled(self.places, numbers, self.n)]
        for anchor, at in self.placed:
            p = self.where.point(anchor, 0.0, numbers, numbers)
            residual += [p.r[0] - at[0], p.r[1] - at[1]]
            for axis in (0, 1):
                row = np.zeros(self.n)
                assert p.xy is not None  # only bodies are placed
                row[p.xy + axis] = 1
                if p.phi is not None:
                    row[p.phi] = (-p.d[1], p.d[0])[axis]
                rows.append(row)
        return np.array(residual), np.array(rows).reshape(len(residual), self.n)

    def _independent(self, q: Array) -> None:
        """Names the first joint whose constraints only repeat what others hold."""
        held = np.zeros((0, self.n))
        for c in self.rows:
            held = np.vstack([held, *(r for r in _filled([c], q.tolist(), self.n))])
            if np.linalg.matrix_rank(held, tol=RANK * np.linalg.norm(held)) < len(held):
                kind = "joints" if c.part in self.case.scene.joints else "contacts"
                raise CaseError(
                    [
                        self.case.mistake(
                            ("scene", kind, c.part),
                            "the constraints are not independent: what this one holds is held "
                            "by the others already, so its reaction has no single value; "
                            "leave it out or replace it by one that holds less",
                        )
                    ]
                )

    def _rates(self, q: Array) -> Array:
        given = self._given(self.case.initial, _RATES)
        rows = np.array(list(_filled(self.rows, q.tolist(), self.n))).reshape(-1, self.n)
        g = _drive(self.rows, q.tolist(), self.n)
        v = np.zeros(self.n)
        v[list(given)] = list(given.values())
        scale = max(1.0, float(np.max(np.abs(v))), float(np.max(np.abs(g), initial=0.0)))
        if np.max(np.abs(rows @ v - g), initial=0.0) <= CLOSED * scale:
            return v
        free = [i for i in range(self.n) if i not in given]
        v[free] += np.linalg.lstsq(rows[:, free], g - rows @ v, rcond=RANK)[0]
        if np.max(np.abs(rows @ v - g)) > CLOSED * scale * max(1.0, self._size()) * 10:
            raise CaseError(
                [
                    self.case.mistake(
                        ("initial",),
                        f"the rates violate {self._worst(rows @ v - g, self.rows)}: "
                        "no motion satisfies all that is given",
                    )
                ]
            )
        names = [_as_rate(self.where.names[i]) for i in free]
        self._determined(rows[:, free], names)
        return v

    def _determined(self, jacobian: Array, names: list[str]) -> None:
        """Names the coordinates or rates that the equations leave open."""
        if not names:
            return
        _, s, vt = np.linalg.svd(jacobian)
        rank = int(np.sum(s > RANK * max(1.0, s[0] if len(s) else 0.0)))
        open_ = np.max(np.abs(vt[rank:]), axis=0, initial=0.0) > SAME
        if rank < len(names):
            loose = [name for name, is_open in zip(names, open_, strict=True) if is_open]
            raise CaseError(
                [
                    self.case.mistake(
                        ("initial",),
                        f"{len(names) - rank} more needed: {', '.join(loose)} "
                        f"{'is' if len(loose) == 1 else 'are'} not determined by what is given "
                        "and the constraints",
                    )
                ]
            )

    def _worst(self, residual: Array, rows: list[Constraint]) -> str:
        owners = [c.part for c in rows for _ in range(c.size)]
        owners += [str(anchor) for anchor, _ in self.placed for _ in (0, 1)]
        return owners[int(np.argmax(np.abs(residual)))]

    def _cannot_close(self, q: Array) -> Mistake:
        residual = self._equations(q)[0]
        what = self._worst(residual, self.places)
        gap = float(np.max(np.abs(residual)))
        if len(self.free):
            why = "the mechanism cannot be assembled from what is given"
        else:
            why = "the initial state violates a constraint"
        return self.case.mistake(
            ("initial",), f"{why}: {what} stays open by {gap:.3g} (m, or rad for an angle)"
        )

    def _two_ways(self, found: list[Array]) -> Mistake:
        differ = np.abs(found[0] - found[1])
        angles = np.array([name.endswith(".angle") for name in self.where.names])
        i = int(np.argmax(np.where(angles | ~np.any(angles), differ, 0.0)))
        name = self.where.names[i]
        unit, factor = (" deg", 180 / math.pi) if angles[i] else (" m", 1.0)
        values = " or ".join(f"{q[i] * factor:.4g}{unit}" for q in found)
        return self.case.mistake(
            ("initial",),
            f"the mechanism can be assembled in {len(found)} ways: {name} = {values}; "
            f"say which by `near`, for instance near: {{{name.split('.')[0]}: "
            f"{{{name.split('.')[1]}: {found[0][i] * factor:.4g}{unit if angles[i] else ''}}}}}",
        )


def _filled(parts: list[Constraint], q: list[float], n: int) -> Iterator[Array]:
    for c in parts:
        rows = np.zeros((c.size, n))
        c.fill(0.0, q, [0.0] * n, rows, np.zeros(c.size), np.zeros(c.size), 0)
        yield from rows


def _drive(parts: list[Constraint], q: list[float], n: int) -> Array:
    """The right sides g of (2.15) at the start."""
    sides = []
    for c in parts:
        g = np.zeros(c.size)
        c.fill(0.0, q, [0.0] * n, np.zeros((c.size, n)), g, np.zeros(c.size), 0)
        sides += g.tolist()
    return np.array(sides)


def _as_rate(name: str) -> str:
    body, _, field = name.rpartition(".")
    return f"{body}.{ {'x': 'vx', 'y': 'vy', 'angle': 'omega'}[field]}".replace(" ", "")
