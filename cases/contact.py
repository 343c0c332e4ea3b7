"""Contacts with the floor y = 0, or with another plane of the ground."""

from dataclasses import dataclass
from typing import Literal

from .kind import Fields
from .motion import Motion
from .plane import LEVEL, Plane
from .point import Anchor
from .trajectory import ANGLE, OMEGA, Array

_CONTACT: Fields = {
    "normal": ("N", "force"),
    "tangent": ("N", "force"),
    "slip": ("m/s", "residual"),  # of the point that touches
    "gap": ("m", "residual"),  # its height above the plane
    # its place along the plane (of a disk that + R angle) against the start: (2.18)
    "drift": ("m", "residual"),
}


@dataclass(frozen=True)
class Contact:
    """A disk's rim, a particle or a point of a bar on a plane of the ground.

    It opens, slides and sticks or rolls as friction says, and an impact goes by `restitution`.
    `ideal: rolling` assumes that it only rolls; the reference checks that at every sample.
    """

    name: str
    at: Anchor  # a disk is named by its centre and touches with its rim
    static: float  # coefficient of friction; at least `kinetic`
    kinetic: float
    restitution: float = 0.0
    ideal: Literal["rolling"] | None = None
    plane: Plane = LEVEL

    @property
    def body(self) -> str:
        return self.at.body

    @property
    def friction(self) -> float:
        """The one coefficient that engines know."""
        return self.kinetic

    @property
    def switches(self) -> bool:
        """Whether it may open, slide and stick, instead of only rolling."""
        return self.ideal is None

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, and where and how the touching point moves."""
        return {self.name: _CONTACT}

    def numbers(self) -> dict[str, float]:
        """The coefficient of friction."""
        return {"friction": self.friction}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) of the lowest point of a disk's rim, or of the point that touches; else KeyError."""
        x, y, vx, vy = motion.point(self.at).T
        (ux, uy), gap = self.plane.along, self.plane.height(x, y)
        place, slip = ux * x + uy * y, ux * vx + uy * vy
        radius = motion.bodies[self.body].radius
        if radius is not None:
            s = motion.trajectory.states[self.body]
            place, gap = place + radius * s[:, ANGLE], gap - radius
            slip = slip + radius * s[:, OMEGA]
        if field == "drift":
            return place - place[0]
        if field not in ("gap", "slip"):
            raise KeyError(f"{self.name}.{field}")
        return gap if field == "gap" else slip
