"""A sleigh on a smooth level plane, seen from above, whatever drives its blade.

q = (x, y, θ): the point P of the blade and its heading; the centre of mass C lies at a ahead of P.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Load, Mass, Mode, Pose, Vector


@dataclass(frozen=True)
class BladeOnPlane(Mode):
    """m [kg], J about C [kg m²], a [m]."""

    m: float
    J: float
    a: float

    coordinates = ("x", "y", "theta")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"sleigh": Mass(self.m, self.J)})

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m ((ẋ − a θ̇ sin θ)² + (ẏ + a θ̇ cos θ)²) + ½ J θ̇² [J]."""
        vx = v[0] - self.a * v[2] * np.sin(q[2])
        vy = v[1] + self.a * v[2] * np.cos(q[2])
        return self.m * (vx**2 + vy**2) / 2 + self.J * v[2] ** 2 / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, y) + a (cos θ, sin θ), angle = θ."""
        dx, dy = self.a * np.cos(q[2]), self.a * np.sin(q[2])
        return {"sleigh": (q[0] + dx, q[1] + dy, q[2], v[0] - v[2] * dy, v[1] + v[2] * dx, v[2])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.23) none: the plane is level and smooth."""
        return []
