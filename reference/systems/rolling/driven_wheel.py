"""Wheel that rolls upright on a plane (Example 2.2) with prescribed rates: it draws its path.

q = (x, y, θ, φ) and the unit vectors e, n as of any wheel on a plane. φ̇ = w all the way, and
θ̇ = Ω + k t + A sin νt: with Ω alone the path is a circle, with k a clothoid, with A it weaves.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Vector
from .wheel_on_plane import WheelOnPlane


@dataclass(frozen=True)
class DrivenWheel(WheelOnPlane):
    """Thin disk with prescribed rates: w, Omega, A, nu [rad/s], k [rad/s²]."""

    k: float
    A: float
    nu: float

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.20) θ̈ = k + A ν cos νt, φ̈ = 0 [rad/s²]; ẍ, ÿ as it rolls, (4,)."""
        return self.rolling(q, v, self.k + self.A * self.nu * math.cos(self.nu * t), 0.0)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23), (2.27) as of any wheel; the drives' torques are M_z and M·n [N, N m]."""
        held = self.guide_reactions(q, v, self.accelerations(t, q, v))
        drive = held["upright.my"] * math.cos(q[2]) - held["upright.mx"] * math.sin(q[2])
        return held | {"upright.theta_torque": held["upright.mz"], "upright.phi_torque": drive}

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.20) ẋ + iẏ = R w e^{iθ}: a circle of radius R w/Ω, or θ = ½ k t² and a clothoid.

        By Fresnel's integrals x = R w √(π/k) C(s), y = R w √(π/k) S(s), s = t √(k/π).
        None of a path that weaves, or of one that is neither.
        """
        if self.A or bool(self.Omega) == bool(self.k):
            return None
        speed, phi = self.R * self.w, self.w * t
        if self.k:
            from scipy.special import fresnel

            theta, theta_dot = self.k * t**2 / 2, self.k * t
            scale = math.sqrt(math.pi / abs(self.k))
            S, C = fresnel(t / scale)
            x, y = speed * scale * float(C), speed * scale * float(S) * math.copysign(1.0, self.k)
        else:
            theta, theta_dot = self.Omega * t, self.Omega
            x = speed / self.Omega * math.sin(theta)
            y = speed / self.Omega * 2 * math.sin(theta / 2) ** 2
        rates = [speed * math.cos(theta), speed * math.sin(theta), theta_dot, self.w]
        return np.array([x, y, theta, phi]), np.array(rates)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15), (2.20) it rolls, and both rates are prescribed: rows (4, 4)."""
        return np.array([*self.rows(q), [0.0, 0.0, 1.0, 0.0], [0.0, 0.0, 0.0, 1.0]])

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) (0, 0, θ̇, φ̇), (4,): λ₃ and λ₄ are the drives' torques."""
        heading = self.Omega + self.k * t + self.A * np.sin(self.nu * t)
        return np.array([0.0, 0.0, heading, self.w])

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """As of any wheel, and both drives: about e_z and about the axle."""
        axle = (-math.sin(q[2]), math.cos(q[2]), 0.0)
        names = ("upright.theta_torque", "upright.phi_torque")
        centre = (float(q[0]), float(q[1]), self.R)
        drives = Cut(names, None, "wheel", centre, (), moments=((0.0, 0.0, 1.0), axle))
        return [*super().cuts(t, q), drives]
