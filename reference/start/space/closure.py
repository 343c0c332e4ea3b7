"""The equations that the positions at the start satisfy in space, and what the case gives of them.

Lengths are counted in the mechanism's size, so that a watch and a crane are treated alike.
"""

import numpy as np

from ....cases.case import Case
from ....cases.scene import Scene
from ...mechanism.constraints.constraint import residuals
from ...mechanism.constraints.equation_table import Table
from ...mechanism.modes.spatial_mode import SpatialMultibody
from ...system import Array
from ..search import rank
from .initial_conditions import PLACES, Equation, Given


class SpatialClosure:
    """Residuals f (2.14) of what is held, and of what is given, of one case at t = 0."""

    def __init__(self, case: Case, scene: Scene) -> None:
        self.case, self.scene = case, scene
        self.mode = SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))
        self.where = self.mode.where
        parts = self.mode.permanent
        self.parts, self.table = parts, Table(self.where, parts)  # of no force: a guess has none
        self.owners = [part.part for part in parts for _ in range(part.size)]
        self.sources = [part.source or part.part for part in parts for _ in range(part.size)]
        self.angular = np.array([each for part in parts for each in part.angular], bool)
        held = [part.held or (None,) * part.size for part in parts]
        self.holonomic = np.array([at is not None for each in held for at in each], bool)
        self.given = Given(case, self.mode)
        self.size = size_in_space(case, scene)
        self.rounding = max(1.0, _reach(case, scene) / self.size)  # of places, in sizes
        self.units = np.where(self.where.turning, 1.0, self.size)
        self.free = np.arange(self.where.size)

    def equations(self, q: Array) -> tuple[Array, Array]:
        """Residuals (k,) in sizes or rad, and their rows (k, n) in these units."""
        keep = self.holonomic
        residual = np.array(residuals(self.table, self.parts, 0.0, q.tolist()))
        rows = self.rows(q)[0][keep]
        scale = np.where(self.angular[keep], 1.0, self.size)
        found = list(self.given.places(self.case.initial, q))
        own = [1.0 if self.about_turn(e) else self.size for e in found]
        residual = np.concatenate([residual, [e.residual for e in found]])
        rows = np.vstack([rows, *(e.row for e in found)])
        scale = np.concatenate([scale, own])
        return residual / scale, rows * self.units / scale[:, None]

    def whose(self, q: Array) -> list[str]:
        """The name of each residual's part, or of what is given."""
        owners = [name for name, k in zip(self.owners, self.holonomic, strict=True) if k]
        return owners + [e.name for e in self.given.places(self.case.initial, q)]

    def moved(self, q: Array, change: Array) -> Array:
        """q after a small move (n,); quaternions keep the length 1."""
        q = q + self.where.rates(q, change)
        for at in self.where.attitudes:
            q[at] /= np.linalg.norm(q[at])
        return q

    def settled(self, q: Array) -> Array:
        """q: attitudes count no turns."""
        return q

    def apart(self, a: Array, b: Array) -> float:
        """The largest difference of two solutions, in sizes and rad."""
        one, other = (self.where.poses(q, np.zeros(self.where.size)) for q in (a, b))
        far = 0.0
        for name in one:
            p, s = np.array(one[name][:7], float), np.array(other[name][:7], float)
            turned = 2 * np.arccos(min(1.0, abs(float(p[3:] @ s[3:]))))
            far = max(far, float(np.max(np.abs(p[:3] - s[:3]))) / self.size, turned)
        return far

    def rows(self, q: Array) -> tuple[Array, Array]:
        """(2.15) f_a (r, n) and g (r,) of all that is held."""
        rows, g, _ = self.table.rows(0.0, q, np.zeros(self.where.size))
        return rows, g

    def about_turn(self, equation: Equation) -> bool:
        """Whether an equation is about a turn: its row is of ω alone."""
        row, turning = equation.row, self.where.turning
        return bool(np.all(row[~turning] == 0.0)) and bool(np.any(row))

    def dependent(self, q: Array, below: float) -> str | None:
        """The first part, or drive, whose rows repeat what is held by those before it.

        Singular values `below` of the largest are zero.
        """
        scale = np.where(self.angular, 1.0, self.size)
        rows = self.rows(q)[0] * self.units / scale[:, None]
        owners = self.sources
        held = np.zeros((0, rows.shape[1]))
        for part in dict.fromkeys(owners):
            mine = [i for i, owner in enumerate(owners) if owner == part]
            held = np.vstack([held, rows[mine]])
            if rank(held, below) < len(held):
                return part
        return None


def size_in_space(case: Case, scene: Scene) -> float:
    """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
    lengths = [abs(x) for body in scene.bodies.values() for p in body.points.values() for x in p]
    lengths += [body.radius for body in scene.bodies.values() if body.radius]
    if largest := max(lengths, default=0.0):
        return largest
    return _reach(case, scene)


def _reach(case: Case, scene: Scene) -> float:
    """The largest given distance [m] from the origin: what rounding is relative to."""
    reach = [abs(x) for p in scene.points.values() for x in p.at]
    starts = case.initial.values()
    reach += [abs(x) for p in starts for key, x in p.given.items() if key in PLACES]
    reach += [abs(x) for p in starts for place in p.points.values() for x in place]
    return max(reach, default=1.0) or 1.0
