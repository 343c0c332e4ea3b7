"""Rhombus of four equal slender bars (Exercise 2.3), hung from a vertex, with a spring.

q = (θ₁, θ₂), the angles of the two upper bars `left` and `right` against the x axis. Opposite
bars stay parallel: `lower_right` has the angle θ₁, `lower_left` has θ₂. The spring (2.82) runs
between the knees, the lower ends of the two upper bars.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class Rhombus(Mode):
    """Bars m, l [kg, m]; spring c [N/m], l0 [m]; at rest at left0, right0 [rad]."""

    m: float
    l: float
    c: float
    l0: float
    left0: float
    right0: float

    coordinates = ("theta1", "theta2")

    def __post_init__(self) -> None:
        bar = Mass(self.m, self.m * self.l**2 / 12)
        names = ("left", "right", "lower_left", "lower_right")
        object.__setattr__(self, "masses", dict.fromkeys(names, bar))

    def start(self) -> tuple[Array, Array]:
        """At rest at left0, right0."""
        return np.array([self.left0, self.right0]), np.zeros(2)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) m l² (5/3 θ̈₁ + cos Δ θ̈₂) = P₁, m l² (cos Δ θ̈₁ + 5/3 θ̈₂) = P₂ [rad/s²], (2,).

        Δ = θ₁ − θ₂, P₁ = −m l² sin Δ θ̇₂² − 2 m g l cos θ₁ − K, P₂ = m l² sin Δ θ̇₁²
        − 2 m g l cos θ₂ + K, K = c (s − λ₀) l² sin Δ/s, spring length s = 2 l |sin(Δ/2)|.
        """
        m, l = self.m, self.l
        theta1, theta2 = q.tolist()
        rate1, rate2 = v.tolist()
        delta = theta1 - theta2
        cos, sin = math.cos(delta), math.sin(delta)
        s = 2 * l * abs(math.sin(delta / 2))
        K = self.c * (1 - self.l0 / s) * sin / m
        weight = 2 * G / l
        P1 = -sin * rate2 * rate2 - weight * math.cos(theta1) - K
        P2 = sin * rate1 * rate1 - weight * math.cos(theta2) + K
        det = 25 / 9 - cos * cos
        return np.array([(5 / 3 * P1 - cos * P2) / det, (5 / 3 * P2 - cos * P1) / det])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m l² (5/3 (θ̇₁² + θ̇₂²) + 2 cos(θ₁ − θ₂) θ̇₁ θ̇₂) [J]."""
        squares = 5 / 3 * (v[0] ** 2 + v[1] ** 2)
        return self.m * self.l**2 / 2 * (squares + 2 * np.cos(q[0] - q[1]) * v[0] * v[1])

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = 2 m g l (sin θ₁ + sin θ₂) + ½ c (s − λ₀)², s = l |e₁ − e₂| [J]."""
        dx, dy = np.cos(q[0]) - np.cos(q[1]), np.sin(q[0]) - np.sin(q[1])
        s = self.l * np.sqrt(dx * dx + dy * dy)
        height = np.sin(q[0]) + np.sin(q[1])
        return 2 * self.m * G * self.l * height + self.c * (s - self.l0) ** 2 / 2

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R = (l/2) e₁, (l/2) e₂, l e₁ + (l/2) e₂, l e₂ + (l/2) e₁."""
        x1, y1 = self.l / 2 * np.cos(q[0]), self.l / 2 * np.sin(q[0])
        x2, y2 = self.l / 2 * np.cos(q[1]), self.l / 2 * np.sin(q[1])
        u1, w1, u2, w2 = -y1 * v[0], x1 * v[0], -y2 * v[1], x2 * v[1]
        return {
            "left": (x1, y1, q[0], u1, w1, v[0]),
            "right": (x2, y2, q[1], u2, w2, v[1]),
            "lower_left": (2 * x1 + x2, 2 * y1 + y2, q[1], 2 * u1 + u2, 2 * w1 + w2, v[1]),
            "lower_right": (x1 + 2 * x2, y1 + 2 * y2, q[0], u1 + 2 * u2, w1 + 2 * w2, v[0]),
        }

    def _knees(self, q: Array) -> tuple[tuple[float, float], tuple[float, float]]:
        """Lower ends of `left` and `right` [m]."""
        left, right = q.tolist()
        return (
            (self.l * math.cos(left), self.l * math.sin(left)),
            (self.l * math.cos(right), self.l * math.sin(right)),
        )

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights; (2.82) the spring pulls the knees together with c (s − λ₀)."""
        left, right = self._knees(q)
        dx, dy = right[0] - left[0], right[1] - left[1]
        s = math.sqrt(dx * dx + dy * dy)
        fx, fy = self.c * (s - self.l0) * dx / s, self.c * (s - self.l0) * dy / s
        down = (0.0, -self.m * G)
        weights = [Load(name, pose[:2], down) for name, pose in self.poses(t, q, v).items()]
        return [*weights, Load("left", left, (fx, fy)), Load("right", right, (-fx, -fy))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The cuts at all five pins; the two at the top hold each its own bar."""
        left, right = self._knees(q)
        foot = (left[0] + right[0], left[1] + right[1])
        return [
            Cut(("top_left.fx", "top_left.fy"), None, "left", (0.0, 0.0)),
            Cut(("top_right.fx", "top_right.fy"), None, "right", (0.0, 0.0)),
            Cut(("knee_left.fx", "knee_left.fy"), "left", "lower_left", left),
            Cut(("knee_right.fx", "knee_right.fy"), "right", "lower_right", right),
            Cut(("foot.fx", "foot.fy"), "lower_left", "lower_right", foot),
        ]
