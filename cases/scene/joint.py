"""Joints: each kind is the freedoms that it leaves."""

from collections.abc import Mapping
from dataclasses import dataclass
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
from .point import Anchor

Freedom = Literal["turn", "shift", "swing"]
FREEDOMS: dict[str, frozenset[Freedom]] = {
    "pin": frozenset({"turn"}),
    "slide": frozenset({"shift"}),
    "slot": frozenset({"turn", "shift"}),
    "weld": frozenset(),
    "distance": frozenset({"turn", "swing"}),
}

_JOINT: Fields = {
    "fx": ("N", "force"),  # what the first part exerts on the second, in ground axes
    "fy": ("N", "force"),
    "force": ("N", "force"),  # its magnitude; of a rod its tension
    "gap": ("m", "residual"),  # constraint drift
}
_HOLDS_ANGLE: Fields = {"torque": ("N m", "force")}
TURN: Fields = {  # of the second part against the first
    "angle": ("rad", "coordinate"),
    "omega": ("rad/s", "velocity"),
}
SHIFT: Fields = {  # of the second point along the line, from the first
    "shift": ("m", "coordinate"),
    "speed": ("m/s", "velocity"),
}
DRIVES = {  # by the rate that is prescribed, what its drive exerts on the second part
    "omega": ("torque", "N m"),
    "speed": ("drive", "N"),
}
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
    """A joint between a point of one part and a point of another; it leaves the kind's freedoms.

    A swing is that of the second point about the first, on a massless rod.
    along: unit vector in the axes of the first part; a shift is along that line.
    angle: of the second part against the first [rad], held by what leaves no turn.
    length: of the rod [m]; None: the distance of both points at the start.
    """

    name: str
    kind: str  # pin, slide, slot, weld or distance: a key of FREEDOMS
    a: Anchor  # the point of the first part
    b: Anchor  # the point of the second part: reactions are what it takes from the first
    along: Annotated[Direction, Field(description="in the axes of the first part")] = (1.0, 0.0)
    angle: Angle = 0.0
    dry_friction: DryFriction | None = None  # of a slide or a pin
    length: Annotated[float, In("m", above=0)] | None = None

    @property
    def word(self) -> str:
        """The key under which a case file names its two points."""
        return self.kind

    @property
    def turns(self) -> bool:
        """Whether the second part may turn against the first."""
        return "turn" in FREEDOMS[self.kind]

    @property
    def shifts(self) -> bool:
        """Whether the second point may leave the first, along the line."""
        return "shift" in FREEDOMS[self.kind]

    @property
    def swings(self) -> bool:
        """Whether it holds nothing but a distance."""
        return "swing" in FREEDOMS[self.kind]

    def coordinates(self, bodies: Mapping[str, Body]) -> Fields:
        """The fields of the freedoms that it leaves: a turn needs two parts that have an angle."""
        ends = [bodies[at.body] for at in self.refers() if at.body in bodies]
        turns = self.turns and not self.swings and all(body.turns for body in ends)
        return {**(TURN if turns else {}), **(SHIFT if self.shifts else {})}

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
        if field in TURN:
            return self.turn(motion)[list(TURN).index(field)]
        if field not in ("gap", "slip", *SHIFT):
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
        if field == "shift":
            return ux * d[:, 0] + uy * d[:, 1]
        return ux * d[:, 2] + uy * d[:, 3] + turning * gap  # d/dt (u · d): the line turns too

    def power(self, motion: Motion) -> Array:
        """(N,) what the drives of its rates do [W]."""
        rates = [rate for rate in DRIVES if f"{self.name}.{rate}" in motion.drives]
        efforts = [motion.reaction(f"{self.name}.{DRIVES[rate][0]}") for rate in rates]
        speeds = [self.observe(motion, rate) for rate in rates]
        return np.sum(np.multiply(efforts, speeds), axis=0)

    def _tension(self, motion: Motion, fx: Array, fy: Array) -> Array:
        """(N,) positive when the rod pulls its ends together [N]."""
        x, y = (motion.point(self.b) - motion.point(self.a))[:, :2].T
        return -(fx * x + fy * y) / np.hypot(x, y)
