"""Viscous friction by a power of the speed (2.86): of a point in the air, and along a slide."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from .body import Body
from .element import Force
from .friction import Bounds
from .kind import Fields
from .language.grammar.field import In
from .language.grammar.friction import FrictionForce
from .motion import Motion
from .point import GROUND, Anchor
from .trajectory import Array


@dataclass(frozen=True)
class Drag(Force):
    """(2.84), (2.86) F = −d |v|^α v/|v| on a point of a body; d is the force at 1 m/s.

    α ≥ 1: with less it would stop in a finite time, wherever it is and wherever it goes.
    """

    word = "drag"
    at: Anchor
    coefficient: Annotated[float, In("N", least=0)]
    exponent: Annotated[float, In("1", least=1)]

    def refers(self) -> tuple[Anchor, ...]:
        """Its point; the ground does not move."""
        return () if self.at.body == GROUND else (self.at,)

    def unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """The ground takes no drag."""
        return "slows the ground; it acts on a body" if self.at.body == GROUND else None

    def quantities(self) -> dict[str, Fields]:
        """force [N], its size."""
        return {self.name: {"force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) d |v|^α."""
        velocity = motion.point(self.at)[:, 2:]
        return self.coefficient * np.sqrt(np.sum(velocity**2, axis=1)) ** self.exponent

    def power(self, motion: Motion) -> Array:
        """−F |v|."""
        velocity = motion.point(self.at)[:, 2:]
        return -self.observe(motion, "force") * np.sqrt(np.sum(velocity**2, axis=1))

    def pace(self, mobility: Callable[[Anchor], float]) -> tuple[float, float]:
        """d/m at 1 m/s."""
        return 0.0, self.coefficient * sum(mobility(at) for at in self.refers())


@dataclass(frozen=True)
class Viscous(Force):
    """(2.86) F = −d |v|^α sign(v) along a slide, with d₊ forward and d₋ backward (fig. 2.20).

    v [m/s] is the second part's speed along the slide, F [N] acts on it and its opposite on the
    first part; d is the force at 1 m/s.
    """

    word = "viscous"
    freedom = "shift"
    joint: str
    coefficient: Annotated[Bounds, FrictionForce]
    exponent: Annotated[float, In("1", above=0)]

    def refers(self) -> tuple[Anchor, ...]:
        """No points: the joint has them."""
        return ()

    @property
    def about(self) -> str:
        """The slide along which it acts."""
        return self.joint

    @property
    def corner(self) -> bool:
        """Where its slope differs to both sides, or has no bound."""
        return self.exponent < 1 or self.coefficient.forward != self.coefficient.backward

    def numbers(self) -> dict[str, float]:
        """d₊ and d₋."""
        return {"forward": self.coefficient.forward, "backward": self.coefficient.backward}

    def quantities(self) -> dict[str, Fields]:
        """speed [m/s] of the second part along the slide, and force [N] on it."""
        return {self.name: {"speed": ("m/s", "velocity"), "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) speed [m/s] or force [N], positive forward."""
        speed = motion.joints[self.joint].observe(motion, "slip")
        if field == "speed":
            return speed
        d = np.where(speed > 0, self.coefficient.forward, self.coefficient.backward)
        return -d * np.copysign(np.abs(speed) ** self.exponent, speed)

    def power(self, motion: Motion) -> Array:
        """F v."""
        return self.observe(motion, "force") * self.observe(motion, "speed")
