"""Block with falling friction, drawn through a spring whose end moves: it sticks and slips (2.90).

q = (x,).
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ...laws.friction import Dry
from ...system import Array, Guard, System
from .stick_slip import Drawn, guards, modes, possible


@dataclass(frozen=True)
class StribeckDrive(System):
    """m [kg], c [N/m], end moved with u > 0 [m/s]; friction from Fs to F [N] over v_s [m/s]."""

    m: float
    c: float
    u: float
    F: float
    Fs: float
    v_s: float

    def __post_init__(self) -> None:
        if not (self.u > 0.0 and self.v_s > 0.0):
            raise ValueError(f"u and v_s must be positive, not {self.u}, {self.v_s}")
        object.__setattr__(self, "modes", modes(self.m, self._pull(), self._dry(), self.v_s))

    def _pull(self) -> Drawn:
        return Drawn(self.c, self.u)

    def _dry(self) -> Dry:
        return Dry(self.F, self.F, self.Fs, self.Fs)

    def start(self) -> tuple[str, Array, Array]:
        """At rest, the spring without force."""
        return "stuck", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.90) `slips` and `stops`: at v = 0 as (2.89)."""
        return guards(self._pull(), self._dry(), mode)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.90) F_a within the static friction where it sticks."""
        return possible(self.modes[mode], self._dry(), t, q, v) if mode == "stuck" else None
