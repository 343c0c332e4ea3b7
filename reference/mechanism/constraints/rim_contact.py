"""Terms of two rims: how fast their centres part, and how fast one goes around the other.

Δ = r_b − r_a from one centre to the other, λ = √(Δ·Δ), u = Δ/λ, and w with u to its left.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from ..kinematics.coordinates import Attached, Point
from .constraint_terms import Assembly, Direction, Ends


@dataclass(frozen=True)
class Apart:
    """How fast b parts from a: d/dt λ; the multiplier pushes both apart."""

    a: int
    b: int
    angular = False

    def place(self, ends: Ends) -> Any:
        """λ [m]."""
        return _line(ends[self.a].r, ends[self.b].r)[0]

    def direction(self, ends: Ends) -> Direction:
        """u, in ground axes."""
        return _line(ends[self.a].r, ends[self.b].r)[1]

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.between(i, ends[self.a], ends[self.b], self)

    def numbers(self, a: Point, b: Point) -> tuple[Any, ...]:
        """(2.15) u·Δ̇: f of a and of b (x, y and φ of each), g, and γ.

        Differentiated again that is u·Δ̈ + u̇·Δ̇, and u̇·Δ̇ = (w·Δ̇)²/λ.
        """
        length, (x, y), _, around = _moves(a, b)
        return -x, -y, 0.0, x, y, 0.0, 0.0, -around * around / length


@dataclass(frozen=True)
class Around:
    """How fast b goes around a: w·Δ̇ [m/s]; it is the rate of no place, unless λ stays."""

    a: int
    b: int
    angular = False

    def place(self, ends: Ends) -> Any:
        """(2.15) There is none. Raises TypeError."""
        raise TypeError("the velocity across the line of two centres is the rate of no place")

    def direction(self, ends: Ends) -> Direction:
        """w, in ground axes."""
        _, (x, y) = _line(ends[self.a].r, ends[self.b].r)
        return y, -x

    def enter(self, i: int, ends: Sequence[Attached], rows: Assembly) -> None:
        """Adds it to the i-th row."""
        rows.between(i, ends[self.a], ends[self.b], self)

    def numbers(self, a: Point, b: Point) -> tuple[Any, ...]:
        """(2.15) w·Δ̇: f of a and of b (x, y and φ of each), g, and γ.

        Differentiated again that is w·Δ̈ + ẇ·Δ̇, and ẇ·Δ̇ = −(w·Δ̇)(u·Δ̇)/λ.
        """
        length, (x, y), parting, around = _moves(a, b)
        return -y, x, 0.0, y, -x, 0.0, 0.0, around * parting / length


def _line(a: Direction, b: Direction) -> tuple[Any, Direction]:
    """λ and u."""
    x, y = b[0] - a[0], b[1] - a[1]
    length = (x * x + y * y) ** 0.5
    return length, (x / length, y / length)


def _moves(a: Point, b: Point) -> tuple[Any, Direction, Any, Any]:
    """λ, u, u·Δ̇ and w·Δ̇."""
    length, (x, y) = _line(a.r, b.r)
    rate = b.r_dot[0] - a.r_dot[0], b.r_dot[1] - a.r_dot[1]
    return length, (x, y), x * rate[0] + y * rate[1], y * rate[0] - x * rate[1]
