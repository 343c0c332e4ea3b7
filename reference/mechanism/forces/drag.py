"""Viscous friction (2.86), of a point and along a slide, with its dissipation D."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ....cases.scene import Scene
from ....cases.scene.forces.drag import Drag, Viscous
from ....cases.scene.forces.force import of
from ...laws.friction import power_law, viscous
from ..kinematics.coordinates import Coordinates, Point
from .directional_drag import one_way, power_loss, scrape_loss, scraped

NOISE = 1e-12  # of the speed at the start: what is left of one that falls to zero, or less

Numbers = Sequence[Any]
Pair = tuple[Any, Any]


def dragged(
    force: Drag, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    point = where.point(force.at, t, q, v)
    if force.along is not None:
        yield scraped(force, force.along, point), point
        return

    def F(v: Any) -> float:
        speed: float = np.sqrt(v @ v)
        return -power_law(force.coefficient, force.exponent, speed)

    yield viscous(F, point.r_dot).tolist(), point


def drag_loss(force: Drag, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> Any:
    """(2.46) D = d |v|^{α+1}/(α + 1) [W]."""
    point = where.point(force.at, t, q, v)
    if force.along is not None:
        return scrape_loss(force, force.along, point)
    x_dot, y_dot = point.r_dot
    return power_loss(force.coefficient, force.exponent, x_dot * x_dot + y_dot * y_dot)


def slowed(
    force: Viscous, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    a, b, u = _along(force, where, t, q, v)
    speed = _speed(a, b, u)
    size = power_law(one_way(force.coefficient, speed), force.exponent, speed)
    yield (size * u[0], size * u[1]), b
    yield (-size * u[0], -size * u[1]), a


def viscous_loss(force: Viscous, where: Coordinates, t: Any, q: Numbers, v: Numbers) -> Any:
    """(2.46) D = d |v|^{α+1}/(α + 1) [W], d that of the way it goes."""
    speed = _speed(*_along(force, where, t, q, v))
    return power_loss(one_way(force.coefficient, speed), force.exponent, speed * speed)


def _along(
    force: Viscous, where: Coordinates, t: Any, q: Numbers, v: Numbers
) -> tuple[Point, Point, Pair]:
    """The two points that the slide joins, and its direction in ground axes."""
    joint = where.scene.joints[force.joint]
    a, b = where.point(joint.a, t, q, v), where.point(joint.b, t, q, v)
    cos, sin, (x, y) = np.cos(a.angle), np.sin(a.angle), joint.along
    return a, b, (cos * x - sin * y, sin * x + cos * y)


def _speed(a: Point, b: Point, u: Pair) -> Any:
    """d/dt u·(r_B − r_A) = u·(ṙ_B − ṙ_A) [m/s]: r_B − r_A lies along u, and u̇ across it."""
    return u[0] * (b.r_dot[0] - a.r_dot[0]) + u[1] * (b.r_dot[1] - a.r_dot[1])


def blurred(scene: Scene, speed: float) -> float:
    """How long [s] slides take from NOISE to rest by (2.86): so well a stop is known, if α < 1.

    v^{1−α} = (1 − α) (d/m) (t_s − t), with the mass of all bodies.
    """
    m = sum(body.mass for body in scene.bodies.values())
    stops = [f for f in of(Viscous, scene.forces.values()) if f.exponent < 1.0]
    left = [
        (NOISE * speed) ** (1.0 - f.exponent) * m / (d * (1.0 - f.exponent))
        for f in stops
        for d in (f.coefficient.forward, f.coefficient.backward)
        if d
    ]
    return max(left, default=0.0)
