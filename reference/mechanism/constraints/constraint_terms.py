"""The terms that rows of constraints are sums of, in the plane and in space.

Each is a rate, written as f_a q̇ᵃ − g (2.15), and mostly that of a `place`; what a blade holds, what
goes around a rim and what is prescribed is the rate of none. Terms are linear in their direction
or axis: its opposite makes a difference of two terms, a factor weighs them.

Δ = r_b − r_a is what lies between two points, λ = √(Δ·Δ), and u = Δ/λ.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ....cases.scene import Signal
from ...coverage import Numbered
from ..kinematics import signal
from ..kinematics.frame import Vec
from ..kinematics.kinematics import Direction, Kinematics, Point, Row

Ends = Sequence[Point]  # the points of one constraint; its terms name them by their place here
Numbers = Sequence[float]
FIRST, SECOND = 0, 1  # the ends of a joint; a contact has one
X, Y = (1.0, 0.0), (0.0, 1.0)


class Term(Protocol):
    """A rate of points of a constraint, named by their place there."""

    @property
    def angular(self) -> bool:
        """Whether it is a turn [rad/s], and no velocity [m/s]."""
        ...

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) f_a, g and γ."""
        ...

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """The place that the term is the rate of; None where there is none."""
        ...

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """The direction of the force, or moment, that its multiplier is, in ground axes."""
        ...


@dataclass(frozen=True)
class Along(Numbered):
    """The velocity of a point along a direction fixed to the ground: u·ṙ_p [m/s]."""

    p: int
    u: Numbers
    angular = False

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) f = (u, d × u)."""
        return k.along(ends[self.p], k.fixed(self.u))

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """u·r_p [m]."""
        return Vec(self.u) @ ends[self.p].r

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return Vec(self.u)


@dataclass(frozen=True)
class Turning(Numbered):
    """The turn of a body of the plane, times a factor: that of ω [rad/s]."""

    p: int
    axis: float = 1.0  # about +z; with a radius R the term is the velocity R ω [m/s]
    angular = True

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) ω = φ̇; γ = 0."""
        return Row([(ends[self.p].part, None, Vec((self.axis,)))])

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """φ times the factor [rad], or R φ [m]."""
        return self.axis * ends[self.p].part.angle

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """A moment has no direction in the plane."""
        return Vec((0.0, 0.0))


@dataclass(frozen=True)
class Line(Numbered):
    """The rate of the distance of b from a along u, u turning with a: d/dt u·Δ [m/s]."""

    a: int
    b: int
    u: Numbers  # in the axes of a
    angular = False

    def _carried(self, k: Kinematics, ends: Ends) -> Direction:
        return k.carried(ends[self.a].part, self.u)

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) u·Δ̇ + ω_a·(u × Δ)."""
        return k.line(ends[self.a], ends[self.b], self._carried(k, ends))

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """u·Δ [m]."""
        return self._carried(k, ends).u @ (ends[self.b].r - ends[self.a].r)

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return self._carried(k, ends).u


@dataclass(frozen=True)
class Apart(Numbered):
    """How fast b parts from a: d/dt λ [m/s]; the multiplier pushes both apart."""

    a: int
    b: int
    angular = False

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) u·Δ̇, and u̇ = (Δ̇ − (u·Δ̇) u)/λ."""
        a, b = ends[self.a], ends[self.b]
        return k.line(a, b, _unit_vector(k, a, b))

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """λ [m]."""
        d = ends[self.b].r - ends[self.a].r
        return (d @ d) ** 0.5

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return _unit_vector(k, ends[self.a], ends[self.b]).u


@dataclass(frozen=True)
class Distance(Numbered):
    """How fast b nears a: −d/dt λ [m/s]; the multiplier pulls both together."""

    a: int
    b: int
    angular = False

    @property
    def _apart(self) -> Apart:
        return Apart(self.a, self.b)

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) −u·Δ̇."""
        return -self._apart.row(k, ends)

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """−λ [m]."""
        return -self._apart.place(k, ends)

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """−u."""
        return -self._apart.direction(k, ends)


@dataclass(frozen=True)
class Around(Numbered):
    """How fast b goes around a in the plane: w·Δ̇ [m/s], w with u to its left."""

    a: int
    b: int
    angular = False

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) w·Δ̇, and ẇ turns with u̇."""
        a, b = ends[self.a], ends[self.b]
        c = _unit_vector(k, a, b)
        return k.line(a, b, Direction(_right(c.u), _right(c.u_dot)))

    def place(self, k: Kinematics, ends: Ends) -> None:
        """None: unless λ stays, it is the rate of no place."""

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """w."""
        return _right(_unit_vector(k, ends[self.a], ends[self.b]).u)


@dataclass(frozen=True)
class Carried(Numbered):
    """The velocity of a point along a direction that its body carries: u·ṙ_p [m/s]."""

    p: int
    u: Numbers  # in the axes of the body
    angular = False

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) f = (u, d × u), d × u being the same in body axes at all times."""
        p = ends[self.p]
        return k.along(p, k.carried(p.part, self.u))

    def place(self, k: Kinematics, ends: Ends) -> None:
        """None: it is the rate of no place."""

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return k.carried(ends[self.p].part, self.u).u


@dataclass(frozen=True)
class Given(Numbered):
    """A prescribed velocity, with the opposite sign: −s(t) [m/s], or of a turn [rad/s]."""

    law: Signal
    angular: bool = False

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) g = s(t), and γ = ṡ(t)."""
        (size,) = self.law.amplitude
        slope = size * k.signal(self.law, signal.SLOPES)
        return Row([], size * k.signal(self.law), slope)

    def place(self, k: Kinematics, ends: Ends) -> None:
        """None: a prescribed velocity holds no place."""

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """No force has its direction."""
        return k.still


@dataclass(frozen=True)
class Dot(Numbered):
    """The rate of u·w, u fixed in a and w in b: (ω_b − ω_a)·(w × u) [rad/s], in space."""

    a: int
    b: int
    u: Numbers
    w: Numbers
    angular = True

    def _axes(self, k: Kinematics, ends: Ends) -> tuple[Direction, Direction]:
        a, b = ends[self.a].part, ends[self.b].part
        return k.carried(a, self.u), k.carried(b, self.w)

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) The moment w × u on b, and its rate by u̇ = ω_a × u and ẇ = ω_b × w."""
        u, w = self._axes(k, ends)
        cross = k.frame.cross
        m, m_dot = cross(w.u, u.u), cross(w.u_dot, u.u) + cross(w.u, u.u_dot)
        return k.turn(ends[self.a].part, ends[self.b].part, m, m_dot)

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """u·w."""
        u, w = self._axes(k, ends)
        return u.u @ w.u

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """w × u."""
        u, w = self._axes(k, ends)
        return k.frame.cross(w.u, u.u)


@dataclass(frozen=True)
class Turn(Numbered):
    """The rate of one turn of a joint in space, m·(ω_b − ω_a) [rad/s].

    Of two turns about n₁, fixed in a, and n₂, fixed in b, with n₁·n₂ = c, ω_rel = θ̇₁ n₁ + θ̇₂ n₂
    and m₁ = (n₁ − c n₂)/(1 − c²), m₂ = (n₂ − c n₁)/(1 − c²); of one m = n.
    """

    a: int
    b: int
    first: Numbers
    last: Numbers
    weights: tuple[float, float]  # of n₁ and n₂ in m
    angular = True

    def _axis(self, k: Kinematics, ends: Ends) -> tuple[Vec, Vec]:
        first = k.carried(ends[self.a].part, self.first)
        last = k.carried(ends[self.b].part, self.last)
        own, beside = self.weights
        return first.u * own + last.u * beside, first.u_dot * own + last.u_dot * beside

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) m·(ω_b − ω_a), and γ = −ṁ·(ω_b − ω_a)."""
        return k.turn(ends[self.a].part, ends[self.b].part, *self._axis(k, ends))

    def place(self, k: Kinematics, ends: Ends) -> None:
        """None: turns are told by the joint."""

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """m."""
        return self._axis(k, ends)[0]


@dataclass(frozen=True)
class Lowest(Numbered):
    """The velocity of the lowest point of a rim or a sphere along a direction of the ground.

    ρ = −R (z − (z·n) n)/√(1 − (z·n)²) from the centre (2.19), n the axle; of a sphere ρ = −R z.
    """

    p: int
    radius: float
    axle: Numbers | None  # None: a sphere
    u: Numbers
    angular = False

    def _point(self, k: Kinematics, ends: Ends) -> Point:
        part, z = ends[self.p].part, k.frame.axes[-1]
        if self.axle is None:
            return k.armed(part, z * -self.radius, k.still)
        c = k.carried(part, self.axle)
        n, n_dot, s, s_dot = c.u, c.u_dot, c.u @ z, c.u_dot @ z
        each = k.tape.call(slanted, 1.0 - s * s)  # 1/√(1 − s²)
        steep = (z - n * s) * each
        steep_dot = -(n * s_dot + n_dot * s) * each + steep * (s * s_dot * each * each)
        return k.armed(part, steep * -self.radius, steep_dot * -self.radius)

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.19) u·(ṙ_c + ω × ρ); its rate has ω × ρ̇ beside accelerations."""
        return k.along(self._point(k, ends), k.fixed(self.u))

    def place(self, k: Kinematics, ends: Ends) -> Any:
        """u·(r_c + ρ) [m]: along the floor the rate is not that of it."""
        return Vec(self.u) @ self._point(k, ends).r

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return Vec(self.u)


@dataclass(frozen=True)
class Heading(Numbered):
    """The velocity of a point to the left of a blade's heading [m/s], in space.

    The heading h is the shadow of the long axis along z: u = (−h_y, h_x, 0)/|h|, and so
    u̇ = −ψ̇ (h_x, h_y, 0)/|h| with ψ̇ = (h_x ḣ_y − h_y ḣ_x)/|h|².
    """

    p: int
    along: Numbers  # the long axis, in the axes of the body
    angular = False

    def _left(self, k: Kinematics, ends: Ends) -> Direction:
        h = k.carried(ends[self.p].part, self.along)
        (x, y, _), (x_dot, y_dot, _) = h.u, h.u_dot
        each = k.tape.call(slanted, x * x + y * y)  # 1/|h|
        x, y, turning = x * each, y * each, (x * y_dot - y * x_dot) * each * each
        return Direction(Vec((-y, x, 0.0)), Vec((-(turning * x), -(turning * y), 0.0)))

    def row(self, k: Kinematics, ends: Ends) -> Row:
        """(2.15) u·ṙ_P."""
        return k.along(ends[self.p], self._left(k, ends))

    def place(self, k: Kinematics, ends: Ends) -> None:
        """None: it is the rate of no place."""

    def direction(self, k: Kinematics, ends: Ends) -> Vec:
        """u."""
        return self._left(k, ends).u


def opposite(u: Numbers) -> Numbers:
    """−u."""
    return tuple(-x for x in u)


def _unit_vector(k: Kinematics, a: Point, b: Point) -> Direction:
    """u, with its rate (Δ̇ − (u·Δ̇) u)/λ."""
    d, d_dot = b.r - a.r, b.r_dot - a.r_dot
    squared = d @ d
    each = k.tape.call(per, squared)
    u = Vec((k.tape.call(ahead, d[0], squared), *(x * each for x in d[1:])))
    return Direction(u, (d_dot - u * (u @ d_dot)) * each)


def per(squared: Any) -> Any:
    """1/λ of λ²; 0 where two points are one, as only those of a guess can be."""
    return 1.0 / squared**0.5 if squared != 0.0 else 0.0


def slanted(squared: Any) -> Any:
    """1/√x; nan where x is 0: a rim that lies flat has no lowest point, a mast no heading."""
    return 1.0 / squared**0.5 if squared.real > 0.0 else math.nan


def ahead(x: Any, squared: Any) -> Any:
    """x/λ; where two points are one, any direction: this one."""
    return x / squared**0.5 if squared != 0.0 else 1.0


def _right(u: Vec) -> Vec:
    return Vec((u[1], -u[0]))
