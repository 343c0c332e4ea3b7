"""Friction of a point along an edge of its body and across it (2.85), with its dissipation D."""

from typing import Any

import numpy as np

from ....cases.scene import Bounds, Vector
from ....cases.scene.forces.drag import Drag
from ...laws.friction import power_law
from ..kinematics.coordinates import Point

Pair = tuple[Any, Any]


def scraped(force: Drag, along: Vector, point: Point) -> Pair:
    """(2.85), (2.86) Σ −d_i |v_i|^α sign(v_i) e_i [N]."""
    (x, y), speeds = _resolved(along, point)
    pairs = zip(force.ways, speeds, strict=True)
    F, G = (power_law(one_way(d, speed), force.exponent, speed) for d, speed in pairs)
    return F * x - G * y, F * y + G * x


def scrape_loss(force: Drag, along: Vector, point: Point) -> Any:
    """(2.46) D = Σ d_i |v_i|^{α+1}/(α + 1) [W]."""
    _, speeds = _resolved(along, point)
    pairs = zip(force.ways, speeds, strict=True)
    return sum(power_loss(one_way(d, speed), force.exponent, speed * speed) for d, speed in pairs)


def _resolved(along: Vector, point: Point) -> tuple[Pair, Pair]:
    """The edge in ground axes, and the point's speeds [m/s] along it and to its left."""
    cos, sin, (a, b) = np.cos(point.angle), np.sin(point.angle), along
    x, y = cos * a - sin * b, sin * a + cos * b
    x_dot, y_dot = point.r_dot
    return (x, y), (x * x_dot + y * y_dot, x * y_dot - y * x_dot)


def one_way(d: Bounds, speed: Any) -> float:
    """d₊ or d₋, as it goes."""
    return d.forward if np.real(speed) > 0.0 else d.backward


def power_loss(d: float, alpha: float, square: Any) -> Any:
    """(2.46) d |v|^{α+1}/(α + 1) [W] of v²: a root needs no |v|, whose derivative would be lost.

    At rest it has no slope, which a complex step of less than 1 would only reach by its root.
    """
    if not np.real(square) > 0.0:
        return 0.0 * square
    return d * square ** ((alpha + 1.0) / 2.0) / (alpha + 1.0)
