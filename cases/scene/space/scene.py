"""The scene of Definition 2.1 in space as data. z is up, SI units."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field

from ...fields.kind import WORK, Fields
from ...fields.signal import Signal
from .. import Scene
from ..body import Body
from ..frame import SPACE, Frame
from ..rotation import Vector3
from .constraint import SpatialEdge
from .contact import SpatialContact
from .joint import SpatialJoint


@dataclass(frozen=True)
class SpatialScene(Scene):
    """Bodies, joints, contacts and forces by name, in the order of the case file.

    It reads as a `Scene`; what is in it answers in space.
    """

    gravity: Vector3  # pyright: ignore[reportIncompatibleVariableOverride]
    bodies: Mapping[str, Body]  # pyright: ignore[reportIncompatibleVariableOverride]
    joints: Mapping[str, SpatialJoint]  # pyright: ignore[reportIncompatibleVariableOverride]
    contacts: Mapping[str, SpatialContact]  # pyright: ignore[reportIncompatibleVariableOverride]
    constraints: Mapping[str, SpatialEdge] = field(  # pyright: ignore[reportIncompatibleVariableOverride]
        default_factory=dict
    )
    drives: Mapping[str, Signal] = field(default_factory=dict)
    """Prescribed rates [rad/s, m/s] of joints' freedoms, by the quantity: `q1.omega`,
    `upright.theta_dot`."""

    @property
    def frame(self) -> Frame:
        """The frame of space."""
        return SPACE

    def laws(self) -> Iterator[Signal]:
        """Yields each law in time, of forces and of what is prescribed."""
        yield from (force.signal for force in self.signals())
        yield from self.drives.values()

    def coordinates(self) -> Mapping[str, Fields]:
        """Nothing more: a joint in space has them by itself."""
        return {}

    @property
    def pressed(self) -> tuple[str, ...]:
        """The contacts, by name."""
        return tuple(self.contacts)

    def told_by(self, reaction: str) -> tuple[str, ...]:
        """The reactions of a producer from which one follows: `q1.force` from three components."""
        part, _, field = reaction.rpartition(".")
        if field in WORK and part in self.joints:
            return tuple(f"{part}.{effort}" for effort in self.driven()[part])
        element = self.joints.get(part) or self.contacts.get(part)
        fields = element.components(field) if element else (field,)
        return tuple(f"{part}.{name}" for name in fields)
