"""One turn of a joint: its angle, its rate, and the moment that a torque about it is."""

from dataclasses import dataclass
from typing import Any, Protocol

import numpy as np

from ....cases.scene.chain import orthogonal_complement
from ....cases.scene.forces.turning import Turning
from ..kinematics.frame import PLANE, Vec
from ..kinematics.kinematics import Direction, Kinematics, Part
from ..kinematics.spatial_coordinates import counted_as

Couple = list[tuple[Part, Vec | None, Vec | None]]


class Turn(Protocol):
    """A turn at one state, as formulas."""

    @property
    def angle(self) -> Any:
        """φ [rad], whole turns counted."""
        ...

    @property
    def rate(self) -> Any:
        """φ̇ [rad/s]."""
        ...

    @property
    def m(self) -> Vec:
        """The moment on the second part that a torque of 1 is, in ground axes."""
        ...

    def gradient(self, k: Kinematics) -> Vec:
        """∂φ̇/∂ω of the second part, in ground axes."""
        ...

    def couple(self, k: Kinematics, M: Vec) -> Couple:
        """A moment on the second part, its opposite on the first."""
        ...


@dataclass(frozen=True)
class Between:
    """The two parts of a joint."""

    a: Part
    b: Part

    def couple(self, k: Kinematics, M: Vec) -> Couple:
        """A moment on the second part, its opposite on the first."""
        into = k.frame.into
        return [(self.b, None, into(self.b.R, M)), (self.a, None, into(self.a.R, -M))]


@dataclass(frozen=True)
class PlanarTurn(Between):
    """In the plane: φ_b − φ_a."""

    @property
    def angle(self) -> Any:
        return self.b.angle - self.a.angle

    @property
    def rate(self) -> Any:
        return self.b.omega[0] - self.a.omega[0]

    @property
    def m(self) -> Vec:
        return Vec((1.0,))

    def gradient(self, k: Kinematics) -> Vec:
        return self.m


@dataclass(frozen=True)
class SpatialTurn(Between):
    """About an axis, of one turn or of two.

    Of two turns about n₁, fixed in a, and n₂, fixed in b, with n₁·n₂ = c, the parts turn with
    ω_b − ω_a = θ̇₁ n₁ + θ̇₂ n₂. A torque about the first is the moment M m₁ on b,
    m₁ = (n₁ − c n₂)/(1 − c²): it turns nothing about n₂. Of one turn m = n.

    first, last: the axes n₁ and n₂. flat, side: what spans the plane of the turn in the part that
    has its axis; pointer: what turns in it with the other part, `way` times.
    """

    first: Direction
    last: Direction
    flat: Direction
    side: Direction
    pointer: Direction
    weights: tuple[float, float]  # of first and last in m
    way: float
    alone: bool  # one turn: both axes are one
    k: Kinematics
    near: Any  # what the motion has counted; None where nobody does

    @property
    def m(self) -> Vec:
        own, other = self.weights
        return self.first.u * own + self.last.u * other

    @property
    def angle(self) -> Any:
        """The pointer's, with the whole turns that bring it nearest to what is counted."""
        s, c = self.pointer.u @ self.side.u, self.pointer.u @ self.flat.u
        near = 0.0 if self.near is None else self.near
        return self.k.tape.call(pointed, s, c, near * self.way) * self.way

    @property
    def rate(self) -> Any:
        """(c ṡ − s ċ)/(c² + s²)."""
        (s, s_dot), (c, c_dot) = (self._shadow(along) for along in (self.side, self.flat))
        return (c * s_dot - s * c_dot) / (c * c + s * s) * self.way

    def _shadow(self, along: Direction) -> tuple[Any, Any]:
        """The component of the pointer along a vector, and its rate."""
        p = self.pointer
        return p.u @ along.u, p.u_dot @ along.u + p.u @ along.u_dot

    def gradient(self, k: Kinematics) -> Vec:
        """n₂ × (n₁ × n₂)/|n₁ × n₂|²; of one turn n₂."""
        if self.alone:
            return self.last.u
        first, second = (self.first.u, self.last.u)[:: 1 if self.way > 0 else -1]
        normal = k.frame.cross(first, second)
        return k.frame.cross(second, normal) / (normal @ normal)


def pointed(s: Any, c: Any, near: Any) -> Any:
    """φ = 2 atan (s/(c + √(c² + s²))) [rad], and whole turns to `near`; it has a complex step."""
    size = (c * c + s * s) ** 0.5
    ahead = c.real >= 0.0  # of two forms the one that does not divide by little
    phi = 2 * np.arctan(s / (c + size)) if ahead else np.pi - 2 * np.arctan(s / (size - c))
    return phi + 2 * np.pi * np.round((near - phi).real / (2 * np.pi))


def turn_of(k: Kinematics, force: Turning) -> Turn:
    """The turn about which a force acts. Raises ValueError of one of three."""
    joint = k.scene.joints[force.about]
    a, b = k.part(joint.a.body), k.part(joint.b.body)
    if k.frame is PLANE:
        return PlanarTurn(a, b)
    number = joint.turning(force.turn) - len(joint.shifts)
    axes = [np.asarray(f.axis, float) for f in joint.turns]
    if len(axes) > 2:
        raise ValueError(f"{force.name}: about none of three turns can anything act")
    n = axes[number]
    w = axes[1 - number] if len(axes) == 2 else orthogonal_complement([joint.turns[0].axis])[0]
    c = float(n @ w)
    flat, own = w - c * n, 1 / (1 - c * c)
    holds, other = (a, b) if number == 0 else (b, a)
    counted = k.where.inner.get(counted_as(force))
    directions = [
        k.carried(part, x.tolist())
        for part, x in (
            (a, axes[0]),
            (b, axes[-1]),
            (holds, flat),
            (holds, np.cross(n, flat)),
            (other, w),
        )
    ]
    return SpatialTurn(
        a, b, *directions,
        weights=(own, -c * own) if number == 0 else (-c * own, own),
        way=1.0 if number == 0 else -1.0, alone=len(axes) == 1,
        k=k, near=None if counted is None else k.q[counted],
    )  # fmt: skip
