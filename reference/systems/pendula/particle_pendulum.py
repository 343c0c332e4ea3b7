"""Mathematical pendulum: a particle on a massless rod, which swings through a large angle.

q = (φ,), the angle of the rod against the x axis: hanging is φ = −π/2.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector
from ..elliptic import jacobi

G = 9.80665  # m/s²


@dataclass(frozen=True)
class ParticlePendulum(Mode):
    """Particle of mass m [kg] at the length l [m], released from rest at (x0, y0) [m]."""

    m: float
    x0: float
    y0: float

    coordinates = ("phi",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"bob": Mass(self.m, None)})

    @property
    def _l(self) -> float:
        """(2.14) l = √(x₀² + y₀²), which the rod holds [m]."""
        return math.sqrt(self.x0**2 + self.y0**2)

    def start(self) -> tuple[Array, Array]:
        """At rest where it is released."""
        return np.array([math.atan2(self.y0, self.x0)]), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) l φ̈ = −g cos φ, (1,)."""
        return np.array([-G / self._l * math.cos(q[0])])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) the rod pulls with F = m (l φ̇² − g sin φ) [N]."""
        return {"rod.force": self.m * (self._l * float(v[0]) ** 2 - G * math.sin(q[0]))}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.44) sin(θ/2) = k cd(Ω t), θ̇ = −2 Ω k k′ sn/dn: θ from hanging, Ω² = g/l.

        k = sin(θ₀/2), k′ = cos(θ₀/2); as tan(θ/2) = k cn/k′ it is accurate near the top too.
        """
        phi0 = math.atan2(self.y0, self.x0)
        theta0 = math.remainder(phi0 + math.pi / 2, 2 * math.pi)
        k, k1 = math.sin(theta0 / 2), math.cos(theta0 / 2)
        Omega = math.sqrt(G / math.hypot(self.x0, self.y0))
        sn, cn = jacobi(Omega * t, k1)
        dn = math.sqrt(k1 * k1 + k * k * cn * cn)
        theta = 2 * math.atan2(k * cn, k1)
        return np.array([phi0 + (theta - theta0)]), np.array([-2 * Omega * k * k1 * sn / dn])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m l² φ̇² [J]."""
        return self.m * self._l**2 / 2 * v[0] ** 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g l sin φ [J]."""
        return self.m * G * self._l * np.sin(q[0])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) r = l (cos φ, sin φ)."""
        x, y = self._l * np.cos(q[0]), self._l * np.sin(q[0])
        return {"bob": (x, y, 0.0, -y * v[0], x * v[0], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight."""
        x, y, *_ = self.poses(t, q, v)["bob"]
        return [Load("bob", (x, y), (0.0, -self.m * G))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The rod, which pulls towards O."""
        x, y = self._l * math.cos(q[0]), self._l * math.sin(q[0])
        pull = (-x / self._l, -y / self._l)
        return [Cut(("rod.force",), None, "bob", (x, y), (pull,))]
