"""Force elements. Each answers for itself: its words, its quantities, its energy, its numbers.

A new one is a class here with its place in FORCES, what it exerts in
reference/mechanism/forces/action.py, and how each engine builds it in engines/*/force.py, with its
law in engines/law.py if it needs one.
"""

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from typing import Annotated, TypeVar

import numpy as np

from ...fields.field import In
from ...fields.kind import Fields
from ...fields.signal import Signal
from ...fields.signal_grammar import InTime
from ...fields.text import Word
from ...trajectory import Array
from ..body import Body
from ..motion import Motion
from ..point import CENTER, GROUND, Anchor
from .drag import Drag, Viscous
from .element import Force
from .limit import Rope, Stops
from .muscle import LinearMuscle, Muscle
from .turning import Motor, Torsion, TorsionDamper

# The force of a magnetic field on a charge that a body carries in its centre.


@dataclass(frozen=True)
class Magnetic(Force):
    """(2.49) V = ½ e B (y ẋ − x ẏ): F = e ṙ × B on the centre of a body, B along z everywhere."""

    word = "magnetic"
    works = False  # it is across the velocity
    body: str  # that carries the charge in its centre
    charge: Annotated[float, In("C")]  # e
    along_z: Annotated[float, In("T")]  # B

    def refers(self) -> tuple[Anchor, ...]:
        """The body's centre."""
        return (Anchor(self.body, CENTER),)


# A torque between two bodies, which no joint has to hold together.


@dataclass(frozen=True)
class Couple(Force):
    """A torque of the first body on the second, which takes its opposite."""

    word = "couple"
    first: str  # the body that takes the opposite
    second: str  # the body that it turns
    signal: Annotated[Signal, InTime("N m", axes=1)]  # on the second, counter-clockwise

    def refers(self) -> tuple[Anchor, ...]:
        """The bodies' centres: any points would do."""
        return Anchor(self.first, CENTER), Anchor(self.second, CENTER)

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """A particle takes no torque."""
        still = [b for b in (self.first, self.second) if b in bodies and not bodies[b].turns]
        return f"{still[0]!r} is a particle and cannot turn" if still else None

    def power(self, motion: Motion) -> Array:
        """M (ω₂ − ω₁)."""
        rate = motion.spin(self.second) - motion.spin(self.first)
        return np.sum(self.signal.at(motion.trajectory.times) * rate, axis=1)


@dataclass(frozen=True)
class Line(Force):
    """A force along the line between two points."""

    a: Anchor  # one end
    b: Anchor  # the other

    def refers(self) -> tuple[Anchor, ...]:
        """Its two ends."""
        return (self.a, self.b)

    def quantities(self) -> dict[str, Fields]:
        """length [m], and force [N], positive when it pulls its ends together."""
        return {self.name: {"length": ("m", "coordinate"), "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) length [m] or force [N]."""
        length, rate = motion.line(self.a, self.b)
        return length if field == "length" else self.tension(length, rate)

    def power(self, motion: Motion) -> Array:
        """−F λ̇ on both ends."""
        length, rate = motion.line(self.a, self.b)
        return -self.tension(length, rate) * rate

    def tension(self, length: Array, rate: Array) -> Array:
        """(N,) with what force [N] it pulls its ends together."""
        raise NotImplementedError


@dataclass(frozen=True)
class Spring(Line):
    """(2.82): F = −c(λ − λ₀) along the line between two points; of a leg or rope on one side."""

    word = "spring"
    stiffness: Annotated[float, In("N/m", above=0)]  # c
    rest_length: Annotated[float, In("m", least=0)]  # λ₀
    only: Annotated[str, Word("side", ("compression", "tension"))] | None = None  # acts; or on both

    def tension(self, length: Array, rate: Array) -> Array:
        """(2.82) c(λ − λ₀)."""
        return self.stiffness * self._stretch(length)

    def _stretch(self, length: Array) -> Array:
        """λ − λ₀, and 0 on the side on which it does not act."""
        least = 0.0 if self.only == "tension" else -np.inf
        most = 0.0 if self.only == "compression" else np.inf
        return np.clip(length - self.rest_length, least, most)

    def potential(self, motion: Motion) -> Array:
        """(2.45) ½ c (λ − λ₀)²."""
        length, _ = motion.line(self.a, self.b)
        return 0.5 * self.stiffness * self._stretch(length) ** 2

    def numbers(self) -> dict[str, float]:
        """c and λ₀, and whether it pulls when stretched and pushes when pressed."""
        sides = {"pulls": self.only != "compression", "pushes": self.only != "tension"}
        numbers = {"stiffness": self.stiffness, "rest_length": self.rest_length}
        return numbers | {side: float(acts) for side, acts in sides.items()}


@dataclass(frozen=True)
class Damper(Line):
    """(2.47) along the line between two points: F = −d λ̇."""

    word = "damper"
    damping: Annotated[float, In("N s/m", least=0)]  # d

    def tension(self, length: Array, rate: Array) -> Array:
        """(2.47) d λ̇."""
        return self.damping * rate

    def numbers(self) -> dict[str, float]:
        """d."""
        return {"damping": self.damping}


@dataclass(frozen=True)
class Push(Force):
    """A force at a point of a body, in ground axes."""

    word = "push"
    at: Anchor  # where it acts, as the body moves
    signal: Annotated[Signal, InTime("N", axes=2)]  # in ground axes, in space along three

    def refers(self) -> tuple[Anchor, ...]:
        """Its point; of the ground there is nothing to push."""
        return () if self.at.body == GROUND else (self.at,)

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """The ground takes no push."""
        return "pushes the ground; a push acts on a body" if self.at.body == GROUND else None

    def power(self, motion: Motion) -> Array:
        """F·v of its point."""
        _, velocity = np.hsplit(motion.point(self.at), 2)
        return np.sum(self.signal.at(motion.trajectory.times) * velocity, axis=1)


@dataclass(frozen=True)
class Torque(Force):
    """A torque on a body, which nothing else takes: counter-clockwise, in space in ground axes."""

    word = "torque"
    body: str  # on which it acts
    signal: Annotated[Signal, InTime("N m", axes=1)]  # in space along three

    def refers(self) -> tuple[Anchor, ...]:
        """The body's centre: any point would do."""
        return (Anchor(self.body, CENTER),)

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """A particle takes no torque."""
        turns = self.body not in bodies or bodies[self.body].turns
        return None if turns else f"{self.body!r} is a particle and cannot turn"

    def power(self, motion: Motion) -> Array:
        """M·ω."""
        given = self.signal.at(motion.trajectory.times)
        return np.sum(given * motion.spin(self.body), axis=1)


NOUNS = (
    Spring,
    Damper,
    Push,
    Torque,
    Couple,
    Torsion,
    TorsionDamper,
    Motor,
    Drag,
    Viscous,
    Magnetic,
    Muscle,
    LinearMuscle,
    Rope,
    Stops,
)
FORCES: dict[str, type[Force]] = {kind.word: kind for kind in NOUNS}
"""By the word of the case file."""


Kind = TypeVar("Kind", bound=Force)


def of_kind(kind: type[Kind], forces: Iterable[Force]) -> Iterator[Kind]:
    """Yields the forces of a kind, in their order."""
    return (force for force in forces if isinstance(force, kind))
