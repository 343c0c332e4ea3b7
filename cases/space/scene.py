"""The scene of Definition 2.1 in space as data. z is up, SI units."""

from collections.abc import Mapping
from dataclasses import dataclass, field

from ..frame import SPACE, Frame
from ..scene import Scene
from ..signal import Signal
from .body import SpatialBody
from .contact import SpatialContact
from .joint import SpatialJoint
from .rotation import Vector3


@dataclass(frozen=True)
class SpatialScene(Scene):
    """Bodies, joints, contacts and forces by name, in the order of the case file.

    It reads as a `Scene`; what is in it answers in space.
    """

    gravity: Vector3  # pyright: ignore[reportIncompatibleVariableOverride]
    bodies: Mapping[str, SpatialBody]  # pyright: ignore[reportIncompatibleVariableOverride]
    joints: Mapping[str, SpatialJoint]  # pyright: ignore[reportIncompatibleVariableOverride]
    contacts: Mapping[str, SpatialContact]  # pyright: ignore[reportIncompatibleVariableOverride]
    drives: Mapping[str, Signal] = field(default_factory=dict)
    """Prescribed rates [rad/s, m/s] of joints' freedoms, by the quantity: `q1.omega`,
    `upright.theta_dot`."""

    @property
    def frame(self) -> Frame:
        """Of space."""
        return SPACE
