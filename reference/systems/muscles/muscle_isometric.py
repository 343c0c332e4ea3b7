"""Muscle after Hill between two fixed points (figure 2.17): its force rises to the isometric one.

q = (y, u): the lower end, which is held at y = −λ, and the length u of what contracts, which has a
rate of its own; v = (ẏ,). A quick release by Δ is the start with c_s Δ less force in series.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Vector
from .muscle_load import MuscleLoad

G = 9.80665  # m/s²


@dataclass(frozen=True)
class MuscleIsometric(MuscleLoad):
    """The muscle and its load m, which is held: λ = l [m] long, with u = u0 [m] at first."""

    l: float
    u0: float

    body = "hook"

    def start(self) -> tuple[Array, Array]:
        """Held, with u₀."""
        return np.array([-self.l, self.u0]), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) ÿ = 0 [m/s²], (1,)."""
        return np.zeros(1)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) The ground bears what the muscle leaves of the weight."""
        pull = self.cs * (-q[0] - q[1]) + self.cp * (-q[0] - self.L)
        return {"glue.fx": 0.0, "glue.fy": float(self.m * G - pull)}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """Ḟ = c_s b (F₀ − F)/(F + a): w − A ln w = w₀ − A ln w₀ + c_s b t, w = F₀ − F, A = F₀ + a.

        w = −A W(−(w₀/A) e^{−(w₀ + c_s b t)/A}) by Lambert's W, W e^W = x: its main branch.
        """
        A, w0 = self.F0 + self.a, self.F0 - self.cs * (self.l - self.u0)
        x = -w0 / A * math.exp(-(w0 + self.cs * self.b * t) / A)
        from scipy.special import lambertw

        w = -A * float(lambertw(x).real)
        return np.array([-self.l, self.l - (self.F0 - w) / self.cs]), np.zeros(1)

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) y + λ = 0."""
        return np.array([q[0] + self.l])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẏ = 0."""
        return np.ones((1, 1))

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) nothing is driven."""
        return np.zeros(1)

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hook is held in both directions."""
        return [Cut(("glue.fx", "glue.fy"), None, self.body, (0.0, float(q[0])))]
