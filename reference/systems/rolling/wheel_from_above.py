"""Disk that rolls upright down a slope (Example 2.2), seen from above: a knife edge under it.

Rolling with u = R φ̇ it moves as a body of the mass M = m + J_φ/R², of a disk 3/2 m, that glides on
a blade: T = ½ m u² + ½ J_φ φ̇² = ½ M u², while its weight pulls as before, M g = m · 9.80665 m/s².
q = (x, y, θ), x down the slope; v = (u, ω), so that no constraint is left. What holds the blade, λ,
times R is the couple that holds the disk upright.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector


@dataclass(frozen=True)
class WheelFromAbove(Mode):
    """M [kg], J [kg m²] about the normal, gravity g [m/s²] on the slope alpha [rad].

    It starts with u0 [m/s] and w0 [rad/s].
    """

    M: float
    J: float
    gravity: float
    alpha: float
    u0: float
    w0: float

    coordinates = ("x", "y", "theta")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"wheel": Mass(self.M, self.J)})

    def start(self) -> tuple[Array, Array]:
        """At the origin, rolling down the slope."""
        return np.zeros(3), np.array([self.u0, self.w0])

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.20) ẋ = u cos θ, ẏ = u sin θ, θ̇ = ω, (3,)."""
        return np.array([v[0] * np.cos(q[2]), v[0] * np.sin(q[2]), v[1]])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.80) u̇ = g sin α cos θ, ω̇ = 0, (2,)."""
        return np.array([self.gravity * math.sin(self.alpha) * math.cos(q[2]), 0.0])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ = M (u ω + g sin α sin θ) [N], to the left of the edge."""
        down = self.gravity * math.sin(self.alpha) * math.sin(q[2])
        return {"edge.force": float(self.M * (v[0] * v[1] + down))}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.20) θ = ω t, u = u₀ + k sin θ, k = (g/ω) sin α; with z = e^{iωt}

        x + iy = (u₀/iω) (z − 1) + (k/2i) ((z² − 1)/2iω − t).
        """
        s, w = self.gravity * math.sin(self.alpha), self.w0
        if w == 0.0:
            return np.array([self.u0 * t + s * t**2 / 2, 0.0, 0.0]), np.array(
                [self.u0 + s * t, 0.0]
            )
        z = complex(math.cos(w * t), math.sin(w * t))
        path = self.u0 / (1j * w) * (z - 1) + s / (2j * w) * ((z * z - 1) / (2j * w) - t)
        return np.array([path.real, path.imag, w * t]), np.array([self.u0 + s / w * z.imag, w])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ M (ẋ² + ẏ²) + ½ J θ̇² [J], of the rates q̇, here called v."""
        return self.M * (v[0] ** 2 + v[1] ** 2) / 2 + self.J * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −M g x sin α [J]."""
        return -self.M * self.gravity * q[0] * math.sin(self.alpha)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) no row is left of v, (0, 2)."""
        return np.zeros((0, 2))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the coordinates themselves, and their rates."""
        x_dot, y_dot, omega = self.rates(t, q, v)
        return {"wheel": (q[0], q[1], q[2], x_dot, y_dot, omega)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) of the weight what points down the slope."""
        down = self.M * self.gravity * math.sin(self.alpha)
        return [Load("wheel", (float(q[0]), float(q[1])), (down, 0.0))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The edge, across."""
        left = (-math.sin(q[2]), math.cos(q[2]))
        return [Cut(("edge.force",), None, "wheel", (float(q[0]), float(q[1])), (left,))]
