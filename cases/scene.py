"""The scene of Definition 2.1 as data: bodies, joints, contacts, forces and points.

Neutral: it names no engine and no method. Planar frame: x right, y up, angles
counter-clockwise, SI units. Lengths on a body are in body axes from its centre of mass.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Literal

GROUND = "ground"
CENTER = "center"
FLOOR = "floor"
STANDARD_GRAVITY = 9.80665  # m/s², the book's value

Vector = tuple[float, float]


@dataclass(frozen=True)
class Body:
    """A rigid body. A particle has no inertia and no angle."""

    name: str
    shape: Literal["bar", "disk", "block", "particle", "rigid"]
    mass: float
    inertia: float | None  # about the centre of mass, kg m²; None: it cannot turn
    points: Mapping[str, Vector]
    radius: float | None = None  # of a disk, m

    @property
    def turns(self) -> bool:
        return self.inertia is not None


@dataclass(frozen=True)
class GroundPoint:
    """A point of the ground, or one driven at a constant velocity (rheonomous)."""

    at: Vector
    velocity: Vector = (0.0, 0.0)

    @property
    def driven(self) -> bool:
        return self.velocity != (0.0, 0.0)

    def position(self, t: float) -> Vector:
        """Position [m] at time t [s]."""
        return (self.at[0] + self.velocity[0] * t, self.at[1] + self.velocity[1] * t)


@dataclass(frozen=True)
class Anchor:
    """A named point of a body or of the ground."""

    body: str
    point: str

    def __str__(self) -> str:
        return f"{self.body}.{self.point}"


@dataclass(frozen=True)
class Bounds:
    """A friction force [N] against motion forward (along the slide) and backward."""

    forward: float
    backward: float


@dataclass(frozen=True)
class Smooth:
    """The book's smooth law (2.95): the band Δ [m/s] and the sharpness A [s/m]."""

    band: float
    sharpness: float


@dataclass(frozen=True)
class DryFriction:
    """(2.89) on a slide, along its line; `smooth` replaces the exact law by (2.95)."""

    static: Bounds
    kinetic: Bounds
    smooth: Smooth | None = None


@dataclass(frozen=True)
class Joint:
    """A pin lets two bodies turn, a slide lets them shift along one line, a weld nothing.

    `along` is a unit vector in the axes of the first part; `angle` [rad] is the angle of the
    second part against the first, which a slide and a weld hold.
    """

    name: str
    kind: Literal["pin", "slide", "weld"]
    a: Anchor
    b: Anchor
    along: Vector = (1.0, 0.0)
    angle: float = 0.0
    dry_friction: DryFriction | None = None


@dataclass(frozen=True)
class Contact:
    """A disk's rim, a particle or a point of a bar on the floor y = 0.

    It opens, slides and sticks or rolls as friction says, and an impact goes by `restitution`.
    `ideal: rolling` assumes that it only rolls; the reference checks that at every sample.
    """

    name: str
    at: Anchor  # a disk is named by its centre and touches with its rim
    static: float  # coefficient of friction; at least `kinetic`
    kinetic: float
    restitution: float = 0.0
    ideal: Literal["rolling"] | None = None

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


@dataclass(frozen=True)
class Spring:
    """(2.82): F = −c(λ − λ₀) along the line between two points."""

    name: str
    a: Anchor
    b: Anchor
    stiffness: float
    rest_length: float


@dataclass(frozen=True)
class Damper:
    """(2.47) along the line between two points: F = −d λ̇."""

    name: str
    a: Anchor
    b: Anchor
    damping: float


@dataclass(frozen=True)
class Signal:
    """A named law in time: constant A, ramp A t, or sine A sin(w t + phase)."""

    law: Literal["constant", "ramp", "sine"]
    amplitude: tuple[float, ...]  # N for a push (x, y), N m for a torque (one entry)
    angular_frequency: float = 0.0
    phase: float = 0.0


@dataclass(frozen=True)
class Push:
    """A force at a point of a body, in ground axes."""

    name: str
    at: Anchor
    signal: Signal


@dataclass(frozen=True)
class Torque:
    """A torque on a body."""

    name: str
    body: str
    signal: Signal


Force = Spring | Damper | Push | Torque


@dataclass(frozen=True)
class Scene:
    """Bodies, joints, contacts and forces by name, in the order of the case file."""

    gravity: Vector
    points: Mapping[str, GroundPoint]
    bodies: Mapping[str, Body]
    joints: Mapping[str, Joint]
    contacts: Mapping[str, Contact]
    forces: Mapping[str, Force]

    def springs(self) -> Iterator[Spring]:
        return (f for f in self.forces.values() if isinstance(f, Spring))

    def dampers(self) -> Iterator[Damper]:
        return (f for f in self.forces.values() if isinstance(f, Damper))

    def signals(self) -> Iterator[Push | Torque]:
        return (f for f in self.forces.values() if isinstance(f, Push | Torque))
