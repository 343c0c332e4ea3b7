"""Block with falling friction (2.90), thrown along a line and pushed: fig 2.25 as a motion.

q = (x,). Below the speed at which friction is as large as the push it comes to rest, above it runs
away: friction that falls drives what moves.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...laws.friction import Dry
from ...system import Array, Guard, System, Vector
from ..quadrature import integral
from .stick_slip import Pull, guards, modes, possible

PANELS = 16  # of the integral: ln E is smooth up to the stop


@dataclass(frozen=True)
class _Push(Numbered):
    P: float

    def F_a(self, t: float, x: float) -> float:
        """(2.88) F_a = P [N]."""
        return self.P

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) nothing has a potential."""
        return 0.0

    def Q4(self, t: Any) -> Any:
        """(2.50) Q = P [N]."""
        return self.P

    def forces(self, t: float, x: float) -> list[float]:
        """The push alone [N]."""
        return [self.P]


@dataclass(frozen=True)
class StribeckBrake(System):
    """m [kg], friction from Fs to F < Fs [N] over v_s [m/s], push 0 ≤ P < Fs [N], v0 > 0 [m/s]."""

    m: float
    F: float
    Fs: float
    v_s: float
    P: float
    v0: float

    def __post_init__(self) -> None:
        if not (self.v0 > 0.0 and self.v_s > 0.0 and 0.0 <= self.P < self.Fs):
            raise ValueError("v0 and v_s must be positive, and the push held by Fs")
        object.__setattr__(self, "modes", modes(self.m, self._pull(), self._dry(), self.v_s))

    def _pull(self) -> Pull:
        return _Push(self.P)

    def _dry(self) -> Dry:
        return Dry(self.F, self.F, self.Fs, self.Fs)

    def start(self) -> tuple[str, Array, Array]:
        """At x = 0 with v0."""
        return "forward", np.zeros(1), np.array([self.v0])

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.90) `stops`: at v = 0 as (2.89)."""
        return guards(self._pull(), self._dry(), mode)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.90) F_a within the static friction where it sticks."""
        return possible(self.modes[mode], self._dry(), t, q, v) if mode == "stuck" else None

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.90) v = v_s ln E, E = e^{v₀/v_s − κt} − (F_s − F)(1 − e^{−κt})/(F − P); x = ∫ v dt.

        κ = (F − P)/(m v_s), for m v̇ = P − F − (F_s − F) e^{−v/v_s} is linear in E = e^{v/v_s}.
        """
        to = min(t, self._halts())
        x = integral(lambda s: self.v_s * np.log(self._grown(s)), to, PANELS)
        v = self.v_s * math.log(self._grown(t)) if t < self._halts() else 0.0
        return np.array([float(x)]), np.array([v])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.90) stops where E = 1: κ t = ln (1 + (F − P)(e^{v₀/v_s} − 1)/(F_s − P))."""
        return [("stops", self._halts())] if self._halts() <= until else []

    def _grown(self, t: Any) -> Any:
        kappa = (self.F - self.P) / (self.m * self.v_s)
        fades = np.expm1(-kappa * t) / kappa if kappa else -t
        return np.exp(self.v0 / self.v_s - kappa * t) + (self.Fs - self.F) * fades / (
            self.m * self.v_s
        )

    def _halts(self) -> float:
        """[s]; never where the push is more than friction is at v₀."""
        net, slow = self.F - self.P, self.m * self.v_s
        share = net * math.expm1(self.v0 / self.v_s) / (self.Fs - self.P)
        if share <= -1.0:
            return math.inf
        if not net:
            return slow * math.expm1(self.v0 / self.v_s) / (self.Fs - self.P)
        return slow / net * math.log1p(share)
