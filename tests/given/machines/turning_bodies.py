"""Rigid bodies in space by a unit quaternion, with ω in body axes: v is not q̇."""

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from textmech.reference.laws.rotation import axes, quaternion_rates, spin
from textmech.reference.system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²
J = np.array([[0.31, -0.04, 0.05], [-0.04, 0.23, 0.03], [0.05, 0.03, 0.17]])  # kg m², about C
S = np.array([0.12, -0.2, 0.45])  # m, from the fixed point to C, in body axes
XYZ = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


@dataclass(frozen=True)
class FreeBody(Mode):
    """q = (r, quaternion), v = (ṙ, ω): under its weight, and a moment (1, 2, 3) t in body axes."""

    m: float = 1.7
    masses: Mapping[str, Mass] = field(default_factory=lambda: {"body": Mass(1.7, J)})
    coordinates = ("x", "y", "z", "q0", "q1", "q2", "q3")

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        return np.concatenate([v[:3], quaternion_rates(q[3:], v[3:])])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        omega = v[3:]
        M = t * np.array([1.0, 2.0, 3.0])
        return np.array([0.0, 0.0, -G, *np.linalg.solve(J, M - np.cross(omega, J @ omega))])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        omega = spin(q[3:], v[3:])
        return self.m * np.sum(v[:3] ** 2, axis=0) / 2 + np.sum(omega * (J @ omega), axis=0) / 2

    def U(self, t: Any, q: Vector) -> Any:
        return self.m * G * q[2]

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        return t * np.array([0.0, 0.0, 0.0, 1.0, 2.0, 3.0])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        return {"body": (*q, *v)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        M = t * np.array([1.0, 2.0, 3.0]) @ axes(q[3:])
        return [Load("body", tuple(q[:3]), (0.0, 0.0, -self.m * G), tuple(M))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        return []


@dataclass(frozen=True)
class Top(Mode):
    """q = quaternion, v = ω: a body that is no symmetric one, on a ball joint at the origin."""

    m: float = 1.7
    masses: Mapping[str, Mass] = field(default_factory=lambda: {"top": Mass(1.7, J)})
    coordinates = ("q0", "q1", "q2", "q3")

    def _J_O(self) -> Array:
        return J + self.m * (S @ S * np.eye(3) - np.outer(S, S))

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        return quaternion_rates(q, v)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        weight = -self.m * G * axes(q)[:, 2]
        M_O = np.cross(S, weight) - np.cross(v, self._J_O() @ v)
        omega_dot: Any = np.linalg.solve(self._J_O(), M_O)
        return omega_dot

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        omega = spin(q, v)
        return np.sum(omega * (self._J_O() @ omega), axis=0) / 2

    def U(self, t: Any, q: Vector) -> Any:
        return self.m * G * (S @ axes(q)[:, 2])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        E = axes(q)
        return {"top": (*(S @ E), *q, *(np.cross(v, S) @ E), *v)}

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        acceleration = np.cross(self.accelerations(t, q, v), S) + np.cross(v, np.cross(v, S))
        force = self.m * (acceleration @ axes(q) + [0.0, 0.0, G])
        return dict(zip(("tip.fx", "tip.fy", "tip.fz"), force.tolist(), strict=True))

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        return [Load("top", tuple(S @ axes(q)), (0.0, 0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        return [Cut(("tip.fx", "tip.fy", "tip.fz"), None, "top", (0.0, 0.0, 0.0), XYZ)]


def unit(random: np.random.Generator) -> Array:
    """Any attitude."""
    q = random.normal(size=4)
    return q / np.sqrt(q @ q)
