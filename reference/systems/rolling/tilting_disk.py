"""Thin homogeneous disk that rolls on the floor without slip and tilts: a ring of its moments."""

from dataclasses import dataclass

from ...system import MOVING, Array, System
from .tilting_ring import TiltingRing


@dataclass(frozen=True)
class TiltingDisk(System):
    """Mass m [kg], radius R [m]; it starts as the ring does, with beta0 [rad], ω [rad/s]."""

    m: float
    R: float
    mu: float  # friction of the floor: must only be enough
    beta0: float
    w1: float
    w2: float
    w3: float

    def __post_init__(self) -> None:
        object.__setattr__(self, "modes", {MOVING: self._ring()})

    def _ring(self) -> TiltingRing:
        """(2.32) J₁₁ = J₃₃ = m R²/4, J₂₂ = m R²/2 about the axle [kg m²] (Exercise 2.2)."""
        A, C = self.m * self.R**2 / 4, self.m * self.R**2 / 2
        return TiltingRing(
            self.m, self.R, A, C, self.mu, self.beta0, self.w1, self.w2, self.w3
        )  # fmt: skip

    def start(self) -> tuple[str, Array, Array]:
        """As the ring starts."""
        return MOVING, *self.modes[MOVING].start()

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.19) As the ring knows it: of a steady motion."""
        return self.modes[MOVING].closed_form(t)
