"""The steps of a rimless wheel by known functions: energy from strike to strike, and the impact.

Lengths are counted in spokes and inertia in m l²: J = ρ m l².
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..quadrature import integral

G = 9.80665  # m/s²
TURNS = 8  # of Newton's method: it squares a share below 1, five do
PANELS = 8  # of 16 nodes: 1e-14 s, but where a step takes many times the shortest


@dataclass(frozen=True)
class SpokeSteps:
    """n spokes of l [m], ρ = J/(m l²), slope gamma [rad]; ω [rad/s] is a rate after a strike."""

    n: float
    l: float
    rho: float
    gamma: float

    @property
    def between(self) -> float:
        """2α = 2π/n [rad]: the angle of a step."""
        return 2 * math.pi / self.n

    @property
    def kept(self) -> float:
        """(2.27) η = 1 − 2 sin² α/(1 + ρ): of l φ̇ the part 1 − cos 2α cannot go on."""
        return 1 - 2 * math.sin(self.between / 2) ** 2 / (1 + self.rho)

    def gained(self, s: Any) -> Any:
        """(2.51) φ̇² − ω² [rad²/s²] at the angle s after a strike: ½ (1 + ρ) l φ̇² = g · fall.

        The hub falls by cos(s/2 − α + γ) − … = 2 sin(γ − α + s/2) sin(s/2) spokes.
        """
        fall = 2 * np.sin(self.gamma - self.between / 2 + s / 2) * np.sin(s / 2)
        return 2 * G / self.l / (1 + self.rho) * fall

    def next_rate(self, omega: float) -> float:
        """(2.27) ω⁺ = η √(ω² + gained in a step) [rad/s]."""
        return self.kept * math.sqrt(omega**2 + float(self.gained(self.between)))

    def limit_cycle(self) -> float:
        """(2.27) ω* = η √(D/(1 − η²)) [rad/s], D gained in a step; its multiplier is η².

        Down a slope each rate that goes on walking comes to it: ω⁺² − ω*² = η² (ω² − ω*²).
        """
        return self.kept * math.sqrt(float(self.gained(self.between)) / (1 - self.kept**2))

    def walks_over(self, omega: float) -> bool:
        """Whether it passes the place where it is slowest, upright against gravity."""
        slowest = max(0.0, self.between / 2 - self.gamma)
        return omega**2 + float(self.gained(slowest)) > 0.0

    def rate(self, omega: float, s: Any) -> Any:
        """(2.51) φ̇ = √(ω² + gained) [rad/s] at the angle s after a strike."""
        return np.sqrt(omega**2 + self.gained(s))

    def lasts(self, omega: float, s: float | None = None) -> float:
        """(2.51) T = ∫ ds/φ̇ [s] over a step, or up to the angle s in it."""
        end = self.between if s is None else s
        return float(integral(lambda s: 1 / self.rate(omega, s), end, PANELS))

    def angle(self, omega: float, tau: float) -> float:
        """(2.51) The angle s at which T = τ: Newton's method, T' = 1/φ̇ > 0."""
        s = self.between * tau / self.lasts(omega)
        for _ in range(TURNS):
            s += (tau - self.lasts(omega, s)) * float(self.rate(omega, s))
            s = min(max(s, 0.0), self.between)
        return s

    def after(self, omega: float, t: float) -> tuple[float, float] | None:
        """φ [rad] and φ̇ [rad/s] at t [s] after a strike; None where it has come to fall back."""
        phi = 0.0
        while self.walks_over(omega):
            if t < (lasts := self.lasts(omega)):
                s = self.angle(omega, t)
                return phi + s, float(self.rate(omega, s))
            t, phi, omega = t - lasts, phi + self.between, self.next_rate(omega)
        return None

    def strikes(self, omega: float, until: float) -> list[float] | None:
        """The times [s] of all strikes up to `until`, from a strike; None where it falls back."""
        t, found = 0.0, list[float]()
        while self.walks_over(omega):
            t += self.lasts(omega)
            if t > until:
                return found
            found.append(t)
            omega = self.next_rate(omega)
        return None
