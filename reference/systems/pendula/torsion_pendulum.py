"""Torsion pendulum: a disk on a pin through its centre, with a torsion spring, damped and driven.

q = φ, the turn of the disk; the pin carries its weight, which turns nothing.
"""

import cmath
import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class TorsionPendulum(Mode):
    """m [kg], R [m], c [N m/rad], d [N m s/rad]; φ₀ at rest in the spring, M sin Ω t [N m] on it.

    It starts at phi [rad] with w0 [rad/s].
    """

    m: float
    R: float
    c: float
    phi0: float
    d: float
    M: float
    Omega: float
    phi: float
    w0: float

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"disk": Mass(self.m, self.m * self.R**2 / 2)})

    def start(self) -> tuple[Array, Array]:
        """As the case says."""
        return np.array([self.phi]), np.array([self.w0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34), (2.44) J₃₃ φ̈ = −c (φ − φ₀) − d φ̇ + M sin Ω t, (1,)."""
        J33 = self.m * self.R**2 / 2
        torque = -self.c * (q[0] - self.phi0) - self.d * v[0] + self.M * math.sin(self.Omega * t)
        return np.array([torque / J33])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) the pin holds the weight: F = (0, m g) [N]."""
        return {"axle.fx": 0.0, "axle.fy": self.m * G}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.44) φ = φ₀ + Im (A e^{iΩt}) + Re (B e^{λt}) + Re (C e^{μt}), λ, μ the roots.

        A (c − J Ω² + i d Ω) = M and J λ² + d λ + c = 0; B and C by the start.
        """
        J = 0.5 * self.m * self.R * self.R
        A = self.M / (self.c - J * self.Omega**2 + 1j * self.d * self.Omega)
        root = cmath.sqrt(self.d**2 - 4 * J * self.c)
        slow, fast = (-self.d + root) / (2 * J), (-self.d - root) / (2 * J)
        x0, u0 = self.phi - self.phi0 - A.imag, self.w0 - (1j * self.Omega * A).imag
        B, C = (u0 - fast * x0) / (slow - fast), (slow * x0 - u0) / (slow - fast)
        drive, e_slow, e_fast = (cmath.exp(z * t) for z in (1j * self.Omega, slow, fast))
        x = (A * drive).imag + (B * e_slow + C * e_fast).real
        rate = (1j * self.Omega * A * drive).imag + (slow * B * e_slow + fast * C * e_fast).real
        return np.array([self.phi0 + x]), np.array([rate])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ J₃₃ φ̇² [J]."""
        return self.m * self.R**2 / 4 * v[0] ** 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c (φ − φ₀)² [J]."""
        return self.c * (q[0] - self.phi0) ** 2 / 2

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = ½ d φ̇² [W]."""
        return self.d * v[0] ** 2 / 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = M sin Ω t [N m], (1,)."""
        return np.array([self.M * np.sin(self.Omega * t)])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the centre stays at the pin, angle = φ."""
        still = 0.0 * q[0]
        return {"disk": (still, still, q[0], still, still, v[0])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, and the torques of spring, damper and drive as one moment."""
        torque = -self.c * (q[0] - self.phi0) - self.d * v[0] + self.M * math.sin(self.Omega * t)
        return [Load("disk", (0.0, 0.0), (0.0, -self.m * G), float(torque))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The pin."""
        return [Cut(("axle.fx", "axle.fy"), None, "disk", (0.0, 0.0))]
