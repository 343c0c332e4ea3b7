"""A sleigh whose blade is driven: along it the point P has the velocity s(t) = A sin(Ω t + α).

q = (x, y, θ) as of any blade on a plane. The constraint is inhomogeneous, and the force along the
blade does work.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Vector
from ..quadrature import integral
from .blade_on_plane import BladeOnPlane

PANELS = 4  # per radian of the drive, of the fastest turn and of what ω grows by
MOST = 60  # panels, each of which asks for as many: with more it is a matter of minutes


@dataclass(frozen=True)
class DrivenEdge(BladeOnPlane):
    """m [kg], J about C [kg m²], a [m], w0 [rad/s] at θ = 0; A [m/s], Omega [rad/s], alpha."""

    w0: float
    A: float
    Omega: float
    alpha: float

    def start(self) -> tuple[Array, Array]:
        """P at the origin, with the velocity of the drive along x."""
        return np.zeros(3), np.array([self.A * math.sin(self.alpha), 0.0, self.w0])

    def _drive(self, t: float) -> tuple[float, float]:
        """s [m/s] and ṡ [m/s²]."""
        angle = self.Omega * t + self.alpha
        return self.A * math.sin(angle), self.A * self.Omega * math.cos(angle)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) P has ṡ along the blade and s ω across it; (J + m a²) ω̇ = −m a s ω, (3,)."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        s, s_dot = self._drive(t)
        across = s * v[2]
        omega_dot = -self.m * self.a * across / (self.J + self.m * self.a**2)
        return np.array([s_dot * cos - across * sin, s_dot * sin + across * cos, omega_dot])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ₁ = m J s ω/(J + m a²) to the left, λ₂ = m (ṡ − a ω²) along the blade [N]."""
        s, s_dot = self._drive(t)
        share = self.J / (self.J + self.m * self.a**2)
        along = self.m * (s_dot - self.a * v[2] ** 2)
        return {"blade.force": float(self.m * share * s * v[2]), "blade.drive": float(along)}

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.60) ω = ω₀ exp(−κ (A/Ω) (cos α − cos(Ω t + α))), κ = m a/(J + m a²).

        θ is the integral of ω, and the path of P that of s (cos θ, sin θ); None where they take
        too many panels.
        """
        kappa = self.m * self.a / (self.J + self.m * self.a**2)
        reach = kappa * self.A / self.Omega
        grown = max(reach * (sign - math.cos(self.alpha)) for sign in (-1.0, 1.0))
        fastest = max(abs(self.Omega) * max(1.0, abs(reach)), abs(self.w0) * math.exp(grown))
        panels = 1 + math.ceil(PANELS * fastest * t / math.tau)
        if panels > MOST:
            return None

        def omega(s: Array) -> Array:
            turned = np.cos(self.alpha) - np.cos(self.Omega * s + self.alpha)
            return self.w0 * np.exp(-reach * turned)

        def velocity(s: Array) -> Any:
            theta = integral(omega, s, panels)
            return self.A * np.sin(self.Omega * s + self.alpha) * np.exp(1j * theta)

        now = np.array(t)
        path, v = complex(integral(velocity, now, panels)), complex(velocity(now))
        theta, rate = float(integral(omega, now, panels)), float(omega(now))
        return np.array([path.real, path.imag, theta]), np.array([v.real, v.imag, rate])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) −ẋ sin θ + ẏ cos θ = 0, ẋ cos θ + ẏ sin θ = s: rows (2, 3)."""
        cos, sin = np.cos(q[2]), np.sin(q[2])
        return np.array([[-sin, cos, 0.0], [cos, sin, 0.0]])

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) (0, s(t)) [m/s], (2,)."""
        return np.array([0.0, self.A * np.sin(self.Omega * t + self.alpha)])

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The blade, which holds P across itself and drives it along."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        ways = ((-sin, cos), (cos, sin))
        at = (float(q[0]), float(q[1]))
        return [Cut(("blade.force", "blade.drive"), None, "sleigh", at, ways)]
