"""Vectors and lengths that move with bodies, with their two derivatives and their rows.

With the rates u of all bodies, each knows its value, its rate, the row (or rows) J with
rate = J u + what moves by itself, and b with second derivative = J u̇ + b.
"""

from typing import Any, NamedTuple, TypeAlias

import numpy as np

Array: TypeAlias = Any


def cross(a: Array, b: Array) -> Array:
    """a × b, which numpy's own does ten times slower."""
    return np.array(
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    )


def skew(a: Array) -> Array:
    """The matrix of a × ."""
    return np.array([[0.0, -a[2], a[1]], [a[2], 0.0, -a[0]], [-a[1], a[0], 0.0]])


class Vector(NamedTuple):
    """A vector in ground axes: p, its rate v, its rows J (3, n) and b."""

    p: Array
    v: Array
    J: Array
    b: Array

    def minus(self, other: "Vector") -> "Vector":
        """The difference of two."""
        return Vector(self.p - other.p, self.v - other.v, self.J - other.J, self.b - other.b)

    def plus(self, other: "Vector") -> "Vector":
        """The sum of two."""
        return Vector(self.p + other.p, self.v + other.v, self.J + other.J, self.b + other.b)


class Length(NamedTuple):
    """A number: p, its rate v, its row J (n,) and b."""

    p: float
    v: float
    J: Array
    b: float


def dot(x: Vector, y: Vector) -> Length:
    """x · y."""
    return Length(
        float(x.p @ y.p),
        float(x.v @ y.p + x.p @ y.v),
        y.p @ x.J + x.p @ y.J,
        float(x.p @ y.b + y.p @ x.b + 2 * (x.v @ y.v)),
    )


def size(x: Vector) -> Length:
    """|x|: from l l̈ + l̇² = ẋ² + x·ẍ."""
    l = float(np.sqrt(x.p @ x.p))
    if l == 0.0:  # no direction, as of a guess in which two points coincide
        return Length(0.0, 0.0, 0 * x.J[0], 0.0)
    e = x.p / l
    rate = float(e @ x.v)
    return Length(l, rate, e @ x.J, float((x.v @ x.v - rate**2 + x.p @ x.b) / l))


def unit(x: Vector) -> Vector:
    """x / |x|."""
    l = size(x)
    e, de = x.p / l.p, (x.v - x.p * l.v / l.p) / l.p
    J = (x.J - np.outer(e, l.J)) / l.p
    return Vector(e, de, J, (x.b - e * l.b - 2 * de * l.v) / l.p)


def across(x: Vector, y: Vector) -> Vector:
    """x × y."""
    return Vector(
        cross(x.p, y.p),
        cross(x.v, y.p) + cross(x.p, y.v),
        skew(x.p) @ y.J - skew(y.p) @ x.J,
        cross(x.b, y.p) + cross(x.p, y.b) + 2 * cross(x.v, y.v),
    )


def along(d: Vector, x: Vector) -> Length:
    """The component of the velocity of x along d, as a rate that nothing integrates: p is left 0.

    Its own rate of change is d·ẍ + ḋ·ẋ, so that b belongs to the velocity and not to a place.
    """
    return Length(0.0, float(d.p @ x.v), d.p @ x.J, float(d.p @ x.b + d.v @ x.v))


def fixed(p: Any, n: int) -> Vector:
    """A vector that does not move."""
    return Vector(np.asarray(p, dtype=float), np.zeros(3), np.zeros((3, n)), np.zeros(3))
