"""The equations that the positions at the start satisfy in space, and what the case gives of them.

Lengths are counted in the mechanism's size, so that a watch and a crane are treated alike.
"""

from typing import Any

import numpy as np

from ....cases.case import Case
from ....cases.scene import Scene
from ...mechanism.constraints.constraint import residuals
from ...mechanism.constraints.equation_table import Table
from ...mechanism.modes.spatial_mode import SpatialMultibody
from ...system import Array
from .initial_conditions import PLACES, Equation, Given

RANK = 1e-9  # singular values below this part of the largest count as zero


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

    def equations(self, q: Array) -> tuple[Array, Array, list[str]]:
        """Residuals (k,) in sizes or rad, their rows (k, n) in these units, and whose they are."""
        keep = self.holonomic
        residual = np.array(residuals(self.table, self.parts, 0.0, q.tolist()))
        rows = self.rows(q)[0][keep]
        owners = [name for name, k in zip(self.owners, keep, strict=True) if k]
        scale = np.where(self.angular[keep], 1.0, self.size)
        found = list(self.given.places(self.case.initial, q))
        own = [1.0 if self.about_turn(e) else self.size for e in found]
        residual = np.concatenate([residual, [e.residual for e in found]])
        rows = np.vstack([rows, *(e.row for e in found)])
        scale = np.concatenate([scale, own])
        return (
            residual / scale,
            rows * self.units / scale[:, None],
            owners + [e.name for e in found],
        )

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


def least(rows: Array, right: Array) -> Array:
    """(n,) the smallest solution of rows · x = right, or what comes nearest to one."""
    found: Any = np.linalg.lstsq(rows, right, rcond=RANK)[0]
    return found


def null(rows: Array, n: int, below: float = RANK) -> Array:
    """(k, n) directions that the rows leave open; singular values `below` count as zero."""
    if not rows.size:
        return np.eye(n)
    _, s, vt = np.linalg.svd(rows)
    return vt[int(np.sum(s > below * s[0])) :]


def rank(rows: Array, below: float = RANK) -> int:
    """The number of singular values that are not zero: `below` of the largest."""
    if not rows.size:
        return 0
    s = np.linalg.svd(rows, compute_uv=False)
    return int(np.sum(s > below * s[0]))
