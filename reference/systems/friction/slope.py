"""A block on a slope that slides or sticks, pulled harder and harder or not at all (2.87).

q = (x,), x down the slope of angle β; the pull is (b_x, b_y) t [N].
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import equation
from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class Block(Mode):
    """Sliding with v > 0 (σ = 1) or v < 0 (σ = −1), or sticking (σ = 0)."""

    m: float
    mu_k: float
    beta: float
    sigma: int
    b_x: float = 0.0
    b_y: float = 0.0

    coordinates = ("x",)

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"block": Mass(self.m, None)})

    def F_a(self, t: Any) -> Any:
        """(2.88) F_a = m g sin β + b_x t [N]."""
        return self.m * G * math.sin(self.beta) + self.b_x * t

    def F_N(self, t: Any) -> Any:
        """(2.23) F_N = m g cos β − b_y t [N], from ÿ = 0."""
        return self.m * G * math.cos(self.beta) - self.b_y * t

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.87), (2.88) m ẍ = F_a − σ μ_k F_N; ẍ = 0 where it sticks [m/s²], (1,)."""
        if self.sigma == 0:
            return np.zeros(1)
        return np.array([(self.F_a(t) - self.sigma * self.mu_k * self.F_N(t)) / self.m])

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.89) F_fr = −σ μ_k F_N, −F_a where it sticks [N]; and F_N."""
        F_N = self.F_N(t)
        F_fr = -self.sigma * self.mu_k * F_N if self.sigma else -self.F_a(t)
        return {"touch.tangent": F_fr, "touch.normal": F_N}

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẋ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = −m g x sin β [J]."""
        return -self.m * G * q[0] * math.sin(self.beta)

    def Q4(self, t: Any, q: Vector, v: Vector) -> Vector:
        """(2.50) Q = b_x t − σ μ_k F_N: the pull, and the friction of sliding [N], (1,)."""
        return np.array([self.b_x * t - self.sigma * self.mu_k * self.F_N(t)])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẋ = 0 where it sticks: λ is the friction force."""
        return np.zeros((0, 1)) if self.sigma else np.ones((1, 1))

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (x, 0)."""
        return {"block": (q[0], 0.0, 0.0, v[0], 0.0, 0.0)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight in the axes of the slope, the pull, and the friction of sliding."""
        at, weight = (float(q[0]), 0.0), self.m * G
        normal = weight * math.cos(self.beta) - self.b_y * t
        return [
            Load("block", at, (weight * math.sin(self.beta), -weight * math.cos(self.beta))),
            Load("block", at, (self.b_x * t, self.b_y * t)),
            Load("block", at, (-self.sigma * self.mu_k * normal, 0.0)),
        ]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The floor: its normal force always, its friction where the block sticks."""
        at = (float(q[0]), 0.0)
        if self.sigma == 0:
            return [Cut(("touch.tangent", "touch.normal"), None, "block", at)]
        return [Cut(("touch.normal",), None, "block", at, ((0.0, 1.0),))]


@equation
def impossible(forces: Mapping[str, float], mu_s: float, mode: str) -> str | None:
    """(2.89) F_N > 0, and where it sticks the reaction inside the cone, |F_fr| ≤ F_N tan ρ."""
    normal, tangent = forces["touch.normal"], forces["touch.tangent"]
    if not normal > 0.0:
        return f"the floor would have to pull: touch.normal = {normal:.3g} N"
    if mode == "sticks" and abs(tangent) > mu_s * normal:
        return f"sticking needs friction {abs(tangent) / normal:.4g}, there is {mu_s:.4g}"
    return None
