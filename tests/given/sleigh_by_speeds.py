"""The Chaplygin sleigh in the velocities v = (u, ω): q̇ = N v, and no constraint is left."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from textmech.reference.system import Array, Cut, Load, Mode, Pose, Vector
from textmech.reference.systems.rolling.sleigh import Sleigh


@dataclass(frozen=True)
class SleighBySpeeds(Mode):
    """The sleigh of q = (x, y, θ) with u [m/s] along the blade and ω [rad/s]."""

    of: Sleigh

    coordinates = ("x", "y", "theta")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", self.of.masses)

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """q̇ = N v: ẋ = u cos θ, ẏ = u sin θ, θ̇ = ω, (3,)."""
        return np.array([v[0] * np.cos(q[2]), v[0] * np.sin(q[2]), v[1]])

    def start(self) -> tuple[Array, Array]:
        """As the sleigh."""
        return np.zeros(3), np.array([self.of.v0, self.of.w0])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.67) u̇ = a ω², ω̇ = −m a u ω/(J + m a²), (2,)."""
        m, J, a = self.of.m, self.of.J, self.of.a
        return np.array([a * v[1] ** 2, -m * a * v[0] * v[1] / (J + m * a**2)])

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) of the full rates q̇."""
        return self.of.T(t, q, v)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) as the sleigh has them at q̇."""
        return self.of.poses(t, q, self.rates(t, q, v))

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """As the sleigh."""
        return self.of.reactions(t, q, self.rates(t, q, v))

    def f_a(self, t: Any, q: Vector) -> Vector:
        """No row is left, (0, 2)."""
        return np.zeros((0, 2))

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """None."""
        return []

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The blade."""
        return self.of.cuts(t, q)


def random_state(random: np.random.Generator) -> tuple[Array, Array]:
    """Any place, heading and speeds; the heading stays away from ± 90°, where ẏ/ẋ ends."""
    x, y = random.uniform(-3, 3, 2)
    theta = random.uniform(-1.3, 1.3) + random.choice([0.0, math.pi])
    return np.array([x, y, theta]), random.uniform(-5, 5, 2)
