"""Vectors as triples of numbers, real or complex: numpy costs ten times as much on single ones.

A frame E is the triple of a body's axes E₁, E₂, E₃ in ground axes, as in (2.3): the rows of E.
"""

from typing import Any

from ...coverage import equation

Triple = tuple[Any, Any, Any]
Frame = tuple[Triple, Triple, Triple]

GROUND: Frame = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))
NIL: Triple = (0.0, 0.0, 0.0)


def cross(a: Triple, b: Triple) -> Triple:
    """a × b."""
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def dot(a: Triple, b: Triple) -> Any:
    """a · b, without conjugates."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def plus(a: Triple, b: Triple) -> Triple:
    """a + b."""
    return a[0] + b[0], a[1] + b[1], a[2] + b[2]


def minus(a: Triple, b: Triple) -> Triple:
    """a − b."""
    return a[0] - b[0], a[1] - b[1], a[2] - b[2]


def times(s: Any, a: Triple) -> Triple:
    """s a."""
    return s * a[0], s * a[1], s * a[2]


@equation
def grounded(E: Frame, x: Triple) -> Triple:
    """(2.1) x = x_i E_i in ground axes, of x_i in body axes."""
    return (
        x[0] * E[0][0] + x[1] * E[1][0] + x[2] * E[2][0],
        x[0] * E[0][1] + x[1] * E[1][1] + x[2] * E[2][1],
        x[0] * E[0][2] + x[1] * E[1][2] + x[2] * E[2][2],
    )


@equation
def embodied(E: Frame, x: Triple) -> Triple:
    """(2.1) x_i = E_i · x in body axes, of x in ground axes."""
    return dot(E[0], x), dot(E[1], x), dot(E[2], x)


@equation
def about(E: Frame, axis: int, cos: Any, sin: Any) -> Frame:
    """(2.3) E after a turn about its own axis 0, 1 or 2."""
    b, c = (axis + 1) % 3, (axis + 2) % 3
    turned = list(E)
    turned[b] = plus(times(cos, E[b]), times(sin, E[c]))
    turned[c] = minus(times(cos, E[c]), times(sin, E[b]))
    return turned[0], turned[1], turned[2]
