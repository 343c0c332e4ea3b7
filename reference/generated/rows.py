"""The three terms that rows of constraints are sums of: `Along`, `Turning` and `Line`.

Each is the rate of a `place`, written in the coordinates as f_a q̇ᵃ − g (2.15). A term adds to a row
of n + 2 numbers: f_a, then g, then the γ of f_a q̈ᵃ = γ. Terms are linear in their direction or
axis: its opposite makes a difference of two terms, a factor weighs them.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ...cases.scene import Vector
from .coordinates import Point, trigonometry

Ends = Sequence[Point]  # the points of one constraint; its terms name them by their place here
Direction = tuple[Any, Any]
G, GAMMA = -2, -1  # where g and γ stand in a row
FIRST, SECOND = 0, 1  # the ends of a joint; a contact has one
X, Y = (1.0, 0.0), (0.0, 1.0)


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

    def add(self, ends: Ends, row: list[Any]) -> None:
        """(2.15) u·ṙ_p with ṙ_p = ṙ_c + ω × d: f = (u, d × u); of a ground point g = −u·ṙ_p.

        Differentiated by (2.7), u·r̈_p = f_a q̈ᵃ + u·(ω × ḋ) with ḋ = ω × d: γ = ω² u·d.
        """
        _add(ends[self.p], self.u, row)


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

    def add(self, ends: Ends, row: list[Any]) -> None:
        """(2.15) ω = φ̇: f = the axis, at φ; γ = 0; what has no angle does not turn."""
        phi = ends[self.p].phi
        if phi is not None:
            row[phi] += self.axis


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

    def add(self, ends: Ends, row: list[Any]) -> None:
        """(2.15) u·Δ̇ + u̇·Δ: f of b less that of a as `Along` u, and u × Δ at φ_a: u̇ = ω_a × u.

        Differentiated again that is u·Δ̈ + 2 u̇·Δ̇ + ü·Δ, with u̇·Δ̇ = ω_a (u × Δ̇) and
        ü = ω̇_a × u − ω_a² u: γ has −2 ω_a (u × Δ̇) + ω_a² u·Δ beside what a and b have by `Along`.
        """
        a, b, u = ends[self.a], ends[self.b], self.direction(ends)
        _add(b, u, row)
        _add(a, opposite(u), row)
        if a.phi is None:
            return
        x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
        x_dot, y_dot = b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1]
        row[a.phi] += u[0] * y - u[1] * x
        row[GAMMA] -= 2 * a.omega * (u[0] * y_dot - u[1] * x_dot)
        row[GAMMA] += a.omega * a.omega * (u[0] * x + u[1] * y)


Term = Along | Turning | Line


def opposite(u: Direction) -> Direction:
    """−u."""
    return -u[0], -u[1]


def _add(p: Point, u: Direction, row: list[Any]) -> None:
    """u·ṙ_p, u held for the moment: the derivation is that of `Along`."""
    (x, y), (_, r_dot, (dx, dy), omega, _, xy, phi) = u, p
    if xy is None:
        row[G] -= x * r_dot[0] + y * r_dot[1]
        return
    row[xy] += x
    row[xy + 1] += y
    if phi is not None:
        row[phi] += dx * y - dy * x
        row[GAMMA] += omega * omega * (x * dx + y * dy)
