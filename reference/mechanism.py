"""Any planar scene as a System, in maximal coordinates with multipliers (2.60)."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from cases.scene import Damper, Push, Scene, Signal, Spring
from reference.constraint import constraints
from reference.coordinates import Coordinates
from reference.force import damper, spring
from reference.system import Array, Mass, Pose, System, Vector


class Mechanism(System):
    """Newton's and Euler's equations of all bodies, held together by multipliers.

    q holds x, y, angle of each body in the scene's order (a particle has no angle).
    """

    def __init__(self, scene: Scene, start: tuple[Array, Array]) -> None:
        self.scene = scene
        self.where = Coordinates(scene)
        self.coordinates = self.where.names
        self.masses = {b.name: Mass(b.mass, b.inertia) for b in scene.bodies.values()}
        self._start = start
        self._M = np.array(self.where.masses)
        self._constraints = constraints(scene, self.where, start[0].tolist())
        self._r = sum(c.size for c in self._constraints)
        self._weight = np.zeros(len(self._M))
        for body in scene.bodies.values():
            xy, _ = self.where.columns[body.name]
            self._weight[xy : xy + 2] = body.mass * np.asarray(scene.gravity)

    def start(self) -> tuple[Array, Array]:
        """The assembled start."""
        return self._start

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) M q̈ = Q + λ_b f_aᵇ with f_aᵇ q̈ᵃ = γᵇ, (n,)."""
        return self._solve(t, q, v)[0]

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) R_a = λ_b f_aᵇ: the force of the first part on the second, by quantity."""
        multipliers = self._solve(t, q, v)[1].tolist()
        at, found, numbers = 0, {}, q.tolist()
        for c in self._constraints:
            found |= c.reactions(t, numbers, multipliers[at : at + c.size])
            at += c.size
        return found

    def _solve(self, t: float, q: Array, v: Array) -> tuple[Array, Array]:
        numbers, rates = q.tolist(), v.tolist()
        Q = self._forces(t, numbers, rates)
        rows, _, gamma = self._rows(t, numbers, rates, float)
        free = Q / self._M
        if not self._r:
            return free, np.zeros(0)
        by_mass = rows / self._M
        multipliers = np.linalg.solve(by_mass @ rows.T, gamma - rows @ free)
        return free + multipliers @ by_mass, multipliers

    def _rows(
        self, t: Any, q: Sequence[Any], v: Sequence[Any], dtype: type
    ) -> tuple[Any, Any, Any]:
        rows = np.zeros((self._r, len(self._M)), dtype)
        g, gamma = np.zeros(self._r, dtype), np.zeros(self._r, dtype)
        at = 0
        for c in self._constraints:
            c.fill(t, q, v, rows, g, gamma, at)
            at += c.size
        return rows, g, gamma

    def _forces(self, t: float, q: Sequence[float], v: Sequence[float]) -> Array:
        Q = self._weight.copy()
        for force in self.scene.forces.values():
            if isinstance(force, Spring | Damper):
                a, b = (self.where.point(end, t, q, v) for end in (force.a, force.b))
                d = (b.r[0] - a.r[0], b.r[1] - a.r[1])
                if isinstance(force, Spring):
                    F = spring(force.stiffness, force.rest_length, d)
                else:
                    d_dot = (b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1])
                    F = damper(force.damping, d, d_dot)
                ends = ((1, a), (-1, b))
            elif isinstance(force, Push):
                F = signal(force.signal, t)
                ends = ((1, self.where.point(force.at, t, q, v)),)
            else:
                phi = self.where.columns[force.body][1]
                Q[phi] += signal(force.signal, t)[0]
                continue
            for sign, p in ends:
                if p.xy is not None:
                    Q[p.xy] += sign * F[0]
                    Q[p.xy + 1] += sign * F[1]
                if p.phi is not None:
                    Q[p.phi] += sign * (p.d[0] * F[1] - p.d[1] * F[0])
        return Q

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R_k, E_k: the coordinates themselves."""
        return {
            name: (
                q[xy],
                q[xy + 1],
                0.0 if phi is None else q[phi],
                v[xy],
                v[xy + 1],
                0.0 if phi is None else v[phi],
            )
            for name, (xy, phi) in self.where.columns.items()
        }

    def place(self, poses: Mapping[str, Pose]) -> tuple[Array, Array]:
        """q and v of given poses: how another system's motion is read in these coordinates."""
        q, v = np.zeros(len(self._M)), np.zeros(len(self._M))
        for name, (xy, phi) in self.where.columns.items():
            x, y, angle, vx, vy, omega = poses[name]
            q[xy : xy + 2], v[xy : xy + 2] = (x, y), (vx, vy)
            if phi is not None:
                q[phi], v[phi] = angle, omega
        return q, v

    # The ingredients: the same mechanism from its energies and residuals alone.

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ Σ m ṙ_c² + ½ Σ J ω² [J]."""
        return 0.5 * np.sum(self._M * v * v)

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −Σ m g·r_c + Σ ½ c (λ − λ₀)² [J]."""
        energy = -np.sum(self._weight * q)
        for force in self.scene.springs():
            energy = energy + 0.5 * force.stiffness * (
                self._length(force, t, q) - force.rest_length
            ) ** 2
        return energy

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = Σ ½ d λ̇² [W], λ̇ = Δ·Δ̇/λ."""
        power = 0.0 * v[0]
        for force in self.scene.dampers():
            a, b = (self.where.point(end, t, q.tolist(), v.tolist()) for end in (force.a, force.b))
            x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
            along = x * (b.r_dot[0] - a.r_dot[0]) + y * (b.r_dot[1] - a.r_dot[1])
            power = power + 0.5 * force.damping * along * along / (x * x + y * y)
        return power

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q_a = Σ F·∂r/∂qᵃ of pushes and torques, (n,)."""
        Q = np.zeros(len(q), np.result_type(q, v, t))
        for force in self.scene.signals():
            F = signal(force.signal, t)
            if isinstance(force, Push):
                p = self.where.point(force.at, t, q.tolist(), v.tolist())
                Q[p.xy] += F[0]
                Q[p.xy + 1] += F[1]  # type: ignore[operator]  # a push acts on a body
                if p.phi is not None:
                    Q[p.phi] += p.d[0] * F[1] - p.d[1] * F[0]
            else:
                Q[self.where.columns[force.body][1]] += F[0]
        return Q

    def _length(self, force: Spring, t: Any, q: Vector) -> Any:
        a, b = (self.where.point(end, t, q.tolist(), q.tolist()) for end in (force.a, force.b))
        x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
        return np.sqrt(x * x + y * y)

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) the residuals of all joints and contacts, (r,)."""
        return np.array([entry for c in self._constraints for entry in c.f(t, q.tolist())])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) the rows f_aᵇ, (r, n)."""
        return self._rows(t, q.tolist(), q.tolist(), np.result_type(q, t))[0]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) the right side f_aᵇ q̇ᵃ = gᵇ of driven points, (r,)."""
        return self._rows(t, q.tolist(), q.tolist(), np.result_type(q, t))[1]


def signal(law: Signal, t: Any) -> tuple[Any, ...]:
    """A push's components [N] or a torque [N m] at time t: A, A t or A sin(w t + phase)."""
    if law.law == "constant":
        return law.amplitude
    size = t if law.law == "ramp" else np.sin(law.angular_frequency * t + law.phase)
    return tuple(entry * size for entry in law.amplitude)
