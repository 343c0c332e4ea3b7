"""Muscle after Hill between two fixed points (figure 2.17): its force rises to the isometric one.

q = (y, u): the lower end, which is held at y = −λ, and the length u of what contracts, which has a
rate of its own; v = (ẏ,). A quick release by Δ is the start with c_s Δ less force in series.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.special import lambertw

from ..system import Array, Cut, Load, Mass, Mode, Pose, Vector

G = 9.80665  # m/s²


@dataclass(frozen=True)
class MuscleIsometric(Mode):
    """(F + a)(v + b) = (F₀ + a) b, c_s in series, λ long, u0 at first; m hangs where it ends."""

    m: float
    F0: float
    a: float
    b: float
    cs: float
    cp: float
    L: float
    l: float
    u0: float

    coordinates = ("y", "u")

    def __post_init__(self) -> None:
        object.__setattr__(self, "masses", {"hook": Mass(self.m, None)})

    def start(self) -> tuple[Array, Array]:
        """Held, with u₀."""
        return np.array([-self.l, self.u0]), np.zeros(1)

    def rates(self, t: Any, q: Vector, v: Vector) -> Vector:
        """q̇ = (ẏ, −v), v = (F₀ + a) b/(F + a) − b of F = c_s (λ − u)."""
        F = self.cs * (-q[0] - q[1])
        return np.array([v[0], self.b - (self.F0 + self.a) * self.b / (F + self.a)])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) ÿ = 0 [m/s²], (1,)."""
        return np.zeros(1)

    def _pull(self, q: Array) -> float:
        """The muscle's force [N]: in series, and beside."""
        return float(self.cs * (-q[0] - q[1]) + self.cp * (-q[0] - self.L))

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) The ground bears what the muscle leaves of the weight."""
        return {"glue.fx": 0.0, "glue.fy": self.m * G - self._pull(q)}

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """Ḟ = c_s b (F₀ − F)/(F + a): w − A ln w = w₀ − A ln w₀ + c_s b t, w = F₀ − F, A = F₀ + a.

        w = −A W(−(w₀/A) e^{−(w₀ + c_s b t)/A}) by Lambert's W, W e^W = x: its main branch.
        """
        A, w0 = self.F0 + self.a, self.F0 - self.cs * (self.l - self.u0)
        x = -w0 / A * math.exp(-(w0 + self.cs * self.b * t) / A)
        w = -A * float(lambertw(x).real)
        return np.array([-self.l, self.l - (self.F0 - w) / self.cs]), np.zeros(1)

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.53) T = ½ m ẏ² [J]."""
        return self.m * v[0] ** 2 / 2

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = ½ c_s (λ − u)² + ½ c_p (λ − L)² + m g y, λ = −y [J]."""
        series, beside = -q[0] - q[1], -q[0] - self.L
        return (self.cs * series**2 + self.cp * beside**2) / 2 + self.m * G * q[0]

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) y + λ = 0."""
        return np.array([q[0] + self.l])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) ẏ = 0."""
        return np.ones((1, 1))

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) nothing is driven."""
        return np.zeros(1)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.8) R₁ = (0, y), and the inner state."""
        hook = (0.0, q[0], 0.0, 0.0, v[0], 0.0)
        return {"hook": hook, "muscle.contractile_length": (q[1],)}

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weight, and the muscle's pull."""
        at = (0.0, float(q[0]))
        return [Load("hook", at, (0.0, force)) for force in (-self.m * G, self._pull(q))]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hook is held in both directions."""
        return [Cut(("glue.fx", "glue.fy"), None, "hook", (0.0, float(q[0])))]
