"""Slender bar hinged at its end O, swinging through a large angle.

q = (φ,), the angle of the bar against the x axis: hanging is φ = −π/2.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector
from ..elliptic import jacobi

G = 9.80665  # m/s²


@dataclass(frozen=True)
class BarPendulum(Mode):
    """Bar of mass m [kg] and length l [m], released from rest at phi0 [rad]."""

    m: float
    l: float
    phi0: float

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"bar": Mass(self.m, self.m * self.l**2 / 12)})

    def _J_O(self) -> float:
        """(2.35) J_O = J_c + m (l/2)² = m l²/12 + m l²/4 [kg m²]."""
        return self.m * self.l**2 / 12 + self.m * self.l**2 / 4

    def start(self) -> tuple[Array, Array]:
        """At rest at phi0."""
        return np.array([self.phi0]), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34) J_O φ̈ = −m g (l/2) cos φ [rad/s²], (1,)."""
        return np.array([-self.m * G * self.l / 2 * math.cos(q[0]) / self._J_O()])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) F = m r̈_c − m g [N], r̈_c = (l/2)(φ̈ e_φ − φ̇² e_r): the ground on the bar."""
        phi_dot, phi_ddot = float(v[0]), float(self.accelerations(t, q, v)[0])
        cos, sin = math.cos(q[0]), math.sin(q[0])
        x_ddot = -self.l / 2 * (sin * phi_ddot + cos * phi_dot**2)
        y_ddot = self.l / 2 * (cos * phi_ddot - sin * phi_dot**2)
        return {"hinge.fx": self.m * x_ddot, "hinge.fy": self.m * (y_ddot + G)}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.34) tan(θ/2) = k cn(Ωt)/k′, θ̇ = −2Ω k k′ sn/dn: θ from hanging, Ω² = 3g/(2l).

        k = sin(θ₀/2), k′ = cos(θ₀/2). The tangent keeps θ accurate where sin(θ/2) = k cn/dn
        is near 1, and k′ is used as it is: 1 − k² would lose its digits near the top.
        """
        theta0 = math.remainder(self.phi0 + math.pi / 2, 2 * math.pi)
        k, k1 = math.sin(theta0 / 2), math.cos(theta0 / 2)
        Omega = math.sqrt(3 * G / (2 * self.l))
        sn, cn = jacobi(Omega * t, k1)
        dn = math.sqrt(k1 * k1 + k * k * cn * cn)
        theta = 2 * math.atan2(k * cn, k1)
        return np.array([self.phi0 + (theta - theta0)]), np.array([-2 * Omega * k * k1 * sn / dn])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ J_O φ̇², J_O = m l²/3 [J]."""
        return self.m * self.l**2 / 6 * v[0] ** 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (l/2) sin φ [J]."""
        return self.m * G * self.l / 2 * np.sin(q[0])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (l/2)(cos φ, sin φ)."""
        x, y = self.l / 2 * np.cos(q[0]), self.l / 2 * np.sin(q[0])
        return {"bar": (x, y, q[0], -y * v[0], x * v[0], v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g at the centre."""
        x, y, *_ = self.poses(t, q, v)["bar"]
        return [Load("bar", (x, y), (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hinge O."""
        return [Cut(("hinge.fx", "hinge.fy"), None, "bar", (0.0, 0.0))]
