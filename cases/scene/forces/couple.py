"""A torque between two bodies, which no joint has to hold together."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ...fields.signal import Signal
from ...fields.signal_grammar import InTime
from ...trajectory import Array
from ..body import Body
from ..motion import Motion
from ..point import CENTER, Anchor
from .element import Force


@dataclass(frozen=True)
class Couple(Force):
    """A torque of the first body on the second, which takes its opposite."""

    word = "couple"
    first: str  # the body that takes the opposite
    second: str  # the body that it turns
    signal: Annotated[Signal, InTime("N m", axes=1)]  # on the second, counter-clockwise

    def refers(self) -> tuple[Anchor, ...]:
        """The bodies' centres: any points would do."""
        return Anchor(self.first, CENTER), Anchor(self.second, CENTER)

    def unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """A particle takes no torque."""
        still = [b for b in (self.first, self.second) if b in bodies and not bodies[b].turns]
        return f"{still[0]!r} is a particle and cannot turn" if still else None

    def power(self, motion: Motion) -> Array:
        """M (ω₂ − ω₁)."""
        rate = motion.spin(self.second) - motion.spin(self.first)
        return np.sum(self.signal.at(motion.trajectory.times) * rate, axis=1)

    def pace(self, mobility: Callable[[Anchor], float]) -> tuple[float, float]:
        """The angular frequency of its law in time [rad/s], and 0 [1/s]: it slows nothing down."""
        return self.signal.angular_frequency, 0.0
