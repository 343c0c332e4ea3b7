"""Sled on a runner behind its centre, seen from above: friction along it is less than across.

q = (x, y, φ) of a slender bar that carries the runner at its rear end.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Load, Mass, Mode, Pose, Vector


@dataclass(frozen=True)
class TurningSled(Mode):
    """m [kg], l [m]; d along the runner and d_across [N at 1 m/s]; starts with u0, w0 [m/s]."""

    m: float
    l: float
    d: float
    d_across: float
    phi0: float
    u0: float
    w0: float

    coordinates = ("x", "y", "phi")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"sled": Mass(self.m, self.J)})

    @property
    def J(self) -> float:
        """(2.32) m l²/12 [kg m²] (Exercise 2.3)."""
        return self.m * self.l**2 / 12

    def start(self) -> tuple[Array, Array]:
        """At the origin, heading phi0, with ẋ = u0, ẏ = w0, not turning."""
        return np.array([0.0, 0.0, self.phi0]), np.array([self.u0, self.w0, 0.0])

    def _slips(self, q: Vector, v: Vector) -> tuple[Any, Any]:
        """(2.6) The runner's velocity [m/s] along the sled, and across it to the left."""
        cos, sin = np.cos(q[2]), np.sin(q[2])
        return v[0] * cos + v[1] * sin, v[1] * cos - v[0] * sin - self.l / 2 * v[2]

    def _friction(self, q: Array, v: Array) -> tuple[float, float]:
        """(2.86) in ground axes [N]."""
        along, across = self._slips(q, v)
        F, N = -self.d * float(along), -self.d_across * float(across)
        cos, sin = math.cos(q[2]), math.sin(q[2])
        return F * cos - N * sin, F * sin + N * cos

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.23), (2.34) m r̈_c = F, J φ̈ = (r_P − r_c) × F, (3,)."""
        Fx, Fy = self._friction(q, v)
        moment = self.l / 2 * (Fx * math.sin(q[2]) - Fy * math.cos(q[2]))
        return np.array([Fx / self.m, Fy / self.m, moment / self.J])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m ṙ_c² + ½ J φ̇² [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + self.J * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = 0: it lies level."""
        return 0.0 * q[0]

    def D(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.47) D = ½ Σ d_i v_i² [W]."""
        along, across = self._slips(q, v)
        return (self.d * along**2 + self.d_across * across**2) / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, y)."""
        return {"sled": (*q, *v)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.86) friction, at the rear end."""
        x, y, phi = q.tolist()
        at = x - self.l / 2 * math.cos(phi), y - self.l / 2 * math.sin(phi)
        return [Load("sled", at, self._friction(q, v))]
