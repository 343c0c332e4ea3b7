"""Constraints that no joint makes and that cannot be integrated: a blade that does not slip."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from ..fields.kind import Fields
from ..fields.part import Direction
from ..fields.signal import Signal
from ..fields.signal_grammar import Law
from ..trajectory import Array
from .body import Body
from .motion import Motion
from .point import GROUND, Anchor, Vector

_EDGE: Fields = {
    "force": ("N", "force"),  # what the ground exerts on the body across the blade, to its left
    "slip": ("m/s", "residual"),  # velocity of the point across the blade, to its left
    "speed": ("m/s", "velocity"),  # of the point along the blade
}
_DRIVEN: Fields = {"drive": ("N", "force")}  # what the ground exerts along the blade


@dataclass(frozen=True)
class Edge:
    """(2.15) A blade on the ground, fixed to a body: its point does not move across it.

    along: unit vector in the axes of the body; the left of the blade is 90° from it, counter-
    clockwise. speed: the velocity of the point along it [m/s], where that is prescribed.
    """

    word: ClassVar[str] = "edge"
    kept: ClassVar[bool] = False  # a height, which there is in space alone
    name: str
    at: Anchor  # the point of the body that does not slip
    along: Annotated[Direction, Field(description="in the axes of the body")]
    speed: (
        Annotated[Signal, Law("m/s"), Field(description="prescribed, of the point along the blade")]
        | None
    ) = None

    def refers(self) -> tuple[Anchor, ...]:
        """Its point; the ground has no blade."""
        return () if self.at.body == GROUND else (self.at,)

    def unfit(self, body: Body | None) -> str | None:
        """Why the body (None: one that is not known) cannot carry it, in words for the file."""
        if self.at.body == GROUND:
            return "an edge belongs to a body, and not to the ground"
        if body is not None and not body.turns:
            return f"{body.name!r} is a particle and has no axes for an edge"
        return None

    @property
    def across(self) -> Vector:
        """The left of the blade, in the axes of the body."""
        return -self.along[1], self.along[0]

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, its slip and its speed."""
        return {self.name: {**_EDGE, **(_DRIVEN if self.speed else {})}}

    def numbers(self) -> dict[str, float]:
        """An engine holds none of it."""
        return {}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) slip or speed [m/s], from the velocity of the point (2.6); else KeyError."""
        if field not in ("slip", "speed"):
            raise KeyError(f"{self.name}.{field}")
        x, y = self.across if field == "slip" else self.along
        turned, _ = motion.turned(self.at.body)
        cos, sin = np.cos(turned), np.sin(turned)
        vx, vy = motion.point(self.at)[:, 2:].T
        return (cos * x - sin * y) * vx + (sin * x + cos * y) * vy


CONSTRAINTS: dict[str, type[Edge]] = {Edge.word: Edge}
"""By the word of the case file."""
