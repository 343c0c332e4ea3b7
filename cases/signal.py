"""Named laws in time."""

import math
from dataclasses import dataclass
from typing import Literal

Law = Literal["constant", "ramp", "sine"]


@dataclass(frozen=True)
class Signal:
    """A named law in time: constant A, ramp A t, or sine A sin(w t + phase)."""

    law: Law
    amplitude: tuple[float, ...]  # N for a push (x, y), N m for a torque (one entry)
    angular_frequency: float = 0.0
    phase: float = 0.0

    def at_start(self) -> tuple[float, ...]:
        """Its values at t = 0."""
        of_one = {"constant": 1.0, "ramp": 0.0, "sine": math.sin(self.phase)}[self.law]
        return tuple(of_one * amplitude for amplitude in self.amplitude)
