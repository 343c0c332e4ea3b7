"""Block with friction that differs to −x and +x under a periodic force: it drifts (fig 2.26).

q = (x,).
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...system import Vector
from .block_on_guide import BlockOnGuide
from .stick_slip import Pull


@dataclass(frozen=True)
class _Shake(Numbered):
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
class AnisotropicDrift(BlockOnGuide):
    """m [kg], A [N], w [rad/s], sliding friction F and static friction Fs [N] to −x and to +x."""

    m: float
    A: float
    w: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        super().__post_init__()
        # The force comes and goes while the block rests and its steps could be of any length.
        object.__setattr__(self, "longest", math.pi / (8 * self.w))

    @property
    def pull(self) -> Pull:
        """The forces on the block but friction."""
        return _Shake(self.A, self.w)
