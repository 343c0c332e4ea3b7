"""Joints: each is the freedoms that it leaves."""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Annotated, Literal

import numpy as np
from pydantic import Field

from ..fields.field import In
from ..fields.friction import DryFriction
from ..fields.kind import Fields
from ..fields.part import Angle, Direction
from ..trajectory import Array
from .body import Body
from .motion import Motion
from .point import Anchor, Vector

FreedomKind = Literal["shift", "turn", "ball", "swing"]


@dataclass(frozen=True)
class Freedom:
    """One turn about an axis, one shift along it, all three turns of a ball, or a rod's swing.

    The axis is a unit vector in the axes that are left after the freedoms before it: those of the
    first part, for the first turn and for all shifts. The words are those by which it is observed,
    started and driven: `angle`, `omega` and `torque` of a hinge, `theta`, `theta_dot` and
    `theta_torque` of a joint with named freedoms; "" where it cannot be.
    """

    kind: FreedomKind  # along the axis, about it, …
    axis: Vector = (0.0, 0.0, 0.0)  # unit vector; a ball and a swing have none
    name: str = ""  # of the coordinate, m or rad
    rate: str = ""  # of its rate, m/s or rad/s, which can be prescribed
    effort: str = ""  # of what a drive exerts on the second part, along the freedom, N or N m

    @classmethod
    def turn(cls, axis: Vector, name: str = "") -> "Freedom":
        """A turn about an axis: `angle` with its `omega`, or a name of its own, as `theta`."""
        if name == "angle":
            return cls("turn", axis, name, "omega", "torque")
        return cls("turn", axis, name, *([f"{name}_dot", f"{name}_torque"] if name else []))

    @classmethod
    def shift(cls, axis: Vector, name: str = "") -> "Freedom":
        """A shift along an axis by its name, as `x`."""
        return cls("shift", axis, name, *([f"{name}_dot", f"{name}_force"] if name else []))

    @property
    def unit(self) -> str:
        """The unit of its coordinate."""
        return "m" if self.kind == "shift" else "rad"

    @property
    def coordinate(self) -> Fields:
        """Its place and its rate as they are observed; none without a name."""
        if not self.name:
            return {}
        return {
            self.name: (self.unit, "coordinate"),
            self.rate: (f"{self.unit}/s", "velocity"),
        }

    @property
    def exerted(self) -> Fields:
        """What a drive exerts on it."""
        return {self.effort: ("N" if self.kind == "shift" else "N m", "force")}


_OUT_OF_THE_PLANE = (0.0, 0.0, 1.0)
TURN = Freedom.turn(_OUT_OF_THE_PLANE, "angle")
SHIFT = Freedom("shift", (1.0, 0.0), "shift", "speed", "drive")
FREEDOMS: dict[str, tuple[Freedom, ...]] = {
    "pin": (TURN,),
    "slide": (SHIFT,),
    "slot": (TURN, SHIFT),
    "weld": (),
    "distance": (Freedom.turn(_OUT_OF_THE_PLANE), Freedom("swing")),
}
"""What each kind of joint in the plane leaves; a shift goes along the line of the joint."""
WORDS = (TURN.name, TURN.rate, SHIFT.name, SHIFT.rate)
"""By which the freedoms of joints in the plane are observed."""

_JOINT: Fields = {
    "fx": ("N", "force"),  # what the first part exerts on the second, in ground axes
    "fy": ("N", "force"),
    "force": ("N", "force"),  # its magnitude; of a rod its tension
    "gap": ("m", "residual"),  # constraint drift
}
_HOLDS_ANGLE: Fields = {"torque": ("N m", "force")}
_DRY: Fields = {
    "friction": ("N", "force"),  # on the second part, along the slide
    "slip": ("m/s", "residual"),  # of the second part along the slide; zero while it sticks
}
_DRY_TURN: Fields = {
    "friction": ("N m", "force"),  # on the second part, counter-clockwise
    "slip": ("rad/s", "residual"),  # how fast the second part turns against the first
}


@dataclass(frozen=True)
class Joint:
    """A joint between a point of one part and a point of another; it leaves some freedoms.

    angle: of the second part against the first [rad], held by what leaves no turn.
    length: of the rod [m]; None: the distance of both points at the start.
    """

    name: str
    kind: str  # pin, slide, slot, weld or distance: a key of FREEDOMS
    a: Anchor  # the point of the first part
    b: Anchor  # the point of the second part: reactions are what it takes from the first
    freedoms: tuple[Freedom, ...]  # all that it leaves: an engine needs no more than these
    angle: float = 0.0
    dry_friction: DryFriction | None = None  # of a slide or a pin
    length: float | None = None

    @property
    def word(self) -> str:
        """The key under which a case file names its two points."""
        return self.kind

    @property
    def shifts(self) -> tuple[Freedom, ...]:
        """Those by which the second point may leave the first, along a line."""
        return tuple(f for f in self.freedoms if f.kind == "shift")

    @property
    def turns(self) -> tuple[Freedom, ...]:
        """Those by which the second part may turn against the first."""
        return tuple(f for f in self.freedoms if f.kind == "turn")

    @property
    def swings(self) -> bool:
        """Whether the second point may swing about the first, on a massless rod."""
        return any(f.kind == "swing" for f in self.freedoms)

    @property
    def along(self) -> Vector:
        """The line of what shifts: a unit vector in the axes of the first part."""
        return self.shifts[0].axis

    @property
    def rates(self) -> dict[str, Freedom]:
        """The named freedoms by the names of their rates, which can be prescribed."""
        return {f.rate: f for f in self.freedoms if f.name}

    def coordinates(self, bodies: Mapping[str, Body]) -> Fields:
        """The fields of the freedoms that it leaves: a turn needs two parts that have an angle."""
        turns = all(bodies[at.body].turns for at in self.refers() if at.body in bodies)
        left = (f.coordinate for f in self.freedoms if turns or f.kind != "turn")
        return {name: of for fields in left for name, of in fields.items()}

    def refers(self) -> tuple[Anchor, ...]:
        """The points it joins, in the order of the file."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """Its reactions and its gap; slip and friction where there is dry friction."""
        held = {} if self.turns else _HOLDS_ANGLE
        dry = _DRY if self.shifts else _DRY_TURN
        return {self.name: {**_JOINT, **held, **(dry if self.dry_friction else {})}}

    def numbers(self) -> dict[str, float]:
        """The dry friction in motion."""
        return {} if self.dry_friction is None else self.dry_friction.numbers()

    def turn(self, motion: Motion, freedom: str = "") -> tuple[Array, Array]:
        """(N,) the angle [rad] of the second part against the first, and its rate [rad/s]."""
        (a, a_rate), (b, b_rate) = (motion.turned(at.body) for at in (self.a, self.b))
        zero = np.zeros_like(motion.trajectory.times)  # the ground's are one number
        return zero + b - a, zero + b_rate - a_rate

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) what follows from the states and the given reactions; else KeyError."""
        if field == "force":
            fx, fy = (motion.reaction(f"{self.name}.{axis}") for axis in ("fx", "fy"))
            return self._tension(motion, fx, fy) if self.swings else np.hypot(fx, fy)
        if field in (TURN.name, TURN.rate):
            return self.turn(motion)[field == TURN.rate]
        if field not in ("gap", "slip", SHIFT.name, SHIFT.rate):
            raise KeyError(f"{self.name}.{field}")
        if field == "slip" and not self.shifts:
            return self.turn(motion)[1]
        d = motion.point(self.b) - motion.point(self.a)
        if not self.shifts:
            apart = np.hypot(d[:, 0], d[:, 1])
            held = apart[0] if self.length is None else self.length
            return apart - held if self.swings else apart
        turned, turning = motion.turned(self.a.body)
        ux = np.cos(turned) * self.along[0] - np.sin(turned) * self.along[1]
        uy = np.sin(turned) * self.along[0] + np.cos(turned) * self.along[1]
        gap = ux * d[:, 1] - uy * d[:, 0]
        if field == "gap":
            return gap
        if field == SHIFT.name:
            return ux * d[:, 0] + uy * d[:, 1]
        return ux * d[:, 2] + uy * d[:, 3] + turning * gap  # d/dt (u · d): the line turns too

    def power(self, motion: Motion) -> Array:
        """(N,) what the drives of its rates do [W]."""
        driven = [f for f in self.rates.values() if f"{self.name}.{f.rate}" in motion.drives]
        efforts = [motion.reaction(f"{self.name}.{f.effort}") for f in driven]
        speeds = [self.observe(motion, f.rate) for f in driven]
        return np.sum(np.multiply(efforts, speeds), axis=0)

    def _tension(self, motion: Motion, fx: Array, fy: Array) -> Array:
        """(N,) positive when the rod pulls its ends together [N]."""
        x, y = (motion.point(self.b) - motion.point(self.a))[:, :2].T
        return -(fx * x + fy * y) / np.hypot(x, y)


def planar_joint(
    name: str,
    kind: str,
    a: Anchor,
    b: Anchor,
    along: Annotated[Direction, Field(description="in the axes of the first part")] = (1.0, 0.0),
    angle: Angle = 0.0,
    dry_friction: DryFriction | None = None,
    length: Annotated[float, In("m", above=0)] | None = None,
) -> Joint:
    """A joint between a point of one part and a point of another; it leaves the kind's freedoms."""
    left = [replace(f, axis=along) if f.kind == "shift" else f for f in FREEDOMS[kind]]
    return Joint(name, kind, a, b, tuple(left), angle, dry_friction, length)
