"""A mechanism whose rows hold more than there is: its motion is known, and not all of its forces.

A ladder that sticks at both ends has four forces and three equations. Rows that repeat what others
hold change nothing of the motion, as long as they ask for the same; which of them bears how much is
for nobody to say (`leeway`).
"""

from collections.abc import Collection, Sequence
from typing import Any

import numpy as np

from ....cases.scene import Scene
from ...system import Array, Vector
from ..constraints.constraint import Constraint
from ..constraints.contact import Braking, Coulomb
from ..constraints.leeway import Leeway, Margins, leeway
from ..kinematics.coordinates import Coordinates
from .mode import Multibody, SingularPose

DEPENDENT = 1e-9  # of the largest singular value, of rows of the size 1: as at the start
APART = 1e-6  # of γ: rows that ask for accelerations so far apart contradict each other
STILL = 1e-4  # of what forces give alone: of less, what comes to rest leaves rounding
NONE = 1e-14  # of the largest, of rows times rows: by friction that leans, none is left


def even(rows: Array, where: Coordinates) -> Array:
    """The rows (r, n) without units: angles by the radius of gyration, each row of the size 1."""
    units = np.ones(len(where.masses))
    for name, (_, phi) in where.columns.items():
        if phi is not None:
            body = where.scene.bodies[name]
            units[phi] = np.sqrt(body.mass / body.moment)
    return unit(np.asarray(rows, dtype=np.float64) * units)[0]


def unit(rows: Array) -> tuple[Array, Array]:
    """The rows (r, n), each of the size 1, and what they are divided by for that (r,)."""
    sizes = np.linalg.norm(rows, axis=1)
    sizes = np.where(sizes > 0.0, sizes, 1.0)
    return rows / sizes[:, None], sizes


def rank(rows: Array) -> int:
    """How many of the rows (r, n) of the size 1 are independent."""
    if not len(rows):
        return 0
    s = np.linalg.svd(rows, compute_uv=False)
    return int(np.sum(s > DEPENDENT * s[0]))


class Loose(Multibody):
    """The multibody of a mode in which `rank` of the rows are independent.

    margins: the laws of its forces. Where another number of rows is independent, as a mechanism
    that leaves a dead centre finds them, the mode does not go on.
    """

    def __init__(
        self,
        scene: Scene,
        start: tuple[Array, Array],
        rank: int,
        margins: Margins,
        *,
        held: Sequence[Constraint] = (),
        braking: Sequence[Braking] = (),
        coulomb: Sequence[Coulomb] = (),
        slack: Collection[str] = (),
        base: Multibody | None = None,
    ) -> None:
        super().__init__(
            scene, start, held=held, braking=braking, coulomb=coulomb, slack=slack, base=base
        )
        self.rank, self.margins = rank, margins

    def solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) q̈ (n,), and of all multipliers (r,) that give it the least."""
        free = np.sqrt(self._M) * self.applied(t, q, v) / self._M
        rows, gamma, columns, sizes = self._scaled(t, q, v)
        across, s, along = np.linalg.svd(rows @ columns.T)
        own = (across.T @ (gamma - rows @ free))[: self.rank] / s[: self.rank]
        y = along[: self.rank].T @ own
        held, beside = self._halves(rows, gamma)  # of a body at rest both are exactly nothing
        a = held + beside.T @ (beside @ (free + y @ columns))
        return a / np.sqrt(self._M), y / sizes

    def _halves(self, rows: Array, gamma: Array) -> tuple[Array, Array]:
        """The least q̈ with f_a q̈ᵃ = γ, (n,) in M^½, and the ways that the rows leave, (k, n)."""
        across, s, ways = np.linalg.svd(rows)
        held = ways[: self.rank].T @ ((across.T @ gamma)[: self.rank] / s[: self.rank])
        return held, ways[self.rank :]

    def contradicts(self, t: float, q: Array, v: Array) -> bool:
        """Whether its rows ask for accelerations that there cannot be."""
        rows, gamma, _, _ = self._scaled(t, q, v)
        held, _ = self._halves(rows, gamma)
        free = rows @ (self.applied(t, q, v) / np.sqrt(self._M))
        small = max(np.max(np.abs(gamma)), STILL * np.max(np.abs(free)))
        return bool(np.max(np.abs(gamma - rows @ held)) > APART * small)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) Of the rows as many as are independent."""
        rows = super().f_a(t, q)
        return rows[self._kept(rows)]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) Their right sides."""
        return super().g(t, q)[self._kept(super().f_a(t, q))]

    def _kept(self, rows: Vector) -> Any:
        from scipy.linalg import qr

        pivots = qr(even(np.real(rows), self.where).T, mode="r", pivoting=True)[1]
        return np.sort(pivots[: self.rank])

    def idle(self, t: float, q: Array, v: Array) -> Array:
        """(k, r) multipliers that together exert nothing: what may be added to any.

        Raises SingularPose where rows depend on each other otherwise than when the mode began, or
        forces that are not determined would move something: friction that slides leans on them.
        """
        rows, _, columns, sizes = self._scaled(t, q, v)
        of_columns, s, _ = np.linalg.svd(columns)
        _, product, _ = np.linalg.svd(rows @ columns.T)
        if (
            rank(even(self.rows(t, q, v)[0], self.where)) != self.rank
            or product[self.rank - 1] <= NONE * product[0]
            or np.any(s[self.rank :] > DEPENDENT * s[0])
        ):
            raise SingularPose(self.owners[-1])
        return of_columns.T[self.rank :] / sizes

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) Of all forces that the laws allow those that are farthest from breaking one."""
        return self.leeway(t, q, v).inmost.forces

    def leeway(self, t: float, q: Array, v: Array) -> Leeway:
        """The forces that the laws allow at this state, with all that is left open of them."""
        multipliers, ways = self.solve(t, q, v)[1], self.idle(t, q, v)
        return leeway(
            lambda each: self.reactions_from(t, q, v, each.tolist()),
            multipliers,
            ways,
            self.margins,
        )

    def _scaled(self, t: float, q: Array, v: Array) -> tuple[Array, Array, Array, Array]:
        """f_a M^(−½), γ and what a unit of each multiplier exerts; and the rows' sizes (r,)."""
        rows, _, gamma = self.rows(t, q, v)
        columns: Any = self.holding.columns(t, q, v, rows)
        root = np.sqrt(self._M)
        each, sizes = unit(rows / root)
        return each, gamma / sizes, columns / root / sizes[:, None], sizes


def independent(mode: Multibody, t: float, q: Vector, v: Vector) -> int:
    """How many of a mode's rows are independent at a state."""
    return rank(even(mode.rows(t, q, v)[0], mode.where))
