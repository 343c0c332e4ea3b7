"""The equations that the positions at the start satisfy in space, and what the case gives of them.

Lengths are counted in the mechanism's size, so that a watch and a crane are treated alike.
"""

from typing import Any

import numpy as np

from ....cases.case import Case
from ....cases.scene import Scene
from ...mechanism.modes.space.mode import SpatialMultibody
from ...system import Array
from .initial_conditions import Equation, Given

RANK = 1e-9  # singular values below this part of the largest count as zero


class SpatialClosure:
    """Residuals f (2.14) of what is held, and of what is given, of one case at t = 0."""

    def __init__(self, case: Case, scene: Scene) -> None:
        self.case, self.scene = case, scene
        self.mode = SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))
        self.where, self.constraints = self.mode.where, self.mode.constraints
        self.given = Given(case, self.mode)
        self.size = size_in_space(case, scene)
        self.units = np.where(self.where.turning, 1.0, self.size)

    def equations(self, q: Array) -> tuple[Array, Array, list[str]]:
        """Residuals (k,) in sizes or rad, their rows (k, n) in these units, and whose they are."""
        rows, _, _ = self.mode.rows(0.0, q, np.zeros(self.where.size))
        keep = self.constraints.holonomic
        residual, rows = self.mode.f(0.0, q), rows[keep]
        owners = [name for name, k in zip(self.constraints.owners, keep, strict=True) if k]
        scale = np.where(self.constraints.angular[keep], 1.0, self.size)
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

    def about_turn(self, equation: Equation) -> bool:
        """Whether an equation is about a turn: its row is of ω alone."""
        row, turning = equation.row, self.where.turning
        return bool(np.all(row[~turning] == 0.0)) and bool(np.any(row))

    def dependent(self, q: Array, below: float) -> str | None:
        """The first part, or drive, whose rows repeat what is held by those before it.

        Singular values `below` of the largest are zero.
        """
        rows, _, _ = self.mode.rows(0.0, q, np.zeros(self.where.size))
        scale = np.where(self.constraints.angular, 1.0, self.size)
        rows = rows * self.units / scale[:, None]
        owners = self.constraints.sources
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
    reach = [abs(x) for p in scene.points.values() for x in p.at]
    reach += [
        abs(x)
        for p in case.initial.values()
        for key, x in p.given.items()
        if key in ("x", "y", "z")
    ]
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
    s = np.linalg.svd(rows, compute_uv=False)
    return int(np.sum(s > below * s[0]))
