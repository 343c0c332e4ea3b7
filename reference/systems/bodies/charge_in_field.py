"""Charge in a uniform magnetic field, and in a uniform force across it (Exercise 2.4).

q = (x, y). Without the force it goes round a circle; with it the circle drifts across the force.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Load, Mass, Mode, Pose, Vector


@dataclass(frozen=True)
class ChargeInField(Mode):
    """m [kg] with the charge e [C] in B e_z [T], from the origin with v0 e_x; F e_y acts on it."""

    m: float
    e: float
    B: float
    v0: float
    F: float

    coordinates = ("x", "y")

    def __post_init__(self) -> None:
        if self.e * self.B == 0.0:
            raise ValueError("without a charge or a field there is no magnetic force")
        object.__setattr__(self, "masses", {"electron": Mass(self.m, None)})

    def start(self) -> tuple[Array, Array]:
        """r(0) = 0, ṙ(0) = v₀ e_x."""
        return np.zeros(2), np.array([self.v0, 0.0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) m ẍ = e B ẏ, m ÿ = −e B ẋ + F [m/s²], (2,)."""
        omega = self.e * self.B / self.m
        return np.array([omega * v[1], self.F / self.m - omega * v[0]])

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.49) x = u t + (w/ω) sin ωt, y = (w/ω)(cos ωt − 1), u = F/(e B), w = v₀ − u, ω = e B/m.

        1 − cos ωt = 2 sin² ½ωt keeps its digits where t is short.
        """
        omega, u = self.e * self.B / self.m, self.F / (self.e * self.B)
        w, sin, cos = self.v0 - u, math.sin(omega * t), math.cos(omega * t)
        height = -2.0 * (w / omega) * math.sin(omega * t / 2) ** 2
        return np.array([u * t + w / omega * sin, height]), np.array([u + w * cos, -w * sin])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m (ẋ² + ẏ²) [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −F y [J]."""
        return -self.F * q[1]

    def V(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.49) V = ½ e B (y ẋ − x ẏ) [J]."""
        return self.e * self.B * (q[1] * v[0] - q[0] * v[1]) / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, y)."""
        return {"electron": (q[0], q[1], 0.0, v[0], v[1], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """The force, and e v × B e_z: across the velocity, to its right for e B > 0."""
        (x, y), (x_dot, y_dot) = q.tolist(), v.tolist()
        deflected = (self.e * y_dot * self.B, -self.e * x_dot * self.B)
        return [Load("electron", (x, y), force) for force in (deflected, (0.0, self.F))]
