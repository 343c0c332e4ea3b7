"""Block with friction that differs to −x and +x under a periodic force: it drifts (fig 2.26).

q = (x,).
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..laws.friction import Dry
from ..system import Array, Guard, System, Vector
from .stick_slip import guards, modes, possible


@dataclass(frozen=True)
class _Shake:
    A: float
    w: float

    def F_a(self, t: float, x: float) -> float:
        """(2.88) F_a = A sin ωt [N]."""
        return self.A * math.sin(self.w * t)

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) nothing has a potential."""
        return 0.0

    def Q4(self, t: Any) -> Any:
        """(2.50) Q = A sin ωt [N]."""
        return self.A * np.sin(self.w * t)

    def forces(self, t: float, x: float) -> list[float]:
        """The push alone [N]."""
        return [self.A * math.sin(self.w * t)]


@dataclass(frozen=True)
class AnisotropicDrift(System):
    """m [kg], A [N], w [rad/s], sliding friction F and static friction Fs [N] to −x and to +x."""

    m: float
    A: float
    w: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", modes(self.m, _Shake(self.A, self.w), self._dry()))
        # The force comes and goes while the block rests and its steps could be of any length.
        object.__setattr__(self, "longest", math.pi / (8 * self.w))

    def _dry(self) -> Dry:
        return Dry(self.F_minus, self.F_plus, self.Fs_minus, self.Fs_plus)

    def start(self) -> tuple[str, Array, Array]:
        """At rest at x = 0."""
        return "stuck", np.zeros(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        """(2.89) `slips` and `stops`."""
        return guards(_Shake(self.A, self.w), self._dry(), mode)

    def possible(self, mode: str, t: float, q: Array, v: Array) -> str | None:
        """(2.89) F_a within the static friction where it sticks."""
        return possible(self.modes[mode], self._dry(), t, q, v) if mode == "stuck" else None
