"""Block on a slope, pulled until the reaction would have to leave the friction cone (fig 2.22).

q = (x,), x down the slope of angle β. At rest the reaction is inside the cone of angle ρ with
tan ρ = μ_s; the pull grows along one direction, and beyond the cone's edge the block slides.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...system import Array, Guard, System
from .slope import Block, impossible

G = 9.80665  # m/s²


@dataclass(frozen=True)
class FrictionCone(System):
    """m [kg], μ_s, μ_k, β [rad], and the pull (b_x, b_y) t [N], which goes on the way it begins."""

    m: float
    mu_s: float
    mu_k: float
    beta: float
    b_x: float
    b_y: float

    def __post_init__(self) -> None:
        if not self.mu_s >= self.mu_k >= 0.0:
            raise ValueError(f"0 ≤ μ_k ≤ μ_s is broken by μ_k = {self.mu_k}, μ_s = {self.mu_s}")
        if not abs(math.tan(self.beta)) <= self.mu_s:
            raise ValueError(f"unpulled it has to rest: |tan β| is above μ_s = {self.mu_s}")
        if not abs(self.b_x) + self.mu_k * self.b_y > 0.0:
            raise ValueError("the pull presses the block down more than it draws")
        sigmas = {"down": 1, "up": -1, "sticks": 0}
        modes = {
            name: Block(self.m, self.mu_k, self.beta, sigma, self.b_x, self.b_y)
            for name, sigma in sigmas.items()
        }
        object.__setattr__(self, "modes", modes)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at x = 0."""
        return "sticks", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `slips` where |F_a| comes to μ_s F_N; what slides is drawn on."""
        if mode != "sticks":
            return ()

        def left(way: float, t: float) -> float:
            forces = self.modes[mode].reactions(t, np.zeros(1), np.zeros(1))
            return self.mu_s * forces["touch.normal"] + way * forces["touch.tangent"]

        return (
            Guard("slips", lambda t, q, v: left(1.0, t), lambda t, q, v: ("down", q, v)),
            Guard("slips", lambda t, q, v: left(-1.0, t), lambda t, q, v: ("up", q, v)),
        )

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_N > 0, and |F_fr| ≤ μ_s F_N where it sticks."""
        return impossible(self.modes[mode].reactions(t, q, v), self.mu_s, mode)

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.87) m x = ½ σ (μ_s − μ_k) F_N τ² + ⅙ (b_x + σ μ_k b_y) τ³, τ = t − t₀, F_N at t₀."""
        t0, sigma = self._slips(), math.copysign(1.0, self.b_x)
        tau = max(0.0, t - t0)
        normal = self.m * G * math.cos(self.beta) - self.b_y * t0
        jump = sigma * (self.mu_s - self.mu_k) * normal / self.m
        grows = (self.b_x + sigma * self.mu_k * self.b_y) / self.m
        x, v = jump * tau**2 / 2 + grows * tau**3 / 6, jump * tau + grows * tau**2 / 2
        return np.array([x]), np.array([v])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.89) slips at t₀, for good."""
        return [("slips", self._slips())] if self._slips() <= until else []

    def _slips(self) -> float:
        """(2.89) t₀ = m g sin (ρ ∓ β)/(b cos (γ − ρ)) [s], − down the slope; γ is the pull's."""
        rho, pull = math.atan(self.mu_s), math.hypot(self.b_x, self.b_y)
        down = math.copysign(self.beta, self.b_x * self.beta)
        gamma = math.atan2(self.b_y, abs(self.b_x))
        return self.m * G * math.sin(rho - down) / (pull * math.cos(gamma - rho))
