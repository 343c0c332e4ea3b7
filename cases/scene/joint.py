"""Joints: each is the freedoms that it leaves."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Annotated, Any, Literal

import numpy as np
from pydantic import Field

from ..fields.field import In
from ..fields.friction import DryFriction
from ..fields.kind import WORK, Fields
from ..fields.part import Angle, Direction
from ..trajectory import Array
from .body import Body
from .chain import Turns, orthonormal, shift_coordinates, turn_solutions
from .counting import counted, nearest
from .frame import PLANE, SPACE, Frame
from .motion import Motion
from .point import GROUND, Anchor, Vector
from .rotation import UPRIGHT

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
        """The force or torque that a drive exerts on it, by its name."""
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
    "fz": ("N", "force"),  # in space
    "force": ("N", "force"),  # its magnitude; of a rod its tension
    "gap": ("m", "residual"),  # constraint drift
}
_TORQUE: Fields = {"torque": ("N m", "force")}  # in the plane, of what holds an angle
_MOMENTS: Fields = {
    "mx": ("N m", "force"),  # in space, of what holds an attitude: about the second point
    "my": ("N m", "force"),
    "mz": ("N m", "force"),
    "moment": ("N m", "force"),
}
HELD = (*_JOINT, *_MOMENTS, *WORK)
"""Names of what can be observed of any joint in space: no freedom has these names."""
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

    What is not left free is held. In space shifts come before turns; without a turn the axes of
    both parts are parallel. angle: of the second part against the first [rad], held by what leaves
    no turn in the plane. length: of the rod [m]; None: the distance of both points at the start.
    begins: in space by the name of a turn, the angle [rad] near which the start has it: an attitude
    tells it but for whole turns, and of three turns in two ways.
    """

    name: str
    kind: str  # the file's word: in the plane a key of FREEDOMS, in space as said above
    a: Anchor  # the point of the first part
    b: Anchor  # the point of the second part: reactions are what it takes from the first
    freedoms: tuple[Freedom, ...]  # all that it leaves: an engine needs no more than these
    angle: float = 0.0  # rad
    dry_friction: DryFriction | None = None  # of a slide or a pin
    length: float | None = None  # m
    begins: Mapping[str, float] = field(default_factory=dict)
    frame: Frame = PLANE  # or SPACE

    @property
    def word(self) -> str:
        """The key under which a case file names its two points."""
        return "of" if self.kind == "freedoms" else self.kind

    @property
    def shifts(self) -> tuple[Freedom, ...]:
        """The freedoms by which the second point may leave the first, along a line."""
        return tuple(f for f in self.freedoms if f.kind == "shift")

    @property
    def turns(self) -> tuple[Freedom, ...]:
        """The freedoms by which the second part may turn on the first: up to three, or one ball."""
        return tuple(f for f in self.freedoms if f.kind in ("turn", "ball"))

    @property
    def swings(self) -> bool:
        """Whether the second point may swing about the first, on a massless rod."""
        return any(f.kind == "swing" for f in self.freedoms)

    @property
    def holds_attitude(self) -> bool:
        """Whether it leaves fewer turns than there are."""
        most = 1 if self.frame is PLANE else 3
        return len(self.turns) < most and not any(f.kind == "ball" for f in self.freedoms)

    @property
    def counts(self) -> bool:
        """Whether its whole turns have to be counted: an angle in the plane has them by itself."""
        named = any(f.kind == "turn" and f.name for f in self.freedoms)
        return named and self.frame is SPACE

    @property
    def along(self) -> Vector:
        """The line of what shifts: a unit vector in the axes of the first part."""
        return self.shifts[0].axis

    @property
    def named(self) -> tuple[Freedom, ...]:
        """The freedoms that can be observed and started by their names."""
        return tuple(f for f in self.freedoms if f.name)

    @property
    def rates(self) -> dict[str, Freedom]:
        """The named freedoms by the names of their rates, which can be prescribed."""
        return {f.rate: f for f in self.named}

    @property
    def begun(self) -> list[float | None]:
        """The start angle of each turn, None where it is not given."""
        return [self.begins.get(f.name) for f in self.turns]

    def turning(self, name: str) -> int:
        """The number of a turn among its freedoms: by its name, or by none where it is `angle`.

        Raises ValueError where there is no such turn.
        """
        return [f.name if f.kind == "turn" else None for f in self.freedoms].index(name or "angle")

    def refers(self) -> tuple[Anchor, ...]:
        """The points it joins, in the order of the file."""
        return (self.a, self.b)

    def observed(self, bodies: Mapping[str, Body]) -> Fields:
        """The fields of its freedoms: in the plane those of a turn if both parts can turn."""
        turns = self.frame is SPACE or all(
            bodies[at.body].turns for at in self.refers() if at.body in bodies
        )
        coordinates = (f.coordinate for f in self.named if turns or f.kind != "turn")
        return {name: of for fields in coordinates for name, of in fields.items()}

    def quantities(self) -> dict[str, Fields]:
        """Its reactions and its gap; slip and friction where there is dry friction."""
        moments = _TORQUE if self.frame is PLANE else _MOMENTS
        dry = _DRY if self.shifts else _DRY_TURN
        own = self.frame.along_axes(_JOINT)
        held, rubs = self.holds_attitude, self.dry_friction is not None
        return {self.name: {**own, **(moments if held else {}), **(dry if rubs else {})}}

    def components(self, field: str) -> tuple[str, ...]:
        """The reactions that a producer gives, from which a force or moment follows.

        In the plane a producer gives each, but for the tension of a rod, which has a sign.
        """
        if field == "force" and (self.swings or self.frame is SPACE):
            return tuple(f"f{axis}" for axis in self.frame.axes)
        return ("mx", "my", "mz") if field == "moment" else (field,)

    def numbers(self) -> dict[str, float]:
        """The dry friction in motion."""
        return {} if self.dry_friction is None else self.dry_friction.numbers()

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) what follows from the states and the given reactions; else KeyError."""
        if field == "force":
            force = self._reactions(motion, "f")
            return self._tension(motion, force) if self.swings else self.frame.size(force)
        if field == "moment":
            return self.frame.size(self._reactions(motion, "m"))
        if field == "gap":
            return self._gap(motion)
        if field == "slip":  # of what rubs
            field = SHIFT.rate if self.shifts else TURN.rate
        for names in ([f.name for f in self.freedoms], [f.rate for f in self.freedoms]):
            if field in names:
                place_or_rate = self.coordinates(motion)[field in self.rates]
                return place_or_rate[:, names.index(field)]
        raise KeyError(f"{self.name}.{field}")

    def turn(self, motion: Motion, freedom: str = "") -> tuple[Array, Array]:
        """(N,) the angle [rad] of a turn, its whole turns counted, and its rate [rad/s]."""
        if self.frame is PLANE:
            return self._angle(motion)
        at = self.turning(freedom)
        angles, rates = self.coordinates(motion)
        return angles[:, at], rates[:, at]

    def power(self, motion: Motion) -> Array:
        """(N,) what the drives of its rates do [W]."""
        driven = [f for f in self.named if f"{self.name}.{f.rate}" in motion.drives]
        efforts = [motion.reaction(f"{self.name}.{f.effort}") for f in driven]
        speeds = [self.observe(motion, f.rate) for f in driven]
        return np.sum(np.multiply(efforts, speeds), axis=0)

    def coordinates(self, motion: Motion) -> tuple[Array, Array]:
        """(N, K) the place [m or rad] of each freedom, and its rate; nan of a ball and a swing.

        Whole turns in space are those that the motion tells, or counted along its samples from the
        start.
        """
        d = motion.point(self.b) - motion.point(self.a)
        none = np.full(len(d), np.nan)
        if self.frame is PLANE:
            ways = {"turn": self._angle, "shift": self._shift}
            each = [ways[f.kind](motion) if f.kind in ways else (none, none) for f in self.freedoms]
            both = [np.reshape(values, (-1, len(d))).T for values in zip(*each, strict=True)]
            return both[0], both[1]
        first = axes_of(motion, self.a.body)
        shifts = shift_coordinates([f.axis for f in self.shifts], d[:, :3], d[:, 3:], *first)
        if any(f.kind == "ball" for f in self.freedoms):
            return np.column_stack([shifts[0], none]), np.column_stack([shifts[1], none])
        turns = self.turned(motion)
        return np.hstack([shifts[0], turns.angles]), np.hstack([shifts[1], turns.rates])

    def turned(self, motion: Motion) -> Turns:
        """The turns of a joint in space; not of a ball."""
        first, second = (axes_of(motion, at.body) for at in (self.a, self.b))
        ways = turn_solutions([f.axis for f in self.turns], *first, *second)
        expected = motion.trajectory.near.get(self.name)
        if expected is not None:
            return nearest(ways, expected)
        return counted(ways, motion.trajectory.times, self.begun)

    def _angle(self, motion: Motion) -> tuple[Array, Array]:
        """(N,) the angle [rad] in the plane of the second part against the first, and its rate."""
        (a, a_rate), (b, b_rate) = (motion.turned(at.body) for at in (self.a, self.b))
        zero = np.zeros_like(motion.trajectory.times)  # the ground's are one number
        return zero + b - a, zero + b_rate - a_rate

    def _shift(self, motion: Motion) -> tuple[Array, Array]:
        """(N,) how far [m] the second point is along the line in the plane, and its rate."""
        (ux, uy), turning, d = self._line(motion)
        gap = ux * d[:, 1] - uy * d[:, 0]
        # d/dt (u · d): the line turns too
        return ux * d[:, 0] + uy * d[:, 1], ux * d[:, 2] + uy * d[:, 3] + turning * gap

    def _line(self, motion: Motion) -> tuple[Any, Any, Array]:
        """The line of a shift in the plane, how fast it turns, and what is between the points."""
        (x, y), (turned, turning) = self.along, motion.turned(self.a.body)
        ux, uy = np.cos(turned) * x - np.sin(turned) * y, np.sin(turned) * x + np.cos(turned) * y
        return (ux, uy), turning, motion.point(self.b) - motion.point(self.a)

    def _gap(self, motion: Motion) -> Array:
        """(N,) how far [m] the second point is from where the freedoms let it be.

        In the plane to the left of the line of a shift; of a rod how much longer it is than held.
        """
        if self.frame is PLANE and self.shifts:
            (ux, uy), _, d = self._line(motion)
            return ux * d[:, 1] - uy * d[:, 0]
        d, _ = np.hsplit(motion.point(self.b) - motion.point(self.a), 2)
        if self.shifts:
            q, _ = axes_of(motion, self.a.body)
            for freedom in orthonormal([f.axis for f in self.shifts]):
                u = self.frame.turned(q, freedom)
                d = d - np.sum(d * u, axis=1, keepdims=True) * u
        apart = self.frame.size(d)
        return apart - (apart[0] if self.length is None else self.length) if self.swings else apart

    def _reactions(self, motion: Motion, letter: str) -> Array:
        """(N, d) the force f or moment m as the producer gives it."""
        names = [f"{self.name}.{letter}{axis}" for axis in self.frame.axes]
        return np.transpose([motion.reaction(name) for name in names])

    def _tension(self, motion: Motion, force: Array) -> Array:
        """(N,) positive when the rod pulls its ends together [N]."""
        x, y = (motion.point(self.b) - motion.point(self.a))[:, :2].T
        fx, fy = force.T
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
    freedoms = [replace(f, axis=along) if f.kind == "shift" else f for f in FREEDOMS[kind]]
    return Joint(name, kind, a, b, tuple(freedoms), angle, dry_friction, length)


def axes_of(motion: Motion, body: str) -> tuple[Array, Array]:
    """In space attitude (N, 4) and ω (N, 3), in its own axes, of a part; the ground stands still.

    A particle has no axes of its own: its states hold the ground's.
    """
    n = len(motion.trajectory.times)
    if body == GROUND:
        return np.tile(UPRIGHT, (n, 1)), np.zeros((n, 3))
    states = motion.trajectory.states[body]
    return states[:, SPACE.attitude], states[:, SPACE.spin]
