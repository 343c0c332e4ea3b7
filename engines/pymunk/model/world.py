"""A pymunk Space and its parts, by their names in the scene."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field

from pymunk.body import Body
from pymunk.constraints import (
    Constraint,
    DampedRotarySpring,
    DampedSpring,
    GrooveJoint,
    SimpleMotor,
)
from pymunk.shapes import Circle, Poly, Segment, Shape
from pymunk.space import Space

from ....cases.scene import GROUND, Anchor, Scene, Vector
from ...foot_contact import Stride
from .pin import Pin
from .slot import Line


@dataclass(frozen=True)
class Held:
    """A limit's joint, and the impulse of its last step by the limit's side."""

    joint: Constraint
    impulse: Callable[[str], float]


@dataclass(frozen=True)
class World:
    """The space and its parts by their names in the scene.

    A joint's first constraint carries its force. reach: half the length [m] of planes and of
    grooves of the ground. driven: the driven points' bodies. brakes: what rubs in slides and pins.
    motors: those of driven joints. slots: the lines that pin joints hold. pins: those of edges, by
    the reaction: `blade.force`. pairs: what touches another body, and what of that it touches.
    inner: what forces with an inner state have had, at the start and in the middle of each step.
    slowed: the forces that the space's damping is.
    plain: by contact the shape that a user has, in place of `wheels`.
    share: of a step, which the last impulses are of; less than 1 where a foot has cut it.
    """

    scene: Scene
    space: Space
    reach: float
    bodies: dict[str, Body] = field(default_factory=dict)
    driven: dict[str, Body] = field(default_factory=dict)
    joints: dict[str, tuple[Constraint, ...]] = field(default_factory=dict)
    brakes: dict[str, GrooveJoint | SimpleMotor] = field(default_factory=dict)
    lines: dict[str, DampedSpring | DampedRotarySpring] = field(default_factory=dict)
    motors: dict[str, SimpleMotor] = field(default_factory=dict)
    slots: dict[str, Line] = field(default_factory=dict)
    limits: dict[str, Held] = field(default_factory=dict)
    pins: dict[str, Pin] = field(default_factory=dict)
    wheels: dict[str, Circle] = field(default_factory=dict)
    planes: dict[str, Segment] = field(default_factory=dict)
    pairs: dict[str, tuple[Circle, Circle | Segment]] = field(default_factory=dict)
    inner: dict[str, list[float]] = field(default_factory=dict)
    share: list[float] = field(default_factory=lambda: [1.0])
    slowed: set[str] = field(default_factory=set)
    stride: Stride | None = None
    plain: dict[str, Circle | Poly] = field(default_factory=dict)

    @property
    def touching(self) -> Mapping[str, Shape]:
        """By contact the shape that touches its plane."""
        return self.plain or self.wheels

    def body(self, anchor: Anchor) -> Body:
        if anchor.body != GROUND:
            return self.bodies[anchor.body]
        return self.driven.get(anchor.point, self.space.static_body)

    def wheel(self, contact: str) -> Body:
        """The body that touches."""
        return self.bodies[self.scene.touching[contact].body]

    def local(self, anchor: Anchor) -> Vector:
        """The anchor in its body's axes from its centre of mass."""
        if anchor.body != GROUND:
            return self.scene.bodies[anchor.body].points[anchor.point]
        return (0.0, 0.0) if anchor.point in self.driven else self.scene.points[anchor.point].at

    def place(self, anchor: Anchor) -> tuple[float, float]:
        """x and y [m] of a point."""
        x, y = self.body(anchor).local_to_world(self.local(anchor))
        return x, y
