"""Hand-derived fall of a ball from rest against air drag that grows as its speed squared (2.86).

q = (y,), height above the start. Its speed tends to v∞, at which the drag bears the weight.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class FallingDrag(Mode):
    """Ball of m [kg] against d |v|² [N], d [N] being that at 1 m/s; |v| tends to v∞ = √(m g/d)."""

    m: float
    d: float

    coordinates = ("y",)

    def __post_init__(self) -> None:
        if not self.d > 0.0:
            raise ValueError("without drag it falls ever faster: d > 0")
        object.__setattr__(self, "masses", {"ball": Mass(self.m, None)})

    def start(self) -> tuple[Array, Array]:
        """At rest at y = 0."""
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.81), (2.86) m ÿ = −m g − d |ẏ| ẏ [m/s²], (1,)."""
        return np.array([-G - self.d / self.m * abs(float(v[0])) * v[0]])

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.86) v = −v∞ tanh(g t/v∞), y = −(v∞²/g) ln cosh(g t/v∞), v∞² = m g/d.

        ln cosh s = s − ln 2 + ln(1 + e^{−2s}), which cannot overflow as cosh does, or for small s
        ½ ln(1 + sinh² s), which loses no digits there, as the difference would.
        """
        limit = math.sqrt(self.m * G / self.d)
        s = G * t / limit
        large = s - math.log(2) + math.log1p(math.exp(-2 * s))
        fallen = math.log1p(math.sinh(s) ** 2) / 2 if s < 1.0 else large
        return np.array([-(limit**2) / G * fallen]), np.array([-limit * math.tanh(s)])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẏ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m g y [J]."""
        return self.m * G * q[0]

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.46) D = d |ẏ|³/3 [W]: falling, |ẏ| is −ẏ, also of a complex ẏ, where abs() fails."""
        return self.d * v[0] ** 3 / (3.0 if np.real(v[0]) > 0.0 else -3.0)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, y)."""
        return {"ball": (0.0, q[0], 0.0, 0.0, v[0], 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, (2.84) drag against the velocity."""
        y, y_dot = float(q[0]), float(v[0])
        drag = -self.d * math.copysign(y_dot * y_dot, y_dot)
        return [Load("ball", (0.0, y), (0.0, force)) for force in (-self.m * G, drag)]
