"""Double pendulum of two different slender bars.

q = (α, β), the angles of the upper and the lower bar against the x axis, both absolute.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class DoublePendulum(Mode):
    """Bars m1, l1 and m2, l2 [kg, m], released from rest at the angles a0, b0 [rad]."""

    m1: float
    l1: float
    m2: float
    l2: float
    a0: float
    b0: float

    coordinates = ("alpha", "beta")

    def __post_init__(self) -> None:
        upper = Mass(self.m1, self.m1 * self.l1**2 / 12)
        lower = Mass(self.m2, self.m2 * self.l2**2 / 12)
        object.__setattr__(self, "masses", {"upper": upper, "lower": lower})

    def start(self) -> tuple[Array, Array]:
        """At rest at a0, b0."""
        return np.array([self.a0, self.b0]), np.zeros(2)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) A α̈ + B cos Δ β̈ = P, B cos Δ α̈ + C β̈ = S, by Cramer [rad/s²], (2,).

        Δ = α − β, A = (m₁/3 + m₂) l₁², B = m₂ l₁ l₂/2, C = m₂ l₂²/3,
        P = −B sin Δ β̇² − (m₁/2 + m₂) g l₁ cos α, S = B sin Δ α̇² − m₂ g (l₂/2) cos β.
        """
        m1, l1, m2, l2 = self.m1, self.l1, self.m2, self.l2
        alpha, beta = q.tolist()
        alpha_dot, beta_dot = v.tolist()
        A = (m1 / 3 + m2) * l1 * l1
        C = m2 * l2 * l2 / 3
        B = m2 * l1 * l2 / 2
        Bc, Bs = B * math.cos(alpha - beta), B * math.sin(alpha - beta)
        P = -Bs * beta_dot * beta_dot - (m1 / 2 + m2) * G * l1 * math.cos(alpha)
        S = Bs * alpha_dot * alpha_dot - m2 * G * l2 / 2 * math.cos(beta)
        det = A * C - Bc * Bc
        return np.array([(P * C - Bc * S) / det, (A * S - Bc * P) / det])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23) elbow = m₂ (r̈₂ − g), shoulder = m₁ (r̈₁ − g) + elbow [N].

        r̈₁ = (l₁/2)(α̈ e_α′ − α̇² e_α), r̈₂ = l₁(α̈ e_α′ − α̇² e_α) + (l₂/2)(β̈ e_β′ − β̇² e_β).
        """
        alpha, beta = q.tolist()
        alpha_dot, beta_dot = v.tolist()
        alpha_ddot, beta_ddot = self.accelerations(t, q, v).tolist()
        x1 = -self.l1 * (math.sin(alpha) * alpha_ddot + math.cos(alpha) * alpha_dot**2)
        y1 = self.l1 * (math.cos(alpha) * alpha_ddot - math.sin(alpha) * alpha_dot**2)
        x2 = -self.l2 * (math.sin(beta) * beta_ddot + math.cos(beta) * beta_dot**2)
        y2 = self.l2 * (math.cos(beta) * beta_ddot - math.sin(beta) * beta_dot**2)
        fx, fy = self.m2 * (x1 + x2 / 2), self.m2 * (y1 + y2 / 2 + G)
        return {
            "shoulder.fx": self.m1 * x1 / 2 + fx,
            "shoulder.fy": self.m1 * (y1 / 2 + G) + fy,
            "elbow.fx": fx,
            "elbow.fy": fy,
        }

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = ½ m₁ l₁² α̇²/3 + ½ m₂ (l₁² α̇² + l₁ l₂ cos(α − β) α̇ β̇ + l₂² β̇²/3) [J]."""
        l1, l2 = self.l1, self.l2
        upper = self.m1 * l1**2 / 3 * v[0] ** 2
        mixed = l1 * l2 * np.cos(q[0] - q[1]) * v[0] * v[1]
        return (upper + self.m2 * (l1**2 * v[0] ** 2 + mixed + l2**2 / 3 * v[1] ** 2)) / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = m₁ g (l₁/2) sin α + m₂ g (l₁ sin α + (l₂/2) sin β) [J]."""
        elbow = self.l1 * np.sin(q[0])
        return G * (self.m1 * elbow / 2 + self.m2 * (elbow + self.l2 / 2 * np.sin(q[1])))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (l₁/2) e_α, R₂ = l₁ e_α + (l₂/2) e_β."""
        x1, y1 = self.l1 / 2 * np.cos(q[0]), self.l1 / 2 * np.sin(q[0])
        x2, y2 = self.l2 / 2 * np.cos(q[1]), self.l2 / 2 * np.sin(q[1])
        vx, vy = -2 * y1 * v[0] - y2 * v[1], 2 * x1 * v[0] + x2 * v[1]
        return {
            "upper": (x1, y1, q[0], -y1 * v[0], x1 * v[0], v[0]),
            "lower": (2 * x1 + x2, 2 * y1 + y2, q[1], vx, vy, v[1]),
        }

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights at the centres."""
        at = {name: (pose[0], pose[1]) for name, pose in self.poses(t, q, v).items()}
        weights = {"upper": self.m1 * G, "lower": self.m2 * G}
        return [Load(name, at[name], (0.0, -weight)) for name, weight in weights.items()]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """Shoulder and elbow."""
        elbow = (self.l1 * math.cos(q[0]), self.l1 * math.sin(q[0]))
        return [
            Cut(("shoulder.fx", "shoulder.fy"), None, "upper", (0.0, 0.0)),
            Cut(("elbow.fx", "elbow.fy"), "upper", "lower", elbow),
        ]
