"""Exoskeleton spring over knee bends (fig 2.18): a shank that is driven about the knee.

q = φ, the bend; the thigh is the ground, and gravity plays no part. The rate is prescribed, so that
nothing is free: what is asked for is the torque of the drive.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector


@dataclass(frozen=True)
class DrivenKnee(Mode):
    """m [kg] and l [m] of the shank, c [N m/rad], d [N m s/rad]; φ̇ = A sin Ω t [rad/s].

    From φ = 0 on that is φ = φ₀ ½ (1 − cos Ω t) with φ₀ = 2 A/Ω.
    """

    m: float
    l: float  # the book's letter
    c: float
    d: float
    A: float
    Omega: float

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"shank": Mass(self.m, self.m * self.l**2 / 12)})

    def start(self) -> tuple[Array, Array]:
        """Straight, and at rest as the drive."""
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.15) differentiated: φ̈ = A Ω cos Ω t, (1,)."""
        return np.array([self.A * self.Omega * math.cos(self.Omega * t)])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) M = λ = ⅓ m l² φ̈ + c φ + d φ̇ [N m], and F = m r̈_c [N]."""
        (phi_dd,) = self.accelerations(t, q, v).tolist()
        phi, phi_d = float(q[0]), float(v[0])
        cos, sin, arm = math.cos(phi), math.sin(phi), self.m * self.l / 2
        return {
            "knee.torque": self.m * self.l**2 / 3 * phi_dd + self.c * phi + self.d * phi_d,
            "knee.fx": -arm * (phi_dd * sin + phi_d**2 * cos),
            "knee.fy": arm * (phi_dd * cos - phi_d**2 * sin),
        }

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.15) φ = (A/Ω) (1 − cos Ω t)."""
        phi = self.A / self.Omega * (1 - math.cos(self.Omega * t))
        return np.array([phi]), np.array([self.A * math.sin(self.Omega * t)])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ⅙ m l² φ̇² [J]."""
        return self.m * self.l**2 / 6 * v[0] ** 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c φ² [J]: what the spring stores, and returns."""
        return self.c * q[0] ** 2 / 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = ½ d φ̇² [W]."""
        return self.d * v[0] ** 2 / 2

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) φ̇ = g: the row (1, 1)."""
        return np.ones((1, 1)) + 0.0 * q[0]

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) A sin Ω t [rad/s], (1,)."""
        return np.array([self.A * np.sin(self.Omega * t)])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = ½ l (cos φ, sin φ), angle = φ."""
        x, y = self.l / 2 * np.cos(q[0]), self.l / 2 * np.sin(q[0])
        return {"shank": (x, y, q[0], -v[0] * y, v[0] * x, v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.27) spring and damper, as a moment on the shank."""
        x, y = self.l / 2 * math.cos(q[0]), self.l / 2 * math.sin(q[0])
        moment = float(-self.c * q[0] - self.d * v[0])
        return [Load("shank", (x, y), (0.0, 0.0), moment)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The knee, with what the drive exerts there."""
        names = ("knee.fx", "knee.fy", "knee.torque")
        return [Cut(names, None, "shank", (0.0, 0.0), moment=True)]
