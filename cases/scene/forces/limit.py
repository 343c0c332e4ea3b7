"""Elements that hold on one side: ropes, and stops of a joint's turn."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from ...fields.field import In
from ...fields.kind import Fields
from ...trajectory import Array
from ..body import Body
from ..motion import Motion
from ..point import Anchor
from .element import Limit
from .turning import Turning

# A rope between two points: without mass, and never longer than it is.


@dataclass(frozen=True)
class Rope(Limit):
    """(2.14) on one side, λ ≤ L: it pulls where it is taut, and is slack where λ < L.

    Where it comes taut its ends keep no velocity along it that would part them: the impact is
    plastic.
    """

    word = "rope"
    measured = "length"
    given: ClassVar[Mapping[str, tuple[str, ...]]] = {"force": ("force",)}
    a: Anchor  # one end
    b: Anchor  # the other
    length: Annotated[float, In("m", above=0)]  # L

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """It pulls where it is as long as it can be."""
        return {"force": (-1.0, self.length)}

    def refers(self) -> tuple[Anchor, ...]:
        """Its two ends."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """length and gap [m], how far its ends are apart and how much is slack; its force [N]."""
        fields: Fields = {"length": ("m", "coordinate"), "gap": ("m", "residual")}
        return {self.name: {**fields, "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) length or gap [m]; KeyError of its force, which only a producer knows."""
        length, _ = motion.line(self.a, self.b)
        return {"length": length, "gap": self.length - length}[field]

    def rate(self, motion: Motion) -> Array:
        """(N,) how fast [m/s] its ends part along it."""
        return motion.line(self.a, self.b)[1]

    def numbers(self) -> dict[str, float]:
        """L."""
        return {"length": self.length}


# Stops of a joint's turn: where the second part's angle against the first ends.


SIDES = ("low", "high")


@dataclass(frozen=True)
class Stops(Limit, Turning):
    """(2.14) on one side, φ ≥ `low` and φ ≤ `high`: what passes neither, and may rest on one.

    Where it is struck, the rate of the turn after is −`restitution` of that before.
    """

    word = "stops"
    winds = True
    measured = "angle"
    given: ClassVar[Mapping[str, tuple[str, ...]]] = {"torque": SIDES}
    low: Annotated[float, In("rad")] | None = None  # the least angle; None: it has no end there
    high: Annotated[float, In("rad")] | None = None  # the largest
    restitution: Annotated[float, In("1", least=0, most=1)] = 0.0  # of the rate, at a stop

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """It needs one, and with both there has to be something between them."""
        if self.low is None and self.high is None:
            return "needs `low` or `high`, the angle at which the turn ends"
        if self.low is not None and self.high is not None and self.low >= self.high:
            return f"`low` should be less than `high`, {self.high:g} rad, is {self.low:g} rad"
        return None

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """For each stop that there is: the sense in which it pushes and the angle where it is."""
        stops = {"low": (1.0, self.low), "high": (-1.0, self.high)}
        return {side: (sense, at) for side, (sense, at) in stops.items() if at is not None}

    @property
    def back(self) -> float:
        """Its restitution."""
        return self.restitution

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) angle [rad], or torque [N m] of what pushes from below less that from above."""
        if field == "angle":
            return super().observe(motion, field)
        total = np.zeros_like(motion.trajectory.times)
        for side, (sense, _) in self.sides.items():
            total = total + sense * motion.reaction(f"{self.name}.{side}")
        return total

    def rate(self, motion: Motion) -> Array:
        """(N,) how fast [rad/s] the second part turns against the first."""
        return motion.turn(self.about, self.turn)[1]

    def numbers(self) -> dict[str, float]:
        """Where they are."""
        return {side: at for side, (_, at) in self.sides.items()}
