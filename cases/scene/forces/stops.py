"""Stops of a joint's turn: where the second part's angle against the first ends."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np

from ...fields.field import In
from ...trajectory import Array
from ..body import Body
from ..motion import Motion
from .element import Limit
from .turning import Turning

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

    def unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """It needs one, and with both there has to be something between them."""
        if self.low is None and self.high is None:
            return "needs `low` or `high`, the angle at which the turn ends"
        if self.low is not None and self.high is not None and not self.low < self.high:
            return f"`low` should be less than `high`, {self.high:g} rad, is {self.low:g} rad"
        return None

    @property
    def sides(self) -> dict[str, tuple[float, float]]:
        """For each stop that there is: the sense in which it pushes and the angle where it is."""
        found = {"low": (1.0, self.low), "high": (-1.0, self.high)}
        return {side: (sense, at) for side, (sense, at) in found.items() if at is not None}

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

    def numbers(self) -> dict[str, float]:
        """Where they are."""
        return {side: at for side, (_, at) in self.sides.items()}
