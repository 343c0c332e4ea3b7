"""Rigid bodies. Lengths on a body are in body axes from its centre of mass."""

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Literal

from ..fields.kind import Fields
from ..trajectory import Array
from .frame import PLANE, SPACE, Frame
from .point import CENTER, Vector

_POINT: Fields = {
    "x": ("m", "coordinate"),
    "y": ("m", "coordinate"),
    "z": ("m", "coordinate"),  # in space
    "vx": ("m/s", "velocity"),
    "vy": ("m/s", "velocity"),
    "vz": ("m/s", "velocity"),  # in space
    "speed": ("m/s", "velocity"),
}
_ANGLE: Fields = {
    "angle": ("rad", "coordinate"),  # in the plane
    "omega": ("rad/s", "velocity"),  # in the plane
}
_ATTITUDE: Fields = {
    "attitude": ("rad", "coordinate"),  # in space; its error is the angle between two attitudes
    "omega_1": ("rad/s", "velocity"),  # in body axes
    "omega_2": ("rad/s", "velocity"),
    "omega_3": ("rad/s", "velocity"),
}
_TURNING = {PLANE: _ANGLE, SPACE: _ATTITUDE}
_ACCELERATION: Fields = {
    "ax": ("m/s²", "acceleration"),  # in the plane, as the producer gives it
    "ay": ("m/s²", "acceleration"),
}
_ANGULAR: Fields = {"alpha": ("rad/s²", "acceleration")}


@dataclass(frozen=True)
class Body:
    """A rigid body. A particle has no inertia, and no angle or attitude.

    inertia: about the centre of mass [kg m²]: nothing of a particle, J in the plane, and J11, J22,
    J33, J12, J13, J23 in space. axle: the axis (a unit vector in body axes) about which a disk's
    rim of `radius` is round; in space a body with a radius and without an axle is round in all
    directions: a sphere.
    """

    name: str
    shape: Literal["bar", "disk", "block", "sphere", "particle", "rigid", "spokes"]  # the file's
    mass: float  # kg
    inertia: tuple[float, ...]
    points: Mapping[str, Vector]  # m, in body axes from the centre of mass; `center` is 0
    radius: float | None = None  # of a disk or what else is round, m: its rim touches, no point
    axle: Vector | None = None
    size: Vector | None = None  # of a block, m
    tips: tuple[str, ...] = ()  # of spokes: the points with which it touches, counter-clockwise
    frame: Frame = PLANE  # or SPACE

    @property
    def turns(self) -> bool:
        """Whether it has an angle or an attitude: a particle has none."""
        return bool(self.inertia)

    @property
    def moment(self) -> float:
        """J of a body in the plane [kg m²]; 0 of a particle."""
        return self.inertia[0] if self.inertia else 0.0

    @property
    def tensor(self) -> Array:
        """J in body axes about the centre of mass, (1, 1) or (3, 3) [kg m²]; 0 of a particle."""
        return self.frame.tensor(self.inertia)

    def quantities(self) -> dict[str, Fields]:
        """Its fields, and those of each of its points."""
        of_a_point = self.frame.along_axes(_POINT)
        given = self.frame is PLANE  # in space no producer tells an acceleration
        own = {
            **of_a_point,
            **(_ACCELERATION if given else {}),
            **(_TURNING[self.frame] if self.turns else {}),
            **(_ANGULAR if given and self.turns else {}),
        }
        return {self.name: own, **{f"{self.name}.{point}": of_a_point for point in self.points}}

    def numbers(self) -> dict[str, float]:
        """mass [kg] and, if it turns, its inertia [kg m²]: in space the six of the tensor."""
        return {"mass": self.mass} | dict(zip(self.frame.inertias, self.inertia, strict=False))

    def mobility(self, point: str) -> float:
        """The largest of 1/m + d̃ᵀ J⁻¹ d̃ [1/kg]: how easily the point of the free body moves."""
        if not self._finite(point):
            return math.nan
        arm = self.points[point]
        return 1 / self.mass + self.frame.mobility(self.inertia, arm)

    def about(self, point: str) -> float:
        """The least moment of inertia [kg m²] about an axis through the point across its arm d."""
        if not self._finite(point):
            return math.nan
        arm = self.points[point]
        least = self.frame.least_moment(self.inertia, arm)
        return least + self.mass * math.hypot(*arm) ** 2

    def _finite(self, point: str) -> bool:
        """Whether no number is missing, as a mistaken parameter's is."""
        return all(map(math.isfinite, (self.mass, *self.inertia, *self.points[point])))

    def observe(self, states: Array, point: str, field: str) -> Array:
        """(N,) a field of the point ("": of itself), from its states; else KeyError.

        Of `attitude` (N, 4): the quaternion.
        """
        frame, turning = self.frame, [*_TURNING[self.frame]]
        if field == "attitude":
            return states[:, frame.attitude]
        if field in turning:
            columns = [frame.attitude.start, *range(frame.width)[frame.spin]]
            return states[:, columns[turning.index(field)]]
        p, d = self.point(states, point or CENTER), frame.dimension
        if field == "speed":
            return frame.size(p[:, d:])
        names = (*frame.axes, *(f"v{axis}" for axis in frame.axes))
        return dict(zip(names, p.T, strict=True))[field]

    def point(self, states: Array, point: str) -> Array:
        """(N, 2 d): place and velocity of a point (2.1), (2.6), in ground axes."""
        return self.frame.moved(states, self.points[point])
