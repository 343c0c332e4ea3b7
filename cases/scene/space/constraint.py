"""Constraints in space that no joint makes: a blade that does not slip to its side."""

from dataclasses import dataclass
from typing import ClassVar

import numpy as np

from ...fields.kind import Fields
from ...trajectory import Array
from ..body import Body
from ..frame import SPACE
from ..motion import Motion
from ..point import GROUND, Anchor
from ..rotation import Vector3, turned

_EDGE: Fields = {
    "force": ("N", "force"),  # what the ground exerts on the body, level, to the blade's left
    "slip": ("m/s", "residual"),  # velocity of the point to the blade's left
    "speed": ("m/s", "velocity"),  # of the point along the blade's heading
}
_KEPT: Fields = {
    "normal": ("N", "force"),  # what the ground exerts upward
    "gap": ("m", "residual"),  # how far the point is above where it starts
}


@dataclass(frozen=True)
class SpatialEdge:
    """(2.15) A blade fixed to a body: its point does not move across it.

    along: unit vector in the axes of the body. The heading is its shadow on a level plane, and the
    left of the blade is 90° from that, counter-clockwise from above: a blade that stands upright
    has no heading. kept: whether the point also keeps the height at which it starts (2.14), as
    `height: kept` says.
    """

    word: ClassVar[str] = "edge"
    name: str
    at: Anchor  # the point of the body that does not slip
    along: Vector3
    kept: bool = False

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

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, its slip and its speed, and its height if that is kept."""
        return {self.name: {**_EDGE, **(_KEPT if self.kept else {})}}

    def numbers(self) -> dict[str, float]:
        """An engine holds none of it."""
        return {}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) slip and speed [m/s] and gap [m], from the point's states (2.6); else KeyError."""
        point = motion.point(self.at)
        if field == "gap" and self.kept:
            return point[:, 2] - point[0, 2]
        if field not in ("slip", "speed"):
            raise KeyError(f"{self.name}.{field}")
        x, y = self._heading(motion).T
        vx, vy = point[:, 3:5].T
        return x * vy - y * vx if field == "slip" else x * vx + y * vy

    def _heading(self, motion: Motion) -> Array:
        """(N, 2) the unit vector along the blade's shadow."""
        states = motion.trajectory.states[self.at.body]
        shadow = turned(states[:, SPACE.attitude], self.along)[:, :2]
        return shadow / np.linalg.norm(shadow, axis=1, keepdims=True)
