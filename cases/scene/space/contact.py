"""Contacts in space: what rolls without slip on the floor z = 0, or stands there on a point."""

from dataclasses import dataclass
from typing import ClassVar, Literal

import numpy as np

from ...fields.kind import Fields
from ...trajectory import Array
from ..frame import SPACE
from ..motion import Motion
from ..point import FLOOR, Anchor
from ..rotation import turned

_CONTACT: Fields = {
    "fx": ("N", "force"),  # the floor's on the body, in ground axes
    "fy": ("N", "force"),
    "normal": ("N", "force"),
    "slip": ("m/s", "residual"),  # of the point of the body that touches: how fast along the floor
    "gap": ("m", "residual"),  # its height
}
_RIM: Fields = {
    "along": ("N", "force"),  # the floor's force along the track of a disk, and to its left
    "side": ("N", "force"),
}


@dataclass(frozen=True)
class SpatialContact:
    """A disk's rim or a sphere on the floor z = 0, named by its centre, which only rolls.

    Or a point of a body that stays where it stands: a pivot. The reference assumes it and checks
    at every sample that friction suffices, and that the floor need not pull.
    """

    name: str
    at: Anchor  # a disk or sphere is named by its centre
    friction: float  # the one coefficient
    rim: bool  # of a disk; a sphere has none
    on: ClassVar[str] = FLOOR  # there is no other plane in space
    ideal: Literal["rolling", "pivot"] = "rolling"  # it only rolls, or stands on a point
    restitution: float = 0.0  # nothing bounces in space yet

    @property
    def body(self) -> str:
        return self.at.body

    def refers(self) -> tuple[Anchor, ...]:
        """The point that touches."""
        return (self.at,)

    def each(self) -> "tuple[SpatialContact, ...]":
        """One contact for every point that may touch: itself."""
        return (self,)

    @property
    def static(self) -> float:
        return self.friction

    @property
    def kinetic(self) -> float:
        return self.friction

    @property
    def ahead_of(self) -> None:
        """None: nothing walks in space."""
        return None

    @property
    def switches(self) -> bool:
        """Whether it may open, slide and stick: slipping in two directions has no finite modes."""
        return False

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, and where and how the touching point moves."""
        return {self.name: {**_CONTACT, **(_RIM if self.rim else {})}}

    def components(self, field: str) -> tuple[str, ...]:
        """The reactions that a producer gives, from which a force follows."""
        return ("fx", "fy") if field in ("along", "side") else (field,)

    def numbers(self) -> dict[str, float]:
        """The coefficient of friction."""
        return {"friction": self.friction}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) of the body's lowest point, or of the pivot; else KeyError.

        along, side: of the force (fx, fy), along the track axle × z, on which a disk whose axle
        points to the left rolls forward, and along the axle's shadow on the floor.
        """
        if field in ("along", "side"):
            fx, fy = (motion.reaction(f"{self.name}.{name}") for name in self.components(field))
            left = self._axle(motion)[:, :2]
            left = left / np.linalg.norm(left, axis=1, keepdims=True)
            if field == "side":
                return fx * left[:, 0] + fy * left[:, 1]
            return fx * left[:, 1] - fy * left[:, 0]
        if field not in ("slip", "gap"):
            raise KeyError(f"{self.name}.{field}")
        states, arm = motion.trajectory.states[self.body], self._arm(motion)
        if field == "gap":
            return states[:, SPACE.place][:, 2] + arm[:, 2]
        omega = turned(states[:, SPACE.attitude], states[:, SPACE.spin])
        velocity = states[:, SPACE.velocity] + np.cross(omega, arm)
        return np.hypot(velocity[:, 0], velocity[:, 1])

    def _axle(self, motion: Motion) -> Array:
        """(N, 3) of a disk, in ground axes."""
        states = motion.trajectory.states[self.body]
        return turned(states[:, SPACE.attitude], motion.bodies[self.body].axle)

    def _arm(self, motion: Motion) -> Array:
        """(N, 3) from the centre to the lowest point, or to the pivot."""
        body, up = motion.bodies[self.body], np.array([0.0, 0.0, 1.0])
        if self.ideal == "pivot":
            states = motion.trajectory.states[self.body]
            return turned(states[:, SPACE.attitude], body.points[self.at.point])
        if not self.rim:
            return np.tile(-body.radius * up, (len(motion.trajectory.times), 1))
        n = self._axle(motion)
        steep = up - n[:, 2:] * n
        return -body.radius * steep / np.linalg.norm(steep, axis=1, keepdims=True)
