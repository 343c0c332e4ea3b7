"""Contacts with the floor, or in the plane with another plane of the ground."""

from dataclasses import dataclass, replace
from typing import Literal

import numpy as np

from ..fields.kind import Fields
from ..trajectory import ANGLE, OMEGA, Array
from .frame import PLANE, SPACE, Frame
from .motion import Motion
from .plane import FLOOR_OF_SPACE, LEVEL, Plane
from .point import Anchor

_CONTACT: Fields = {
    "normal": ("N", "force"),  # on the body, along the plane's normal
    "tangent": ("N", "force"),  # on the body, along `plane.along`: x, of the floor
    "slip": ("m/s", "residual"),  # of the point that touches
    "gap": ("m", "residual"),  # its height above the plane
}
_ONE_POINT: Fields = {
    # its place along the plane (of a disk that + R angle) against the start: (2.18)
    "drift": ("m", "residual"),
}


_IN_SPACE: Fields = {
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
class Contact:
    """A disk's rim, a particle, a point of a bar or the tips of spokes on a plane of the ground.

    It opens, slides and sticks or rolls as friction says, and an impact goes by `restitution`.
    `ideal: rolling` assumes that it only rolls, `ideal: pivot` that what stands on the plane never
    slips; the reference checks that at every sample. With `ahead_of` a point swings through the
    plane and strikes it only where it is further along it than that other point. In space a disk's
    rim or a sphere only rolls on the floor z = 0, or a point of a body stays where it stands there:
    slipping in two directions has no finite set of modes.
    """

    name: str
    at: Anchor  # a disk is named by its centre and touches with its rim
    static: float  # coefficient of friction; at least `kinetic`
    kinetic: float  # coefficient of friction where it slides
    restitution: float = 0.0  # speed after an impact over that before
    ideal: Literal["rolling", "pivot"] | None = (
        None  # the reference assumes and checks it; an engine need not
    )
    plane: Plane = LEVEL  # the floor y = 0, or another line of the ground; `on` is its name
    tips: tuple[str, ...] = ()  # of spokes named by their centre: the points that may touch
    ahead_of: Anchor | None = None  # of walkers: what it has to be ahead of to strike
    rim: bool = False  # whether it is a disk's in space, where a sphere has none
    frame: Frame = PLANE  # or SPACE

    @property
    def body(self) -> str:
        return self.at.body

    @property
    def on(self) -> str:
        """The name of its plane."""
        return self.plane.name

    def refers(self) -> tuple[Anchor, ...]:
        """The point that touches, and the point that it has to be ahead of."""
        return (self.at,) if self.ahead_of is None else (self.at, self.ahead_of)

    @property
    def friction(self) -> float:
        """The one coefficient that engines know."""
        return self.kinetic

    @property
    def switches(self) -> bool:
        """Whether it may open, slide and stick, instead of only rolling."""
        return self.frame is PLANE and self.ideal != "rolling"

    def each(self) -> "tuple[Contact, ...]":
        """One contact for every point that may touch: itself, or `feet.tip0`, `feet.tip1`, …"""
        return tuple(
            replace(self, name=f"{self.name}.{tip}", at=Anchor(self.body, tip), tips=())
            for tip in self.tips
        ) or (self,)

    def quantities(self) -> dict[str, Fields]:
        """Its reactions, and where and how the touching point moves."""
        if self.frame is SPACE:
            return {self.name: {**_IN_SPACE, **(_RIM if self.rim else {})}}
        return {self.name: _CONTACT if self.tips else {**_CONTACT, **_ONE_POINT}}

    def components(self, field: str) -> tuple[str, ...]:
        """The reactions that a producer gives, from which a force follows."""
        return ("fx", "fy") if field in ("along", "side") else (field,)

    def numbers(self) -> dict[str, float]:
        """The coefficient of friction, of every tip."""
        names = [f"{tip}.friction" for tip in self.tips] or ["friction"]
        return dict.fromkeys(names, self.friction)

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) of the lowest point of a rim, or of the point that touches; else KeyError.

        along, side: in space of the force (fx, fy), along the track axle × z, on which a disk whose
        axle points to the left rolls forward, and along the axle's shadow on the floor.
        """
        if self.frame is SPACE:
            return self._in_space(motion, field)
        if self.tips:
            return self._of_tips(motion, field)
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

    def _of_tips(self, motion: Motion, field: str) -> Array:
        """(N,) the slip of the tip on which it stands; how high the next lowest one is."""
        if field not in ("gap", "slip"):
            raise KeyError(f"{self.name}.{field}")
        ux, uy = self.plane.along
        points = [motion.point(contact.at).T for contact in self.each()]
        heights = np.array([self.plane.height(x, y) for x, y, _, _ in points])
        slips = np.array([ux * vx + uy * vy for _, _, vx, vy in points])
        order = np.argsort(heights, axis=0)
        values, rank = (heights, 1) if field == "gap" else (slips, 0)
        return np.take_along_axis(values, order[rank][None], axis=0)[0]

    def _in_space(self, motion: Motion, field: str) -> Array:
        """(N,) of the body's lowest point, or of the pivot; else KeyError."""
        if field in ("along", "side"):
            fx, fy = (motion.reaction(f"{self.name}.{name}") for name in self.components(field))
            axle = self._axle(motion)[:, :2]
            axle = axle / np.linalg.norm(axle, axis=1, keepdims=True)
            if field == "side":
                return fx * axle[:, 0] + fy * axle[:, 1]
            return fx * axle[:, 1] - fy * axle[:, 0]
        if field not in ("slip", "gap"):
            raise KeyError(f"{self.name}.{field}")
        states, arm = motion.trajectory.states[self.body], self._arm(motion)
        if field == "gap":
            return states[:, SPACE.place][:, 2] + arm[:, 2]
        omega = SPACE.omega(states)
        velocity = states[:, SPACE.velocity] + np.cross(omega, arm)
        return np.hypot(velocity[:, 0], velocity[:, 1])

    def _axle(self, motion: Motion) -> Array:
        """(N, 3) of a disk, in ground axes."""
        states = motion.trajectory.states[self.body]
        return SPACE.turned(states[:, SPACE.attitude], motion.bodies[self.body].axle)

    def _arm(self, motion: Motion) -> Array:
        """(N, 3) from the centre to the lowest point, or to the pivot."""
        body, up = motion.bodies[self.body], np.array([0.0, 0.0, 1.0])
        if self.ideal == "pivot":
            states = motion.trajectory.states[self.body]
            return SPACE.turned(states[:, SPACE.attitude], body.points[self.at.point])
        if not self.rim:
            return np.tile(-body.radius * up, (len(motion.trajectory.times), 1))
        n = self._axle(motion)
        steep = up - n[:, 2:] * n
        return -body.radius * steep / np.linalg.norm(steep, axis=1, keepdims=True)


def spatial_contact(
    name: str,
    at: Anchor,
    friction: float,
    rim: bool = False,
    ideal: Literal["rolling", "pivot"] = "rolling",
) -> Contact:
    """A contact that rolls without slip on the floor z = 0, or stands there on a point."""
    return Contact(
        name, at, friction, friction, ideal=ideal, plane=FLOOR_OF_SPACE, rim=rim, frame=SPACE
    )
