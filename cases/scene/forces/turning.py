"""Force elements that turn the two parts of a joint against each other."""

from dataclasses import dataclass
from typing import Annotated

from ...fields.field import In
from ...fields.kind import Fields
from ...fields.signal import Signal
from ...fields.signal_grammar import InTime
from ...fields.text import TURN, Text, turn
from ...trajectory import Array
from ..motion import Motion
from ..point import Anchor
from .element import Force


@dataclass(frozen=True)
class Turning(Force):
    """A torque between the two parts of a joint that lets them turn."""

    joint: Annotated[str, Text(turn, TURN, "a joint's name, or joint.turn of named freedoms")]
    """The joint whose turn it is, in space with the turn's name where it has several."""

    def refers(self) -> tuple[Anchor, ...]:
        """No points: the joint has them."""
        return ()

    @property
    def about(self) -> str:
        """Its joint."""
        return self.joint.partition(".")[0]

    @property
    def turn(self) -> str:
        """`theta` of `arm.theta`."""
        return self.joint.partition(".")[2]

    def quantities(self) -> dict[str, Fields]:
        """angle [rad] of the second part against the first, and torque [N m] on the second."""
        return {self.name: {"angle": ("rad", "coordinate"), "torque": ("N m", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) angle [rad] or torque [N m], counter-clockwise about the joint's axis."""
        angle, rate = motion.turn(self.about, self.turn)
        return angle if field == "angle" else self.torque(angle, rate)

    def power(self, motion: Motion) -> Array:
        """M φ̇."""
        angle, rate = motion.turn(self.about, self.turn)
        return self.torque(angle, rate) * rate

    def torque(self, angle: Array, rate: Array) -> Array:
        """(N,) on the second part [N m]; the first takes its opposite."""
        raise NotImplementedError


@dataclass(frozen=True)
class Torsion(Turning):
    """(2.45) A torsion spring of a joint: M = −c(φ − φ₀), φ the second part's turn on the first."""

    word = "torsion"
    winds = True
    stiffness: Annotated[float, In("N m/rad", above=0)]  # c
    rest_angle: Annotated[float, In("rad")]  # φ₀; turns count

    def torque(self, angle: Array, rate: Array) -> Array:
        """(2.45) −c(φ − φ₀)."""
        return -self.stiffness * (angle - self.rest_angle)

    def potential(self, motion: Motion) -> Array:
        """(2.45) ½ c (φ − φ₀)²."""
        angle, _ = motion.turn(self.about, self.turn)
        return 0.5 * self.stiffness * (angle - self.rest_angle) ** 2

    def numbers(self) -> dict[str, float]:
        """c and φ₀."""
        return {"stiffness": self.stiffness, "rest_angle": self.rest_angle}


@dataclass(frozen=True)
class TorsionDamper(Turning):
    """(2.47) A damper of a joint's turn: M = −d φ̇."""

    word = "torsion_damper"
    damping: Annotated[float, In("N m s/rad", least=0)]  # d

    def torque(self, angle: Array, rate: Array) -> Array:
        """(2.47) −d φ̇."""
        return -self.damping * rate

    def numbers(self) -> dict[str, float]:
        """d."""
        return {"damping": self.damping}


@dataclass(frozen=True)
class Motor(Turning):
    """A torque between the parts of a joint that follows a law in time."""

    word = "motor"
    signal: Annotated[Signal, InTime("N m", axes=1)]  # on the second part; the first takes −M

    def quantities(self) -> dict[str, Fields]:
        """Nothing: its torque is given."""
        return {}

    def power(self, motion: Motion) -> Array:
        """M φ̇, M as given."""
        _, rate = motion.turn(self.about, self.turn)
        return self.signal.at(motion.trajectory.times)[:, 0] * rate
