"""Constraints that no joint makes: a blade that does not slip to its side."""

from dataclasses import dataclass
from typing import Annotated, ClassVar

import numpy as np
from pydantic import Field

from ..fields.kind import Fields
from ..fields.signal import Signal
from ..fields.signal_grammar import PrescribedLaw
from ..trajectory import Array
from .body import Body
from .frame import PLANE, Frame
from .motion import Motion
from .point import GROUND, Anchor, Vector

_EDGE: Fields = {
    "force": ("N", "force"),  # what the ground exerts on the body, level, to the blade's left
    "slip": ("m/s", "residual"),  # velocity of the point to the blade's left
    "speed": ("m/s", "velocity"),  # of the point along the blade's heading
}
_DRIVEN: Fields = {"drive": ("N", "force")}  # what the ground exerts along the blade
_KEPT: Fields = {
    "normal": ("N", "force"),  # what the ground exerts upward
    "gap": ("m", "residual"),  # how far the point is above where it starts
}


@dataclass(frozen=True)
class Edge:
    """(2.15) A blade on the ground, fixed to a body: its point does not move across it.

    along: unit vector in the axes of the body. The left of the blade is 90° from it, counter-
    clockwise; in space from its shadow on a level plane, counter-clockwise from above: a blade that
    stands upright has no heading. speed: the velocity of the point along it [m/s], where that is
    prescribed, in the plane. kept: whether the point also keeps the height at which it starts
    (2.14), in space, as `height: kept` says.
    """

    word: ClassVar[str] = "edge"
    name: str
    at: Anchor  # the point of the body that does not slip
    along: Vector
    speed: (
        Annotated[
            Signal,
            PrescribedLaw("m/s"),
            Field(description="prescribed, of the point along the blade"),
        ]
        | None
    ) = None
    kept: bool = False
    frame: Frame = PLANE  # or SPACE

    def refers(self) -> tuple[Anchor, ...]:
        """Its point; the ground has no blade."""
        return () if self.at.body == GROUND else (self.at,)

    def why_unfit(self, body: Body | None) -> str | None:
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
        """Its reactions, its slip and its speed, and its height if that is kept."""
        more = {**(_DRIVEN if self.speed else {}), **(_KEPT if self.kept else {})}
        return {self.name: {**_EDGE, **more}}

    def numbers(self) -> dict[str, float]:
        """An engine holds none of it."""
        return {}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) slip and speed [m/s] and gap [m], from the point's states (2.6); else KeyError."""
        place, velocity = np.hsplit(motion.point(self.at), 2)
        if field == "gap" and self.kept:
            return place[:, 2] - place[0, 2]
        if field not in ("slip", "speed"):
            raise KeyError(f"{self.name}.{field}")
        states = motion.trajectory.states[self.at.body]
        along = self.frame.turned(states[:, self.frame.attitude], self.along)
        (x, y), (vx, vy) = self.frame.level(along).T, velocity[:, :2].T
        return x * vy - y * vx if field == "slip" else x * vx + y * vy


CONSTRAINTS: dict[str, type[Edge]] = {Edge.word: Edge}
"""By the word of the case file."""
