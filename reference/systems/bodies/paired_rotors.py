"""Two disks on one axle, each on a pin of its own, that push each other apart with M sin Ω t.

q = (φ₁, φ₂), their turns; the pins carry their weights, which turn nothing.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class PairedRotors(Mode):
    """m1, m2 [kg], R1, R2 [m]; M sin Ω t [N m] of the first on the second; both start with w0."""

    m1: float
    R1: float
    m2: float
    R2: float
    M: float
    Omega: float
    w0: float

    coordinates = ("phi1", "phi2")

    def __post_init__(self) -> None:
        masses = {"one": Mass(self.m1, self._J[0]), "two": Mass(self.m2, self._J[1])}
        object.__setattr__(self, "masses", masses)

    @property
    def _J(self) -> tuple[float, float]:
        """(2.34) J₃₃ = ½ m R² of each [kg m²]."""
        return self.m1 * self.R1**2 / 2, self.m2 * self.R2**2 / 2

    def start(self) -> tuple[Array, Array]:
        """Both turn as one."""
        return np.zeros(2), np.full(2, self.w0)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.34) J₁ φ̈₁ = −M sin Ω t, J₂ φ̈₂ = M sin Ω t, (2,)."""
        J1, J2 = self._J
        M = self.M * math.sin(self.Omega * t)
        return np.array([-M / J1, M / J2])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) each pin holds its weight: F = (0, m g) [N]."""
        weights = {"first.fy": self.m1 * G, "second.fy": self.m2 * G}
        return {"first.fx": 0.0, "second.fx": 0.0} | weights

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.27) the angular momenta: J φ̇ = J w₀ ∓ M (1 − cos Ω t)/Ω."""
        given = self.M * (1 - math.cos(self.Omega * t)) / self.Omega
        gone = self.M * (t - math.sin(self.Omega * t) / self.Omega) / self.Omega
        J = np.array([-0.5 * self.m1 * self.R1 * self.R1, 0.5 * self.m2 * self.R2 * self.R2])
        return self.w0 * t + gone / J, self.w0 + given / J

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ J₁ φ̇₁² + ½ J₂ φ̇₂² [J]."""
        return self.m1 * self.R1**2 / 4 * v[0] ** 2 + self.m2 * self.R2**2 / 4 * v[1] ** 2

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = M sin Ω t ∂(φ₂ − φ₁)/∂q [N m], (2,)."""
        return self.M * np.sin(self.Omega * t) * np.array([-1.0, 1.0])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the centres stay at the axle, angle = φ."""
        still = 0.0 * q[0]
        turns = zip(("one", "two"), q, v, strict=True)
        return {body: (still, still, phi, still, still, rate) for body, phi, rate in turns}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights, and the torque on both."""
        M = self.M * math.sin(self.Omega * t)
        weights = (0.0, -self.m1 * G), (0.0, -self.m2 * G)
        return [
            Load("one", (0.0, 0.0), weights[0], -M),
            Load("two", (0.0, 0.0), weights[1], M),
        ]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The two pins."""
        pins = ("first", "one"), ("second", "two")
        return [Cut((f"{pin}.fx", f"{pin}.fy"), None, body, (0.0, 0.0)) for pin, body in pins]
