"""Knife edge on an inclined plane, seen from above: x points down the slope of angle β.

q = (x, y, θ): the centre of mass, under which the blade is, and its heading; u is the velocity
along the blade. Nothing turns the body, so it turns evenly, and its path is a cycloid.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class KnifeEdge(Mode):
    """m [kg], J [kg m²], slope beta [rad]; at the origin, θ = 0, with u0 [m/s] and w0 [rad/s]."""

    m: float
    J: float
    beta: float
    u0: float
    w0: float

    coordinates = ("x", "y", "theta")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"blade": Mass(self.m, self.J)})

    def start(self) -> tuple[Array, Array]:
        """At the origin, the blade pointing down the slope."""
        return np.zeros(3), np.array([self.u0, 0.0, self.w0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) u̇ = g sin β cos θ along the blade, u ω across it, ω̇ = 0, (3,)."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        u_dot = G * math.sin(self.beta) * cos
        across = (v[0] * cos + v[1] * sin) * v[2]
        return np.array([u_dot * cos - across * sin, u_dot * sin + across * cos, 0.0])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ = m (u ω + g sin β sin θ) [N], to the left of the blade."""
        cos, sin = math.cos(q[2]), math.sin(q[2])
        turning = (v[0] * cos + v[1] * sin) * v[2]
        return {"edge.force": float(self.m * (turning + G * math.sin(self.beta) * sin))}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.60) θ = ω t, u = u₀ + (s/ω) sin θ, s = g sin β: with u₀ = 0 a cycloid,

        x = (u₀/ω) sin θ + (s/4ω²) (1 − cos 2θ), y = (u₀/ω) (1 − cos θ) + (s/4ω²) (2θ − sin 2θ).
        """
        s, w = G * math.sin(self.beta), self.w0
        if w == 0:
            x, u = self.u0 * t + s * t**2 / 2, self.u0 + s * t
            return np.array([x, 0.0, 0.0]), np.array([u, 0.0, 0.0])
        theta, r = w * t, s / (4 * w**2)
        x = self.u0 / w * math.sin(theta) + r * (1 - math.cos(2 * theta))
        y = self.u0 / w * (1 - math.cos(theta)) + r * (2 * theta - math.sin(2 * theta))
        u = self.u0 + s / w * math.sin(theta)
        return np.array([x, y, theta]), np.array([u * math.cos(theta), u * math.sin(theta), w])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m (ẋ² + ẏ²) + ½ J θ̇² [J]."""
        return self.m * (v[0] ** 2 + v[1] ** 2) / 2 + self.J * v[2] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −m g x sin β [J]."""
        return -self.m * G * q[0] * math.sin(self.beta)

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) −ẋ sin θ + ẏ cos θ = 0: row (1, 3)."""
        return np.array([[-np.sin(q[2]), np.cos(q[2]), 0.0]])

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) the coordinates themselves."""
        return {"blade": (q[0], q[1], q[2], v[0], v[1], v[2])}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) of the weight what points down the slope; the plane carries the rest."""
        return [Load("blade", (float(q[0]), float(q[1])), (self.m * G * math.sin(self.beta), 0.0))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The blade, across."""
        left = (-math.sin(q[2]), math.cos(q[2]))
        return [Cut(("edge.force",), None, "blade", (float(q[0]), float(q[1])), (left,))]
