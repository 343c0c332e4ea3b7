"""Wheel that rolls upright on a plane (Example 2.2), left alone, on level ground or on an incline.

q = (x, y, θ, φ) and the unit vectors e, n as of any wheel on a plane.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Vector
from .wheel_on_plane import G, WheelOnPlane


@dataclass(frozen=True)
class UprightWheel(WheelOnPlane):
    """Thin disk that starts with φ̇ = w and θ̇ = Omega [rad/s]."""

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) (J₂₂ + m R²) φ̈ = m g R sin α cos θ, θ̈ = 0 [rad/s²]; ẍ, ÿ from (2.20), (4,)."""
        slope = self.m * G * self.R * math.sin(self.alpha)
        phi_ddot = slope * math.cos(q[2]) / (self.axle() + self.m * self.R**2)
        return self.rolling(q, v, 0.0, phi_ddot)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23), (2.27) as `held` has them, without drives [N, N m]."""
        return self.guide_reactions(q, v, self.accelerations(t, q, v))

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.20) φ̇ = w + K sin Ωt, ẋ + iẏ = R φ̇ e^{iΩt}: a circle and a drift across the slope.

        K = 2 g sin α/(3 R Ω), the drift is ½ R K on average:
        x = (R/Ω)(w sin Ωt + ½ K sin² Ωt),
        y = (R/Ω)(w (1 − cos Ωt) + ¼ K (2 Ωt − sin 2Ωt)).
        """
        R, w, Omega = self.R, self.w, self.Omega
        slope = 2 * G * math.sin(self.alpha) / (3 * R)
        if Omega == 0.0:  # straight down the slope
            phi, phi_dot = w * t + slope * t**2 / 2, w + slope * t
            return np.array([R * phi, 0.0, 0.0, phi]), np.array([R * phi_dot, 0.0, 0.0, phi_dot])
        theta, K = Omega * t, slope / Omega
        cos, sin = math.cos(theta), math.sin(theta)
        x = R / Omega * (w * sin + K / 2 * sin**2)
        across = K / 4 * _less_its_sine(2 * theta)
        y = R / Omega * (w * 2 * math.sin(theta / 2) ** 2 + across)
        phi, phi_dot = w * t + 2 * K / Omega * math.sin(theta / 2) ** 2, w + K * sin
        rates = np.array([R * phi_dot * cos, R * phi_dot * sin, Omega, phi_dot])
        return np.array([x, y, theta, phi]), rates

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.20) it rolls: rows (2, 4)."""
        return np.array(self.rows(q))


def _less_its_sine(x: float) -> float:
    """x − sin x, to all digits: by its series where both are nearly equal."""
    if abs(x) > 1.0:
        return x - math.sin(x)
    term, total = x**3 / 6, 0.0
    for n in range(4, 24, 2):  # x²³/23! is below rounding, relative to x³/6
        total += term
        term *= -x * x / (n * (n + 1))
    return total
