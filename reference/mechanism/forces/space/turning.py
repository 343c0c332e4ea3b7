"""Torques between the two parts of a joint in space, about one of its turns.

Of two turns about n₁, fixed in a, and n₂, fixed in b, with n₁·n₂ = c, ω_b − ω_a = θ̇₁ n₁ + θ̇₂ n₂.
A torque M about the first is the moment M m₁ on b, m₁ = (n₁ − c n₂)/(1 − c²): it turns nothing
about n₂. Of one turn m = n.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .....cases.scene import Scene
from .....cases.scene.chain import across
from .....cases.scene.forces.turning import Motor, Torsion, TorsionDamper, Turning
from .....cases.scene.joint import Joint
from ....laws.force import torsion, torsion_damper
from ...kinematics.signal import signal
from ...kinematics.space.attitude import cross, dot
from ...kinematics.space.kinematics import Bodies, Fixed, Layout

Moment = tuple[int, Any, Any]
"""Number of a body, no force, and a moment (3,) in ground axes."""
NONE = np.zeros(3)


@dataclass(frozen=True)
class Turned:
    """A turn at one state; each vector (2, 3) with its rate.

    first, last: the axes n₁ and n₂; flat, side: what spans the plane of the turn in the part that
    has its axis; pointer: what turns in it with the other part, `way` times.
    """

    first: Any
    last: Any
    flat: Any
    side: Any
    pointer: Any
    weights: tuple[float, float]  # of first and last in m
    way: float
    alone: bool  # one turn: both axes are one
    near: Any = None  # what the motion has counted, where it does

    @property
    def m(self) -> Any:
        """(3,) the moment on b of a unit torque."""
        return self.weights[0] * self.first[0] + self.weights[1] * self.last[0]

    @property
    def angle(self) -> Any:
        """[rad] φ = 2 atan (s/(c + √(c² + s²))) + 2π k: the pointer's, which has a complex step.

        k are the whole turns that bring it to what is counted.
        """
        s, c = dot(self.pointer[0], self.side[0]), dot(self.pointer[0], self.flat[0])
        if np.real(c) >= 0.0:  # of two forms the one that does not divide by little
            phi = 2 * self.way * np.arctan(s / (c + np.sqrt(c * c + s * s)))
        else:
            phi = self.way * (np.pi - 2 * np.arctan(s / (np.sqrt(c * c + s * s) - c)))
        near = 0.0 if self.near is None else self.near
        return phi + 2 * np.pi * np.round(np.real(near - phi) / (2 * np.pi))

    @property
    def rate(self) -> Any:
        """[rad/s] φ̇ = (c ṡ − s ċ)/(c² + s²)."""
        (s, s_dot), (c, c_dot) = (self._shadow(along) for along in (self.side, self.flat))
        return self.way * (c * s_dot - s * c_dot) / (c * c + s * s)

    def _shadow(self, along: Any) -> tuple[Any, Any]:
        """The component of the pointer along a vector, and its rate."""
        (p, p_dot), (u, u_dot) = self.pointer, along
        return dot(p, u), dot(p_dot, u) + dot(p, u_dot)

    @property
    def gradient(self) -> Any:
        """(3,) ∂φ̇/∂ω_b of both axes as they stand: n₂ × (n₁ × n₂)/|n₁ × n₂|²; of one turn n₂."""
        if self.alone:
            return self.last[0]
        one, two = (self.first[0], self.last[0])[:: 1 if self.way > 0 else -1]
        normal = cross(one, two)
        return cross(two, normal) / dot(normal, normal)


def wound(scene: Scene) -> dict[str, Turning]:
    """The turns of which a torsion spring counts the whole ones: by quantity, one that does."""
    return {_called(force): force for force in scene.forces.values() if force.winds}  # type: ignore[misc]


def _called(force: Turning) -> str:
    return f"{force.about}.{force.turn or 'angle'}"


class Turn:
    """The turn about which a force acts. Raises ValueError of one of three."""

    def __init__(self, layout: Layout, force: Turning) -> None:
        joint: Joint = layout.scene.joints[force.about]
        number = joint.turning(force.turn) - len(joint.shifts)
        counts = list(wound(layout.scene))
        self._counted = counts.index(_called(force)) if _called(force) in counts else None
        axes = [np.asarray(f.axis, float) for f in joint.turns]
        if len(axes) > 2:
            raise ValueError(f"{force.name}: about none of three turns can anything act")
        n = axes[number]
        w = axes[1 - number] if len(axes) == 2 else across([joint.turns[0].axis])[0]
        c = float(n @ w)
        flat, own = w - c * n, 1 / (1 - c * c)
        self._weights = (own, -c * own) if number == 0 else (-c * own, own)
        self._way, self._alone = 1.0 if number == 0 else -1.0, len(axes) == 1
        a, b = (layout.numbers[at.body] for at in (joint.a, joint.b))
        holds, other = (a, b) if number == 0 else (b, a)
        vectors = [axes[0], axes[-1], flat, np.cross(n, flat), w]
        self._vectors = Fixed([a, b, holds, holds, other], vectors)

    def at(self, t: Any, bodies: Bodies) -> Turned:
        """At one state."""
        first, last, flat, side, pointer = self._vectors.at(bodies)[:, :2]
        near = None
        if self._counted is not None and len(bodies.wound):
            near = bodies.wound[self._counted]
        return Turned(first, last, flat, side, pointer, self._weights, self._way, self._alone, near)


def couple(numbers: Sequence[int], M: Any) -> Iterator[Moment]:
    """M (3,) on the second part, its opposite on the first."""
    yield numbers[0], NONE, -M
    yield numbers[1], NONE, M


def torsional(force: Torsion, t: Any, numbers: Sequence[int], turn: Turned) -> Iterator[Moment]:
    """(2.45) −c (φ − φ₀) about the turn."""
    yield from couple(numbers, torsion(force.stiffness, force.rest_angle, turn.angle) * turn.m)


def twisted(force: Torsion, turn: Turned) -> Any:
    """(2.45) ½ c (φ − φ₀)²."""
    return 0.5 * force.stiffness * (turn.angle - force.rest_angle) ** 2


def torsionally_damped(
    force: TorsionDamper, t: Any, numbers: Sequence[int], turn: Turned
) -> Iterator[Moment]:
    """(2.47) −d φ̇ about the turn."""
    yield from couple(numbers, torsion_damper(force.damping, turn.rate) * turn.m)


def braked(force: TorsionDamper, turn: Turned) -> Any:
    """(2.46) ½ d φ̇²."""
    return 0.5 * force.damping * turn.rate**2


def motor(force: Motor, t: Any, numbers: Sequence[int], turn: Turned) -> Iterator[Moment]:
    """Its torque about the turn."""
    yield from couple(numbers, signal(force.signal, t)[0] * turn.m)


def driven(force: Motor, t: Any, numbers: Sequence[int], turn: Turned) -> Iterator[Moment]:
    """(2.50) M ∂φ̇/∂v of both parts."""
    yield from couple(numbers, signal(force.signal, t)[0] * turn.gradient)
