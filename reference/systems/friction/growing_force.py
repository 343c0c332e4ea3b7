"""Block with dry friction under a force that grows with time (Example 2.3).

q = (x,). The force −b t pulls to −x: the block sticks until it meets F_s₋.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered
from ...system import Array, Vector
from .block_on_guide import BlockOnGuide
from .stick_slip import Pull


@dataclass(frozen=True)
class _Ramp(Numbered):
    b: float

    def F_a(self, t: float, x: float) -> float:
        """(2.97) F_a = −b t [N]."""
        return -self.b * t

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) nothing has a potential."""
        return 0.0

    def Q4(self, t: Any) -> Any:
        """(2.50) Q = −b t [N]."""
        return -self.b * t

    def forces(self, t: float, x: float) -> list[float]:
        """The push alone [N]."""
        return [-self.b * t]


@dataclass(frozen=True)
class GrowingForce(BlockOnGuide):
    """m [kg], b > 0 [N/s], sliding friction F and static friction Fs [N], to −x and to +x."""

    m: float
    b: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        if not self.b > 0.0:
            raise ValueError(f"the force grows with b > 0, not {self.b}")
        super().__post_init__()

    @property
    def pull(self) -> Pull:
        """The forces on the block but friction."""
        return _Ramp(self.b)

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.97) m v = −½ b (t² − t_s²) + F₋ (t − t_s), b t_s = F_s₋, and its integral m x.

        With τ = t − t_s > 0: m v = (F₋ − F_s₋) τ − ½ b τ², m x = ½ (F₋ − F_s₋) τ² − b τ³/6.
        """
        tau = max(0.0, t - self.Fs_minus / self.b)
        drop = self.F_minus - self.Fs_minus
        x = (drop * tau**2 / 2 - self.b * tau**3 / 6) / self.m
        return np.array([x]), np.array([(drop * tau - self.b * tau**2 / 2) / self.m])

    def closed_events(self, until: float) -> list[tuple[str, float]]:
        """(2.97) slips at t_s = F_s₋/b, for good."""
        t_s = self.Fs_minus / self.b
        return [("slips", t_s)] if t_s <= until else []
