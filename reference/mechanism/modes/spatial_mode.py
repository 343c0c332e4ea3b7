"""The multibody of a scene in space: turns that count, and how its equations are solved."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from ... import lapack
from ...system import Array, Pose, Vector
from ..constraints.leeway import Leeway, leeway
from ..forces.action import Gyroscopic
from ..forces.turning import turn_of
from ..kinematics.kinematics import Kinematics
from ..kinematics.spatial_coordinates import SpatialCoordinates, wound
from .loose import DEPENDENT, rank, unit
from .mode import Multibody


class SpatialMultibody(Multibody):
    """(2.23), (2.33) of all bodies, held together by multipliers.

    q holds r and a unit quaternion of each body in the scene's order, v holds ṙ and ω in body
    axes; a particle has neither quaternion nor ω. Behind them q has the angle of each turn that a
    torsion spring acts about, by its rate: it says which whole turns those of the attitudes have.
    """

    def __init__(self, scene: Any, start: tuple[Array, Array]) -> None:
        super().__init__(scene, start)
        if self.where.inner and len(start[0]) == len(self.where.names):  # nobody counts yet
            self._start = self._counted(start[0]), start[1]

    def _laid_out(self, scene: Any) -> SpatialCoordinates:
        return SpatialCoordinates(scene)

    def _beside(self) -> Sequence[Any]:
        return [Gyroscopic(body.name) for body in self.scene.bodies.values() if body.turns]

    def _prepare(self) -> None:
        tensors = [b.tensor for b in self.scene.bodies.values() if b.turns]
        J = np.array(tensors).reshape(-1, 3, 3)
        self._sizes = unit_sizes(self.where)
        self._equations = Equations(self.where.M, J, self._r)
        k = Kinematics(self.where)
        turns = [turn_of(k, force) for force in wound(self.scene).values()]
        self._angles = k.tape.compiled([turn.angle for turn in turns])
        self._turned = k.tape.compiled([turn.rate for turn in turns])

    def _counted(self, q: Array) -> Array:
        """q with the angle of each turn that counts, nearest to where its joint begins."""
        begins = []
        for name in self.where.inner:
            joint, _, freedom = name.partition(".")
            begins.append(self.scene.joints[joint].begins.get(freedom, 0.0))
        q = np.append(q, begins)
        return np.append(q[: len(self.where.names)], self._angles(0.0, q))

    def _inner_rates(self, t: Any, q: Vector, v: Vector) -> list[Any]:
        """(2.5) φ̇ of what is counted."""
        return self._turned(t, q, v)

    def solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) v̇ (n,) and the multipliers (r,)."""
        rows, _, gamma = self.rows(t, q, v)
        return self._equations.solve(rows, gamma, self.applied(t, q, v))

    def leeway(self, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that rows, and floors that only push, leave open; None: one of each."""
        rows, _, gamma = self.rows(t, q, v)
        if not len(rows) or independent(rows, self._sizes) == len(rows):
            return None
        Q = self.applied(t, q, v)
        _, multipliers, ways = solved(self.where.M, rows, gamma, Q, self._sizes)
        floors = [f"{name}.normal" for name in self.scene.contacts]
        return leeway(
            lambda each: self.reactions_from(t, q, v, each.tolist()),
            multipliers,
            ways,
            lambda forces: [forces[name] for name in floors],
        )

    def reactions_from(
        self, t: float, q: Array, v: Array, multipliers: Sequence[float]
    ) -> dict[str, float]:
        """(2.60) Forces and moments of first parts on second, by quantity, in ground axes."""
        reactions = {}
        for joint in self.scene.joints.values():
            names = ("fx", "fy", "fz", *(("mx", "my", "mz") if joint.holds_attitude else ()))
            reactions |= {f"{joint.name}.{name}": 0.0 for name in names}
        for each in (
            self._exerted(t, q.tolist(), multipliers),
            self.ingredients.moments(t, q, v),
        ):
            for name, value in each.items():
                reactions[name] = reactions.get(name, 0.0) + value
        return reactions

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k: the coordinates themselves, quaternions with the length 1.

        And the angles of counted turns, by quantity.
        """
        if not self.where.inner:
            return self.where.poses(q, v)
        angles = zip(self.where.inner, self._angles(t, q), strict=True)
        return self.where.poses(q, v) | {name: (phi,) for name, phi in angles}

    def place(self, poses: Mapping[str, Pose]) -> tuple[Any, Any]:
        """q and v of given poses: how another system's motion is read in these coordinates.

        With the turns that it tells.
        """
        q, v = self.where.place(poses)
        if not self.where.inner:
            return q, v
        near = zip(self.where.inner, self._counted(q)[len(q) :], strict=True)  # else as it begins
        return np.append(q, [poses.get(name, (phi,))[0] for name, phi in near]), v


# Rows in space that hold more than there is to hold: one motion, and forces that it leaves open.
#
# Two hinges about one line hold a bar along it twice. Which of them bears how much is for nobody to
# say (`leeway`), as in the plane.


def independent(rows: Array, sizes: Array) -> int:
    """How many of the rows (r, n) are independent, of velocities / sizes."""
    return rank(unit(rows * sizes)[0])


def unit_sizes(where: SpatialCoordinates) -> Array:
    """(n,) by which rates of turns are counted as speeds: the radius of gyration."""
    resists = np.array(where.masses)
    of_body = np.roll(resists, 3)  # a turn's stand behind its body's mass
    return np.where(where.turning, np.sqrt(of_body / resists), 1.0)


def solved(
    M: Array, rows: Array, gamma: Array, Q: Array, sizes: Array
) -> tuple[Array, Array, Array]:
    """v̇ (n,), the least λ (r,) that give it, and those (k, r) that together exert nothing."""
    even, each = unit(rows * sizes)
    across, s, along = np.linalg.svd(even)
    k = int(np.sum(s > DEPENDENT * s[0]))
    free = along[k:] * sizes  # (n − k, n), the ways that the rows leave
    a = sizes * (along[:k].T @ ((across.T @ (gamma / each))[:k] / s[:k]))
    if len(free):
        a = a + np.linalg.solve(free @ M @ free.T, free @ (Q - M @ a)) @ free
    multipliers = across[:, :k] @ ((along @ (sizes * (M @ a - Q)))[:k] / s[:k])
    return a, multipliers / each, across[:, k:].T / each


# M v̇ − λ_b f_aᵇ = Q with f_aᵇ v̇ᵃ = γᵇ (2.60): solved for both, M being always the same.


TURNS = 1  # of refinement: what the factors lose of a light body beside a heavy one comes back
NARROW = (
    1e-3  # of the largest pivot of f_a M⁻¹ f_b; a smaller one costs λ more than one turn brings
)


class Equations:
    """The equations of one mechanism. Those of λ alone, f_a M⁻¹ f_b, are by far the fewest.

    But M may be singular, as of a slender bar, which its neighbours keep from turning about itself:
    there, and wherever digits would be lost, v̇ and λ are solved for at once.
    """

    def __init__(self, M: Array, tensors: Array, count: int) -> None:
        n = len(M)
        self._n, self._saddle = n, np.zeros((n + count, n + count))
        self._saddle[:n, :n] = M
        regular = all(np.linalg.matrix_rank(J) == len(J) for J in tensors)
        self._inverse = np.linalg.inv(M) if regular else None

    def solve(self, rows: Array, gamma: Array, Q: Array) -> tuple[Array, Array]:
        """v̇ (n,) and λ (r,) of f_a (r, n), γ (r,) and Q (n,)."""
        if self._inverse is None:
            return self._together(rows, gamma, Q)
        a: Any = self._inverse.dot(Q)
        if not len(rows):
            return a, gamma
        by_mass: Any = rows.dot(self._inverse)
        factor, fails = lapack.dpotrf(by_mass.dot(rows.T))
        pivots = factor.diagonal().tolist()
        if fails or min(pivots) < NARROW * max(pivots):
            return self._together(rows, gamma, Q)
        multipliers = 0.0
        for _ in range(1 + TURNS):  # the nearest v̇, in M, that meets the rows
            change = lapack.dpotrs(factor, gamma - rows.dot(a))[0]
            a, multipliers = a + change.dot(by_mass), multipliers + change
        return a, np.asarray(multipliers)

    def _together(self, rows: Array, gamma: Array, Q: Array) -> tuple[Array, Array]:
        """Solves for v̇ and λ by one saddle-point matrix, without M⁻¹."""
        n, matrix = self._n, self._saddle.copy()
        matrix[n:, :n], matrix[:n, n:] = rows, rows.T
        right = np.concatenate((Q, gamma))
        lu, pivots, _ = lapack.dgetrf(matrix.T)  # symmetric: its transpose needs no copy
        solution, _ = lapack.dgetrs(lu, pivots, right)
        for _ in range(TURNS):
            solution = solution + lapack.dgetrs(lu, pivots, right - matrix @ solution)[0]
        return solution[:n], -solution[n:]
