"""Any scene in space as a Mode, in maximal coordinates with multipliers (2.60)."""

import math
from collections.abc import Iterator, Mapping, Sequence
from typing import Any

import numpy as np

from .....cases.scene import Scene
from ....system import Array, Mass, Mode, Pose, Vector
from ...constraints.leeway import Leeway, leeway
from ...constraints.space.constraint_jacobian import SpatialRows
from ...constraints.space.equations import Equations
from ...constraints.space.joint_constraints import scene_constraints
from ...forces.space.action import Actions
from ...forces.space.turning import Turn, wound
from ...kinematics.space.attitude import cross, spin
from ...kinematics.space.coordinates import SpatialCoordinates
from ...kinematics.space.kinematics import Layout, carried
from ..loose import DEPENDENT, rank, unit


class SpatialMultibody(Mode):
    """(2.23), (2.33) of all bodies, held together by multipliers.

    q holds r and a unit quaternion of each body in the scene's order, v holds ṙ and ω in body
    axes; a particle has neither quaternion nor ω. Behind them q has the angle of each turn that a
    torsion spring acts about, by its rate: it says which whole turns those of the attitudes have.
    """

    stiff = False
    undetermined: Sequence[str] = ()

    def __init__(self, scene: Scene, start: tuple[Array, Array]) -> None:
        self.scene = scene
        self.where = SpatialCoordinates(scene)
        self._turns = wound(scene)
        self.coordinates = (*self.where.names, *self._turns)
        self.masses = {
            b.name: Mass(b.mass, b.tensor if b.turns else None) for b in scene.bodies.values()
        }
        self.layout = Layout(self.where)
        self._wound = [Turn(self.layout, force) for force in self._turns.values()]
        self._start = start
        if len(start[0]) == len(self.where.names):  # where there is a start, and nobody counts yet
            self._start = np.append(start[0], self._begun(*start)), start[1]
        self.constraints = SpatialRows(scene_constraints(scene), self.layout)
        self._actions = Actions(self.layout)
        self._m = np.array([mass.m for mass in self.masses.values()])
        begins = [at.r for at in self.where.columns.values()]
        self._places = np.add.outer(begins, range(3))  # (B, 3) of r in q
        self._weight = np.zeros(self.where.size)
        for body in scene.bodies.values():
            at = self.where.columns[body.name].r_dot
            self._weight[at : at + 3] = body.mass * np.asarray(scene.gravity)
        turning = [(self.where.columns[b.name].omega, b.tensor) for b in scene.bodies.values()]
        tensors = [J for at, J in turning if at is not None]
        self._J = np.array(tensors).reshape(-1, 3, 3)
        self._sizes = unit_sizes(self.where)
        self._equations = Equations(self.where.M, self._J, self.constraints.size)

    def start(self) -> tuple[Array, Array]:
        """The assembled start."""
        return self._start

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.5), (2.6) q̇ (m,): ṙ, and ½ q ∘ (0, ω); and φ̇ of what is counted."""
        rates = self.where.rates(q, v)
        if not self._wound:
            return rates
        bodies = self.layout.bodies(q, v)
        return np.append(rates, [turn.at(t, bodies).rate for turn in self._wound])

    def _begun(self, q: Array, v: Array) -> list[float]:
        """The angles at the start, each nearest to what the joint begins with."""
        bodies = self.layout.bodies(q, v)
        found = []
        for name, turn in zip(self._turns, self._wound, strict=True):
            joint, _, freedom = name.partition(".")
            begins = self.scene.joints[joint].begins.get(freedom, 0.0)
            phi = turn.at(0.0, bodies).angle
            found.append(phi + math.tau * round((begins - phi) / math.tau))
        return found

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) M v̇ = Q + λ_b f_aᵇ with f_aᵇ v̇ᵃ = γᵇ, (n,)."""
        return self.solve(t, q, v)[0]

    def solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) v̇ (n,) and the multipliers (r,)."""
        bodies = self.layout.bodies(q, v)
        rows, _, gamma = self.constraints.at(t, bodies)
        return self._equations.solve(rows, gamma, self._applied(t, v, bodies))

    def _applied(self, t: float, v: Array, bodies: Any) -> Array:
        """(2.23), (2.60) Q (n,): weights, forces, and −ω × J ω beside the moments."""
        Q = self._weight.copy()
        self._gyroscopic(v, Q)
        self._actions.enter(t, bodies, Q)
        return Q

    def _gyroscopic(self, v: Array, Q: Array) -> None:
        """(2.27), (2.33) Ḋ_c = J ω̇ + ω × J ω = M_c: −ω × J ω stands beside the moments."""
        if len(self._J):
            omega = v[self.where.spins]
            Q[self.where.spins] -= cross(omega, carried(self._J, omega))

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: the forces and moments of first parts on second, by quantity."""
        return self._told(t, self.layout.bodies(q, v), self.solve(t, q, v)[1])

    def leeway(self, t: float, q: Array, v: Array) -> Leeway | None:
        """The forces that rows, and floors that only push, leave open; None: one of each."""
        bodies = self.layout.bodies(q, v)
        rows, _, gamma = self.constraints.at(t, bodies)
        if not len(rows) or independent(rows, self._sizes) == len(rows):
            return None
        Q = self._applied(t, v, bodies)
        _, multipliers, ways = solved(self.where.M, rows, gamma, Q, self._sizes)
        floors = [f"{name}.normal" for name in self.scene.contacts]
        return leeway(
            lambda each: self._told(t, bodies, each),
            multipliers,
            ways,
            lambda forces: [forces[name] for name in floors],
        )

    def _told(self, t: float, bodies: Any, multipliers: Array) -> dict[str, float]:
        found = self.constraints.reactions(t, bodies, multipliers)
        for joint, M in self._actions.moments(t, bodies):
            for name, x in zip(("mx", "my", "mz"), M.tolist(), strict=True):
                found[f"{joint}.{name}"] = found.get(f"{joint}.{name}", 0.0) + x
        for joint in self.scene.joints.values():
            names = ("fx", "fy", "fz", *(("mx", "my", "mz") if joint.holds_attitude else ()))
            found = {f"{joint.name}.{name}": 0.0 for name in names} | found
        return found

    def rows(self, t: Any, q: Vector, v: Vector) -> tuple[Vector, Vector, Vector]:
        """(2.15) f_a (r, n) and g (r,), and γ (r,) of f_a v̇ᵃ = γ."""
        return self.constraints.at(t, self.layout.bodies(q, v))

    def _each(self, t: float, q: Array, v: Array) -> Iterator[Array]:
        yield self._weight
        turning = np.zeros(self.where.size)
        self._gyroscopic(v, turning)
        yield turning
        yield from self.forces(t, q, v)

    def forces(self, t: float, q: Array, v: Array) -> Iterator[Array]:
        """The generalized force (n,) of each force element by itself, in the scene's order."""
        yield from self._actions.alone(t, self.layout.bodies(q, v), self.where.size)

    def largest(self, t: float, q: Array, v: Array) -> Array:
        """The largest force [N] or moment [N m] along each velocity that comes from one force."""
        return np.max(np.abs(list(self._each(t, q, v))), axis=0)

    def terms(self, t: float, q: Array, v: Array) -> tuple[float, float]:
        """The largest acceleration [m/s² or rad/s²] and power [W] that one force gives alone."""
        largest, turning = self.largest(t, q, v), self.where.turning
        powers = [
            np.max(largest[kind], initial=0.0) * np.max(np.abs(v[kind]), initial=0.0)
            for kind in (turning, ~turning)
        ]
        return float(np.max(largest / np.array(self.where.masses))), float(np.max(powers))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k: the coordinates themselves, quaternions with the length 1.

        And the angles of counted turns, by quantity.
        """
        if not self._wound:
            return self.where.poses(q, v)
        bodies = self.layout.bodies(q, v)
        angles = [turn.at(t, bodies).angle for turn in self._wound]
        turned = {name: (phi,) for name, phi in zip(self._turns, angles, strict=True)}
        return self.where.poses(q, v) | turned

    def place(self, poses: Mapping[str, Pose]) -> tuple[Any, Any]:
        """q and v of given poses: how another system's motion is read in these coordinates.

        With the turns that it tells.
        """
        q, v = self.where.place(poses)
        if not self._wound:
            return q, v
        told = zip(self._turns, self._begun(q, v), strict=True)  # or as near as where they begin
        return np.append(q, [poses.get(name, (phi,))[0] for name, phi in told]), v

    def without_direction(self, t: float, q: Array, within: float) -> str | None:
        """The first force along a line that is shorter than that [m]."""
        return self._actions.meets(t, self.layout.bodies(q, np.zeros(self.where.size)), within)

    # The ingredients: the same mechanism from its energies and residuals alone.

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ ω·J ω [J] of the rates q̇ (m,) or (m, K)."""
        r_dot = v[self._places]  # (B, 3, …)
        energy = 0.5 * np.tensordot(self._m, (r_dot * r_dot).sum(axis=1), 1)
        if len(self._J):
            each = (..., *[None] * (np.ndim(v) - 1))  # one attitude for all of many rates
            q_k, rates = q[self.where.attitudes].T[each], np.moveaxis(v[self.where.attitudes], 1, 0)
            omega = spin(q_k, rates)  # (3, K, …)
            energy = energy + 0.5 * (omega * np.einsum("kij,jk...->ik...", self._J, omega)).sum(
                axis=(0, 1)
            )
        return energy

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c + Σ ½ c (λ − λ₀)² [J]."""
        energy: Any = 0.0
        for name, at in self.where.columns.items():
            r, m = q[at.r : at.r + 3], self.masses[name].m
            energy = energy - m * sum(g * x for g, x in zip(self.scene.gravity, r, strict=True))
        still = np.zeros(self.where.size)
        return energy + self._actions.potential(t, self.layout.bodies(q, still))

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = Σ ½ d λ̇² [W], λ̇ = Δ·Δ̇/λ, of the velocities v (n,)."""
        return 0.0 * v[0] + self._actions.dissipation(t, self.layout.bodies(q, v))

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q_a of pushes and torques, along the velocities v, (n,)."""
        kind = np.result_type(q, v, np.asarray(t))
        return self._actions.other(t, self.layout.bodies(q, v), self.where.size, kind)

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.10), (2.14) the residuals of what is holonomic, (≤ r,)."""
        return self.constraints.f(t, self.layout.bodies(q, np.zeros(self.where.size)))

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.55) the rows f_aᵇ, (r, n), of the velocities v."""
        return self.rows(t, q, np.zeros(self.where.size))[0]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) the right side f_aᵇ vᵃ = gᵇ of driven points and rates, (r,)."""
        return self.rows(t, q, np.zeros(self.where.size))[1]


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
