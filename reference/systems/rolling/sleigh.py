"""Chaplygin sleigh: a rigid body on a smooth plane, seen from above, on a blade at its point P.

q = (x, y, θ) as of any blade on a plane; u is the velocity of P along the blade.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Vector
from ..quadrature import integral
from .blade_on_plane import BladeOnPlane

PANELS = 10  # per unit of τ, where tanh τ has its poles at ± i π/2


@dataclass(frozen=True)
class Sleigh(BladeOnPlane):
    """m [kg], J about C [kg m²], a ≠ 0 [m]; P starts at 0 with θ = 0, v0 [m/s] and w0 [rad/s]."""

    v0: float
    w0: float

    def __post_init__(self) -> None:
        if self.a == 0:
            raise ValueError("a = 0 is a knife edge, which keeps u and ω as they are")
        super().__post_init__()

    def start(self) -> tuple[Array, Array]:
        """P at the origin, gliding along x."""
        return np.zeros(3), np.array([self.v0, 0.0, self.w0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) u̇ = a ω², (J + m a²) ω̇ = −m a u ω; P has u̇ along the blade, u ω across, (3,)."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        u, omega = v[0] * cos + v[1] * sin, v[2]
        u_dot, across = self.a * omega**2, u * omega
        omega_dot = -self.m * self.a * u * omega / (self.J + self.m * self.a**2)
        return np.array([u_dot * cos - across * sin, u_dot * sin + across * cos, omega_dot])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ = m (u ω + a ω̇) = m J u ω/(J + m a²) [N], to the left of the blade."""
        u = v[0] * math.cos(q[2]) + v[1] * math.sin(q[2])
        share = self.J / (self.J + self.m * self.a**2)
        return {"blade.force": float(self.m * share * u * v[2])}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.67) u = V tanh τ, k ω = V/cosh τ, θ = (k/a) (gd τ − gd τ₀), τ̇ = a V/k².

        k² = J/m + a², k with the sign of ω, V² = u² + k² ω² (the energy), gd τ = 2 atan tanh(τ/2);
        the path of P is the integral of u (cos θ, sin θ).
        """
        if self.w0 == 0:
            return np.array([self.v0 * t, 0.0, 0.0]), np.array([self.v0, 0.0, 0.0])
        k = math.copysign(math.sqrt(self.J / self.m + self.a**2), self.w0)
        V = math.hypot(self.v0, k * self.w0)
        rate, tau0 = self.a * V / k**2, math.asinh(self.v0 / (k * self.w0))
        gd0 = math.atan(math.sinh(tau0))  # gd τ = atan sinh τ, too

        def along(s: Array) -> Any:
            tau = tau0 + rate * s
            theta = k / self.a * (np.arctan(np.sinh(tau)) - gd0)
            return V * np.tanh(tau) * np.exp(1j * theta)

        tau = tau0 + rate * t
        theta, omega = k / self.a * (math.atan(math.sinh(tau)) - gd0), V / k / math.cosh(tau)
        path = complex(integral(along, t, 1 + math.ceil(PANELS * abs(rate) * t)))
        v = complex(along(np.array(t)))
        return np.array([path.real, path.imag, theta]), np.array([v.real, v.imag, omega])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) −ẋ sin θ + ẏ cos θ = 0: row (1, 3)."""
        return np.array([[-np.sin(q[2]), np.cos(q[2]), 0.0]])

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The blade, which holds P across itself."""
        left = (-math.sin(q[2]), math.cos(q[2]))
        return [Cut(("blade.force",), None, "sleigh", (float(q[0]), float(q[1])), (left,))]
