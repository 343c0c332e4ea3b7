"""Block on an incline with dry friction: it sticks, slides, brakes to rest or comes back (2.87).

q = (x,), x down the slope of angle β.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...system import Array, Guard, System
from .slope import Block, impossible

G = 9.80665  # m/s²


@dataclass(frozen=True)
class SlidingBlock(System):
    """m [kg], static and kinetic friction, β, and the start v0 [m/s] down the slope."""

    m: float
    mu_s: float
    mu_k: float
    beta: float
    v0: float

    def __post_init__(self) -> None:
        if not self.mu_s >= self.mu_k >= 0.0:
            raise ValueError(f"0 ≤ μ_k ≤ μ_s is broken by μ_k = {self.mu_k}, μ_s = {self.mu_s}")
        sigmas = {"down": 1, "up": -1, "sticks": 0}
        modes = {name: Block(self.m, self.mu_k, self.beta, s) for name, s in sigmas.items()}
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At x = 0 with v0."""
        mode = self._at_rest() if self.v0 == 0.0 else "down" if self.v0 > 0.0 else "up"
        return mode, np.zeros(1), np.array([self.v0])

    def _at_rest(self) -> str:
        """(2.89) at v = 0 it sticks while |tan β| ≤ μ_s, else it slides down."""
        if abs(math.sin(self.beta)) <= self.mu_s * math.cos(self.beta):
            return "sticks"
        return "down" if self.beta > 0.0 else "up"

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `stops` where v = 0; too steep for that, it turns."""
        if mode == "sticks":
            return ()
        sigma, after = (1.0 if mode == "down" else -1.0), self._at_rest()
        return (
            Guard(
                "stops" if after == "sticks" else None,
                lambda t, q, v: sigma * float(v[0]),
                lambda t, q, v: (after, q, np.zeros(1)),
            ),
        )

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.87) x = v₀ t + ½ g (sin β ∓ μ_k cos β) t² until v = 0, − where it goes down.

        From there on x = x₀ + ½ a (t − t₀)², x₀ = ½ v₀ t₀.
        """
        t0, a = self._halts(), self._sets_off()
        if t < t0:
            against = math.copysign(self.mu_k, self.v0) * math.cos(self.beta)
            along = G * (math.sin(self.beta) - against)
            return np.array([self.v0 * t + along * t**2 / 2]), np.array([self.v0 + along * t])
        tau = t - t0
        return np.array([self.v0 * t0 / 2 + a * tau**2 / 2]), np.array([a * tau])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.87) stops at t₀, if it moves before and does not set off again."""
        t0 = self._halts()
        return [("stops", t0)] if 0.0 < t0 <= until and self._sets_off() == 0.0 else []

    def _halts(self) -> float:
        """(2.87) v = 0 at t₀ = |v₀|/(g (μ_k cos β ∓ sin β)) [s], − where it goes down, or never."""
        if self.v0 == 0.0:
            return 0.0
        down = math.copysign(math.sin(self.beta), self.v0 * self.beta)
        brake = G * (self.mu_k * math.cos(self.beta) - down)
        return abs(self.v0) / brake if brake > 0.0 else math.inf

    def _sets_off(self) -> float:
        """(2.87) a = g (sin β ∓ μ_k cos β) [m/s²] from rest, − where it goes down; 0: it sticks."""
        if abs(math.tan(self.beta)) <= self.mu_s:
            return 0.0
        return G * (math.sin(self.beta) - math.copysign(self.mu_k, self.beta) * math.cos(self.beta))

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_N > 0, and |F_fr| ≤ μ_s F_N where it sticks."""
        return impossible(self.modes[mode].reactions(t, q, v), self.mu_s, mode)
