"""Friction by a power of the speed (2.86): of a point of a body, and along a slide."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated

import numpy as np

from ...fields.field import In
from ...fields.friction import Bounds
from ...fields.friction_grammar import VISCOUS
from ...fields.kind import Fields
from ...fields.part import Direction
from ...trajectory import ANGLE, Array
from ..body import Body
from ..frame import PLANE
from ..motion import Motion
from ..point import GROUND, Anchor
from .element import Force

ROUNDING = 1e-15  # of the largest velocity: a speed that is none


def _moving(speed: Array, exponent: float, motion: Motion) -> Array:
    """(N,) the speed, 0 where it is rounding and α < 1: the steep root would make a force of it."""
    if exponent >= 1:
        return speed
    states = motion.trajectory.states.values()
    fastest = max(float(np.max(np.abs(s[:, PLANE.velocity]))) for s in states)
    return np.where(np.abs(speed) <= ROUNDING * fastest, 0.0, speed)


@dataclass(frozen=True)
class Drag(Force):
    """(2.84), (2.86) F = −d |v|^α v/|v| on a point of a body; d is the force at 1 m/s.

    With an edge `along` the body (2.85) F_i = −d_i |v_i|^α sign(v_i) along it and across it: d₊
    forward, d₋ `backward`, as forward if not given, and d⊥ `across`. With α < 1 what nothing else
    moves stops in a finite time: no motion has such an edge, and a point as long as it does not.
    """

    word = "drag"
    stated = True
    at: Anchor  # the point that it slows
    coefficient: Annotated[float, In("N", least=0)]  # d, or d₊ of an edge
    exponent: Annotated[float, In("1", least=0)]  # α
    along: Direction | None = None  # the edge, in body axes; None: alike in all directions
    backward: Annotated[float, In("N", least=0)] | None = None  # d₋
    across: Annotated[float, In("N", least=0)] | None = None  # d⊥

    def refers(self) -> tuple[Anchor, ...]:
        """Its point; the ground does not move."""
        return () if self.at.body == GROUND else (self.at,)

    def why_unfit(self, bodies: Mapping[str, Body]) -> str | None:
        """The ground takes no drag; a particle has no edge; an edge has both its keys."""
        if self.at.body == GROUND:
            return "slows the ground; it acts on a body"
        if self.along is None:
            given = self.across is not None or self.backward is not None
            return "needs the edge that is meant: write `along`" if given else None
        if self.across is None:
            return "has an edge `along`, and needs `across` too"
        body = bodies.get(self.at.body)
        turns = body is None or body.turns
        return None if turns else f"{self.at.body!r} is a particle, which has no edge"

    @property
    def ways(self) -> tuple[Bounds, Bounds]:
        """d along its edge and d across it."""
        back = self.coefficient if self.backward is None else self.backward
        across = self.across or 0.0
        return Bounds(self.coefficient, back), Bounds(across, across)

    def numbers(self) -> dict[str, float]:
        """d, of what has no edge."""
        return {"coefficient": self.coefficient} if self.along is None else {}

    def quantities(self) -> dict[str, Fields]:
        """fx, fy [N] on the point, in ground axes, and force, their size."""
        return {self.name: dict.fromkeys(("fx", "fy", "force"), ("N", "force"))}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) of the force, or its size."""
        fx, fy = self._exerted(motion).T
        return {"fx": fx, "fy": fy, "force": np.hypot(fx, fy)}[field]

    def _exerted(self, motion: Motion) -> Array:
        """(N, 2) [N]."""
        velocity = motion.point(self.at)[:, 2:]
        if self.along is None:
            speed = _moving(np.hypot(*velocity.T), self.exponent, motion)[:, None]
            size = -self.coefficient * speed**self.exponent
            return size * velocity / np.where(speed, speed, 1.0)
        angle, (a, b) = motion.trajectory.states[self.at.body][:, ANGLE], self.along
        x, y = np.cos(angle) * a - np.sin(angle) * b, np.sin(angle) * a + np.cos(angle) * b
        force = np.zeros_like(velocity)
        for edge, d in zip(([x, y], [-y, x]), self.ways, strict=True):
            speed = _moving(np.sum(np.transpose(edge) * velocity, axis=1), self.exponent, motion)
            size = -np.where(speed > 0, d.forward, d.backward) * np.abs(speed) ** self.exponent
            force += np.transpose(edge * (size * np.sign(speed)))
        return force

    @property
    def corner(self) -> bool:
        """Where its slope differs to both sides of the edge."""
        forth, _ = self.ways
        return self.along is not None and forth.forward != forth.backward

    @property
    def ends(self) -> bool:
        """With α < 1."""
        return self.exponent < 1

    def power(self, motion: Motion) -> Array:
        """F·v: along an edge F is not against v."""
        return np.sum(self._exerted(motion) * motion.point(self.at)[:, 2:], axis=1)

    @property
    def _most(self) -> float:
        """The largest d [N]."""
        return max(d for way in self.ways for d in (way.forward, way.backward))


@dataclass(frozen=True)
class Viscous(Force):
    """(2.86) F = −d |v|^α sign(v) along a slide, with d₊ forward and d₋ backward (fig. 2.20).

    v [m/s] is the second part's speed along the slide, F [N] acts on it and its opposite on the
    first part; d is the force at 1 m/s.
    """

    word = "viscous"
    freedom = "shift"
    joint: str  # the slide along which it acts
    coefficient: Annotated[Bounds, VISCOUS]  # d₊ and d₋, N
    exponent: Annotated[float, In("1", above=0)]  # α

    def refers(self) -> tuple[Anchor, ...]:
        """No points: the joint has them."""
        return ()

    @property
    def about(self) -> str:
        """The slide along which it acts."""
        return self.joint

    @property
    def corner(self) -> bool:
        """Where its slope differs to both sides, or has no bound."""
        return self.exponent < 1 or self.coefficient.forward != self.coefficient.backward

    def numbers(self) -> dict[str, float]:
        """d₊ and d₋."""
        return {"forward": self.coefficient.forward, "backward": self.coefficient.backward}

    def quantities(self) -> dict[str, Fields]:
        """speed [m/s] of the second part along the slide, and force [N] on it."""
        return {self.name: {"speed": ("m/s", "velocity"), "force": ("N", "force")}}

    def observe(self, motion: Motion, field: str) -> Array:
        """(N,) speed [m/s] or force [N], positive forward."""
        speed = motion.joints[self.joint].observe(motion, "slip")
        if field == "speed":
            return speed
        speed = _moving(speed, self.exponent, motion)
        d = np.where(speed > 0, self.coefficient.forward, self.coefficient.backward)
        return -d * np.copysign(np.abs(speed) ** self.exponent, speed)

    def power(self, motion: Motion) -> Array:
        """F v."""
        return self.observe(motion, "force") * self.observe(motion, "speed")
