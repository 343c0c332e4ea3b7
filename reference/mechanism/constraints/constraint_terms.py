"""The terms that rows of constraints are sums of.

`Along`, `Turning`, `Line`, `Distance`, `Carried`, `Given`, and in `rims` `Apart` and `Around`.

Each is a rate, written in the coordinates as f_a q̇ᵃ − g (2.15); `assembled` adds them up.  The
first four are the rate of a `place`; what a blade holds, and what is prescribed, has none.  Terms
are linear in their direction or axis: its opposite makes a difference of two terms, a factor weighs
them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Protocol

from ....cases.scene import Signal, Vector
from ..kinematics.coordinates import Attached, Point, trigonometry

Ends = Sequence[Point]  # the points of one constraint; its terms name them by their place here
Direction = tuple[Any, Any]
G, GAMMA = -2, -1  # where g and γ stand in a row of n + 2 numbers
FIRST, SECOND = 0, 1  # the ends of a joint; a contact has one
X, Y = (1.0, 0.0), (0.0, 1.0)


class Assembly(Protocol):
    """Rows that terms are added to, each of the i-th at the points on their bodies."""

    def along(self, i: int, p: Attached, u: Vector) -> None: ...
    def turning(self, i: int, p: Attached, axis: float) -> None: ...
    def line(self, i: int, a: Attached, b: Attached, u: Vector) -> None: ...
    def between(self, i: int, a: Attached, b: Attached, way: "Way") -> None: ...
    def carried(self, i: int, p: Attached, u: Vector) -> None: ...
    def given(self, i: int, law: Signal) -> None: ...


class Way(Protocol):
    """A direction that turns with two points."""

    def numbers(self, a: Point, b: Point) -> tuple[Any, ...]:
        """(2.15) f of a and of b (x, y and φ of each), g, and γ."""
        ...


class Term(Protocol):
    """A rate of points of a constraint, named by their place there."""

    @property
    def angular(self) -> bool:
        """Whether it is a turn [rad/s], and no velocity [m/s]."""
        ...

    def place(self, ends: Ends) -> Any:
        """The place that the term is the rate of; TypeError where there is none."""
        ...

    def direction(self, ends: Ends) -> Direction:
        """The direction of the force that the term's multiplier is, in ground axes."""
        ...

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        ...


@dataclass(frozen=True)
class Along:
    """The velocity of a point along a direction fixed to the ground: u·ṙ_p [m/s]."""

    p: int
    u: Vector
    angular = False

    def place(self, ends: Ends) -> Any:
        """u·r_p [m]."""
        r = ends[self.p].r
        return self.u[0] * r[0] + self.u[1] * r[1]

    def direction(self, ends: Ends) -> Direction:
        """u, in ground axes."""
        return self.u

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.along(i, ends[self.p], self.u)


@dataclass(frozen=True)
class Turning:
    """The turn of a body about an axis, in the plane a number: ω times it [rad/s]."""

    p: int
    axis: float = 1.0  # about +z; with a radius R the term is the velocity R ω [m/s]
    angular = True

    def place(self, ends: Ends) -> Any:
        """φ times the axis [rad], or R φ [m]."""
        return self.axis * ends[self.p].angle

    def direction(self, ends: Ends) -> Direction:
        """A moment has no direction in the plane."""
        return 0.0, 0.0

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.turning(i, ends[self.p], self.axis)


@dataclass(frozen=True)
class Line:
    """The rate of the distance of b from a along u, u turning with a: d/dt u·Δ, Δ = r_b − r_a."""

    a: int
    b: int
    u: Vector  # in the axes of a
    angular = False

    def place(self, ends: Ends) -> Any:
        """u·Δ [m]."""
        a, b, u = ends[self.a].r, ends[self.b].r, self.direction(ends)
        return u[0] * (b[0] - a[0]) + u[1] * (b[1] - a[1])

    def direction(self, ends: Ends) -> Direction:
        """u = E_a u', in ground axes."""
        cos, sin = trigonometry(ends[self.a].angle)
        return cos * self.u[0] - sin * self.u[1], sin * self.u[0] + cos * self.u[1]

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.line(i, ends[self.a], ends[self.b], self.u)

    def numbers(self, a: Point, b: Point) -> tuple[Any, ...]:
        """(2.15) u·Δ̇ + u̇·Δ: f of a and of b (x, y and φ of each), g, and γ.

        They are f of b less that of a as `Along` u has it, (u, d × u), and u × Δ at φ_a, since
        u̇ = ω_a × u.  Differentiated again that is u·Δ̈ + 2 u̇·Δ̇ + ü·Δ, with u̇·Δ̇ = ω_a (u × Δ̇)
        and ü = ω̇_a × u − ω_a² u: γ has −2 ω_a (u × Δ̇) + ω_a² u·Δ beside the ω² u·d of `Along`.
        """
        x, y = self.direction((a, b))
        gap = b.r[0] - a.r[0], b.r[1] - a.r[1]
        gap_dot = b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1]
        f_a = a.d[1] * x - a.d[0] * y + x * gap[1] - y * gap[0]
        f_b = b.d[0] * y - b.d[1] * x
        g = 0.0 if b.xy is not None else -(x * b.r_dot[0] + y * b.r_dot[1])
        turning = a.omega * a.omega * (x * (gap[0] - a.d[0]) + y * (gap[1] - a.d[1]))
        gamma = turning - 2 * a.omega * (x * gap_dot[1] - y * gap_dot[0])
        return -x, -y, f_a, x, y, f_b, g, gamma + b.omega * b.omega * (x * b.d[0] + y * b.d[1])


@dataclass(frozen=True)
class Distance:
    """How fast b nears a: −d/dt λ of their distance λ = √(Δ·Δ), Δ = r_b − r_a.

    The force on b is then along −u, u = Δ/λ, and the multiplier pulls both together.
    """

    a: int
    b: int
    angular = False

    def place(self, ends: Ends) -> Any:
        """−λ [m]."""
        return -_length(*_apart(ends[self.a].r, ends[self.b].r))

    def direction(self, ends: Ends) -> Direction:
        """−u, in ground axes; any where there is none, of which only a guess can be."""
        x, y = _apart(ends[self.a].r, ends[self.b].r)
        length = _length(x, y)
        return (-x / length, -y / length) if length else (-1.0, 0.0)

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.between(i, ends[self.a], ends[self.b], self)

    def numbers(self, a: Point, b: Point) -> tuple[Any, ...]:
        """(2.15) w·Δ̇, w = −u: f of a and of b (x, y and φ of each), g, and γ.

        They are f of b less that of a as `Along` w has it.  Differentiated again that is
        w·Δ̈ + ẇ·Δ̇, with u̇·Δ̇ = (Δ̇² − (u·Δ̇)²)/λ: γ has that beside the ω² w·d of `Along`.
        """
        x, y = self.direction((a, b))
        rate = _apart(a.r_dot, b.r_dot)
        along, speed = x * rate[0] + y * rate[1], rate[0] * rate[0] + rate[1] * rate[1]
        length = _length(*_apart(a.r, b.r)) or 1.0
        g = (x * a.r_dot[0] + y * a.r_dot[1]) if a.xy is None else 0.0
        g = g - (x * b.r_dot[0] + y * b.r_dot[1]) if b.xy is None else g
        gamma = (speed - along * along) / length
        gamma = gamma + b.omega * b.omega * (x * b.d[0] + y * b.d[1])
        gamma = gamma - a.omega * a.omega * (x * a.d[0] + y * a.d[1])
        f_a, f_b = a.d[1] * x - a.d[0] * y, b.d[0] * y - b.d[1] * x
        return -x, -y, f_a, x, y, f_b, g, gamma


@dataclass(frozen=True)
class Carried:
    """The velocity of a point along a direction that its body carries: u·ṙ_p [m/s], u = E u'."""

    p: int
    u: Vector  # in the axes of the body
    angular = False

    def place(self, ends: Ends) -> Any:
        """(2.15) There is none. Raises TypeError."""
        raise TypeError("the velocity of a point along a blade is the rate of no place")

    def direction(self, ends: Ends) -> Direction:
        """u = E u', in ground axes."""
        cos, sin = trigonometry(ends[self.p].angle)
        return cos * self.u[0] - sin * self.u[1], sin * self.u[0] + cos * self.u[1]

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.carried(i, ends[self.p], self.u)


@dataclass(frozen=True)
class Given:
    """A prescribed velocity, with the opposite sign: −s(t) [m/s], or of a turn [rad/s]."""

    law: Signal
    angular: bool = False

    def place(self, ends: Ends) -> Any:
        """(2.15) There is none. Raises TypeError."""
        raise TypeError("a prescribed velocity holds no place")

    def direction(self, ends: Ends) -> Direction:
        """No force has its direction."""
        return 0.0, 0.0

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.given(i, self.law)


def opposite(u: Direction) -> Direction:
    """−u."""
    return -u[0], -u[1]


def _apart(a: Direction, b: Direction) -> Direction:
    return b[0] - a[0], b[1] - a[1]


def _length(x: Any, y: Any) -> Any:
    return (x * x + y * y) ** 0.5
