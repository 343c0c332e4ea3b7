"""Block with dry friction pulled through a spring whose end moves (Example 2.4, fig 2.23).

q = (x,) is x₁, the spring's elongation is x₀ − x₁ with x₀ = u t. The book's d, a stiffness, is c
here, and its 4 b t is c u t.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...system import Array
from .block_on_guide import BlockOnGuide
from .stick_slip import Drawn, Pull


@dataclass(frozen=True)
class Dynamometer(BlockOnGuide):
    """m [kg], c [N/m], end moved with u > 0 [m/s], frictions F and static Fs [N] to −x and +x."""

    m: float
    c: float
    u: float
    F_minus: float
    F_plus: float
    Fs_minus: float
    Fs_plus: float

    def __post_init__(self) -> None:
        if not self.u > 0.0:
            raise ValueError(f"the end of the spring moves with u > 0, not {self.u}")
        super().__post_init__()

    @property
    def pull(self) -> Pull:
        """The forces on the block but friction."""
        return Drawn(self.c, self.u)

    def spring(self, t: float, q: Array) -> tuple[float, float]:
        """(2.82) x₀ = u t [m] and the force c (x₀ − x₁) [N]: the two axes of fig 2.24."""
        return self.u * t, self.c * (self.u * t - float(q[0]))

    def closed_form(self, t: float) -> tuple[Array, Array] | None:
        """(2.98) x₁ = u t − (F₊ + c z)/c while it slips, z = z₀ cos ωτ + (u/ω) sin ωτ.

        τ is the time since it slipped, ω² = c/m, z₀ = (F_s₊ − F₊)/c; before and after it rests.
        None where it does not stick after every slip.
        """
        if not self._sticks_again():
            return None
        x, (omega, z0, tau) = 0.0, self._slip()
        for slips in self._slips():
            if t <= slips:
                break
            theta = omega * min(t - slips, tau)
            z = z0 * math.cos(theta) + self.u / omega * math.sin(theta)
            x = self.u * (slips + theta / omega) - self.F_plus / self.c - z
            if t < slips + tau:
                v = self.u * (1 - math.cos(theta)) + z0 * omega * math.sin(theta)
                return np.array([x]), np.array([v])
        return np.array([x]), np.zeros(1)

    def closed_events(self, until: float) -> list[tuple[str, float]] | None:
        """(2.98) v = 0 at ωτ = 2π − 2 atan(z₀ ω/u), with the spring's force 2 F₊ − F_s₊ left."""
        if not self._sticks_again():
            return None
        events = []
        for slips in self._slips():
            events += [("slips", slips), ("stops", slips + self._slip()[2])]
            if slips > until:
                break
        return [(name, t) for name, t in events if t <= until]

    def _sticks_again(self) -> bool:
        """F_s₊ > F₊, or v = 0 is a mere touch; 2 F₊ − F_s₊ within the static friction."""
        return self.Fs_plus > self.F_plus and 2 * self.F_plus - self.Fs_plus >= -self.Fs_minus

    def _slip(self) -> tuple[float, float, float]:
        """ω [1/s], z₀ [m], and the duration of a slip [s]."""
        omega, z0 = math.sqrt(self.c / self.m), (self.Fs_plus - self.F_plus) / self.c
        return omega, z0, 2 * (math.pi - math.atan(z0 * omega / self.u)) / omega

    def _slips(self) -> Iterator[float]:
        """When it slips: at F_s₊ = c u t, and a slip and a rest of 2 (F_s₊ − F₊)/(c u) later."""
        first = self.Fs_plus / (self.c * self.u)
        again = self._slip()[2] + 2 * (self.Fs_plus - self.F_plus) / (self.c * self.u)
        k = 0
        while True:
            yield first + k * again
            k += 1
