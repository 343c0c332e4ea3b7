"""Wheel rolling on a line (Example 2.1), pushed at its centre or running down an incline.

q = (x_c, y_c, φ) as in the book: φ counts the rolling to the right, which is clockwise, so the
angle of the body is −φ. The x axis points down the slope of angle β.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class RollingWheel(Mode):
    """Thin disk [kg, m] with a force F [N] at its centre; v0 = R w0 or it would not roll."""

    m: float
    R: float
    mu: float  # friction of the floor: must only be enough
    beta: float
    F: float
    v0: float
    w0: float

    coordinates = ("x_c", "y_c", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"wheel": Mass(self.m, self._J33())})

    def _J33(self) -> float:
        """(2.32) J₃₃ = m R²/2 [kg m²] (Exercise 2.2)."""
        return self.m * self.R**2 / 2

    def start(self) -> tuple[Array, Array]:
        """x_c = 0 on the floor, rolling with v0 [m/s] and w0 [rad/s]."""
        return np.array([0.0, self.R, 0.0]), np.array([self.v0, 0.0, self.w0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) (m + J₃₃/R²) ẍ_c = F + m g sin β, ÿ_c = 0, R φ̈ = ẍ_c [m/s², rad/s²], (3,)."""
        drive = self.F + self.m * G * math.sin(self.beta)
        x_ddot = drive / (self.m + self._J33() / self.R**2)
        return np.array([x_ddot, 0.0, x_ddot / self.R])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ₁ = −J₃₃ φ̈/R, λ₂ = m g cos β [N]: the floor's force on the wheel."""
        phi_ddot = float(self.accelerations(t, q, v)[2])
        return {
            "touch.tangent": -self._J33() * phi_ddot / self.R,
            "touch.normal": self.m * G * math.cos(self.beta),
        }

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.18) x_c = v₀ t + ½ a t², y_c = R, φ = w₀ t + ½ (a/R) t²; 3/2 m a = F + m g sin β."""
        a = (self.F / self.m + G * math.sin(self.beta)) / 1.5
        x, phi = self.v0 * t + a * t**2 / 2, self.w0 * t + a * t**2 / (2 * self.R)
        u, w = self.v0 + a * t, self.w0 + a * t / self.R
        return np.array([x, self.R, phi]), np.array([u, 0.0, w])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ẋ_c² + ẏ_c²) + ½ J₃₃ φ̇² [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + self._J33() * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (y_c cos β − x_c sin β) [J]."""
        return self.m * G * (q[1] * math.cos(self.beta) - q[0] * math.sin(self.beta))

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = (F, 0, 0) [N, N, N m]."""
        return np.array([self.F, 0.0, 0.0])

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.18) x_c − R φ = 0, y_c − R = 0 [m], (2,)."""
        return np.array([q[0] - self.R * q[2], q[1] - self.R])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.17) ẋ_c − R φ̇ = 0, ẏ_c = 0: rows (2, 3)."""
        return np.array([[1.0, 0.0, -self.R], [0.0, 1.0, 0.0]])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x_c, y_c), angle = −φ."""
        return {"wheel": (q[0], q[1], -q[2], v[0], v[1], -v[2])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g in the axes of the slope, and the push, at the centre."""
        centre = (float(q[0]), float(q[1]))
        weight = self.m * G
        down = (weight * math.sin(self.beta), -weight * math.cos(self.beta))
        return [Load("wheel", centre, down), Load("wheel", centre, (self.F, 0.0))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The point of the wheel that touches the floor."""
        touch = (float(q[0]), float(q[1]) - self.R)
        return [Cut(("touch.tangent", "touch.normal"), None, "wheel", touch)]
