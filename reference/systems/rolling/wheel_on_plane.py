"""A wheel that rolls upright on a plane (Example 2.2), whatever drives it.

q = (x, y, θ, φ): the centre, the heading θ about z, and φ about the axle. Unit vectors
e = (cos θ, sin θ, 0) forward and n = (−sin θ, cos θ, 0) along the axle, to the left. With the axle
to the left, φ̇ > 0 rolls forward. The x axis points down the slope of angle α; z is across it.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class WheelOnPlane(Mode):
    """Thin disk [kg, m] on the slope alpha [rad], which starts with w and Omega [rad/s]."""

    m: float
    R: float
    mu: float  # friction of the floor: must only be enough
    alpha: float
    w: float
    Omega: float

    coordinates = ("x", "y", "theta", "phi")

    def __post_init__(self) -> None:
        d = self.diameter()
        J = np.diag([d, self.axle(), d])
        object.__setattr__(self, "masses", {"wheel": Mass(self.m, J)})

    def start(self) -> tuple[Array, Array]:
        """At the origin, rolling along x with R w [m/s]."""
        return np.zeros(4), np.array([self.R * self.w, 0.0, self.Omega, self.w])

    def axle(self) -> float:
        """(2.32) J₂₂ = m R²/2 [kg m²] about the axle (Exercise 2.2, there the third axis)."""
        return self.m * self.R**2 / 2

    def diameter(self) -> float:
        """(2.32) J₁₁ = J₃₃ = m R²/4 [kg m²] about any diameter (Exercise 2.2)."""
        return self.m * self.R**2 / 4

    def rolling(self, q: Array, v: Array, theta_ddot: float, phi_ddot: float) -> Array:
        """(2.20) ẍ = R (φ̈ cos θ − φ̇ θ̇ sin θ), ÿ = R (φ̈ sin θ + φ̇ θ̇ cos θ) [m/s²], q̈ (4,)."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        forward, left = self.R * phi_ddot, self.R * float(v[3]) * float(v[2])
        x_ddot, y_ddot = forward * cos - left * sin, forward * sin + left * cos
        return np.array([x_ddot, y_ddot, theta_ddot, phi_ddot])

    def guide_reactions(self, q: Array, v: Array, a: Array) -> dict[str, float]:
        """(2.23), (2.27) F = m (r̈_c − g), M = Ḋ_c + R e_z × F: what floor and guide exert [N, N m].

        D_c = J₃₃ θ̇ e_z + J₂₂ φ̇ n, so that Ḋ_c = J₃₃ θ̈ e_z + J₂₂ (φ̈ n − φ̇ θ̇ e). M is the guide's
        about the centre, with the drives' torques in it: M_z turns the heading, M·n the wheel, and
        M·e = −J₂₂ φ̇ θ̇ − R F·n is the couple that holds it upright.
        """
        cos, sin = math.cos(q[2]), math.sin(q[2])
        fx = self.m * (float(a[0]) - G * math.sin(self.alpha))
        fy = self.m * float(a[1])
        along, side = fx * cos + fy * sin, fy * cos - fx * sin
        couple = -self.axle() * float(v[3]) * float(v[2]) - self.R * side
        drive = self.axle() * float(a[3]) + self.R * along
        return {
            "touch.fx": fx,
            "touch.fy": fy,
            "touch.normal": self.m * G * math.cos(self.alpha),
            "touch.along": along,
            "touch.side": side,
            "upright.mx": couple * cos - drive * sin,
            "upright.my": couple * sin + drive * cos,
            "upright.mz": self.diameter() * float(a[2]),
        }

    def rows(self, q: Vector) -> list[list[Any]]:
        """(2.20) ẋ − R φ̇ cos θ = 0, ẏ − R φ̇ sin θ = 0: two rows of 4, λ = (F_x, F_y)."""
        x, y = -self.R * np.cos(q[2]), -self.R * np.sin(q[2])
        return [[1.0, 0.0, 0.0, x], [0.0, 1.0, 0.0, y]]

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ẋ² + ẏ²) + ½ J₃₃ θ̇² + ½ J₂₂ φ̇² [J]."""
        turning = self.diameter() * v[2] ** 2 + self.axle() * v[3] ** 2
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + turning / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g (R cos α − x sin α) [J]."""
        return self.m * G * (self.R * math.cos(self.alpha) - q[0] * math.sin(self.alpha))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, y, R); E₁ by the turns θ about z, then φ about the axle.

        The quaternion is (cos θ/2, 0, 0, sin θ/2) ∘ (cos φ/2, 0, sin φ/2, 0), and in body axes
        ω = (−θ̇ sin φ, φ̇, θ̇ cos φ).
        """
        (ct, cp), (st, sp) = np.cos(q[2:] / 2), np.sin(q[2:] / 2)
        attitude = (ct * cp, -st * sp, ct * sp, st * cp)
        omega = (-v[2] * np.sin(q[3]), v[3], v[2] * np.cos(q[3]))
        return {"wheel": (q[0], q[1], self.R, *attitude, v[0], v[1], 0.0, *omega)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight m g, down the slope and onto it, at the centre."""
        down = (math.sin(self.alpha), 0.0, -math.cos(self.alpha))
        force = tuple(self.m * G * x for x in down)
        return [Load("wheel", (float(q[0]), float(q[1]), self.R), force)]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The rim's lowest point, and the couple about e that holds the wheel upright."""
        x, y, forward = float(q[0]), float(q[1]), (math.cos(q[2]), math.sin(q[2]), 0.0)
        axes = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
        floor = ("touch.fx", "touch.fy", "touch.normal")
        couple = Cut(("upright.couple",), None, "wheel", (x, y, self.R), (), moments=(forward,))
        return [Cut(floor, None, "wheel", (x, y, 0.0), axes), couple]
