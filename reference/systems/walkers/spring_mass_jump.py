"""Long jump as a point mass on a spring (fig 2.15, Blickhan & Seyfarth): stance, then flight.

On its leg the mass is an elastic pendulum that stands: q = (λ, φ), from the foot.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...system import Array, Guard, System
from ..pendula.elastic_pendulum import ElasticPendulum


class _Jumper(ElasticPendulum):
    """On the leg, or in flight (c = 0)."""

    body = "jumper"


@dataclass(frozen=True)
class SpringMassJump(System):
    """m [kg] on a leg c [N/m], l0 [m] that touches down at alpha [rad] with vx0, vy0 [m/s]."""

    m: float
    c: float
    l0: float
    alpha: float
    vx0: float
    vy0: float

    def __post_init__(self) -> None:
        if not self._leaning() < 0.0:
            raise ValueError("the leg must be shortened at touch-down: vx0, vy0 point away from it")
        stiffness = {"stance": self.c, "flight": 0.0}
        leg = self.l0, self.l0, self.alpha
        modes = {mode: _Jumper(self.m, c, *leg) for mode, c in stiffness.items()}
        object.__setattr__(self, "modes", modes)

    def _leaning(self) -> float:
        """λ̇ at touch-down [m/s]."""
        return self.vx0 * math.cos(self.alpha) + self.vy0 * math.sin(self.alpha)

    def start(self) -> tuple[str, Array, Array]:
        """The leg at its rest length, in the direction alpha from the foot."""
        across = self.vy0 * math.cos(self.alpha) - self.vx0 * math.sin(self.alpha)
        q, v = [self.l0, self.alpha], [self._leaning(), across / self.l0]
        return "stance", np.array(q), np.array(v)

    def guards(self, mode: str) -> Sequence[Guard]:
        """Where λ passes λ₀: `takes off`, and `touches down` if the mass falls back on its leg."""
        if mode == "stance":
            off = lambda t, q, v: self.l0 - float(q[0])  # noqa: E731
            return (Guard("takes off", off, lambda t, q, v: ("flight", q, v)),)
        down = lambda t, q, v: float(q[0]) - self.l0  # noqa: E731
        return (Guard("touches down", down, lambda t, q, v: ("stance", q, v)),)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """λ ≤ λ₀ in stance, λ ≥ λ₀ in flight, but for rounding: the leg does not pull."""
        over = float(q[0]) / self.l0 - 1.0
        if (over if mode == "stance" else -over) > 1e-12:
            return f"the leg is {over:.3g} of its rest length longer in {mode}"
        return None
