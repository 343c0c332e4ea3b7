"""The points at which a force by law acts, ahead of the step."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from pymunk.body import Body

from ....cases.scene import Anchor
from ...told import Place
from ..world import World

Seen = tuple[float, float, Place]
"""The lever of a force about the centre of mass, and the point."""


@dataclass(frozen=True)
class Point:
    """begun: where it is at the start. read: where it is in the middle of the step to come."""

    begun: Place
    read: Callable[[], Seen]


def at_midpoint(world: World, anchor: Anchor, step: float) -> Point:
    """Read after the drift, with the velocity extrapolated to 3/2 vₙ − 1/2 vₙ₋₁."""
    body, at = world.body(anchor), world.local(anchor)
    before = rates(body)  # there is no step before the first

    def read() -> Seen:
        nonlocal before
        was, before = before, rates(body)
        return ahead(body, at, step, 1.5, was)

    return Point(ahead(body, at, step / 2, 1.0, before)[2], read)


def rates(body: Body) -> tuple[float, float, float]:
    """vx, vy and omega."""
    vx, vy = body.velocity
    return vx, vy, body.angular_velocity


def ahead(
    body: Body,
    at: tuple[float, float],
    drift: float,
    share: float,
    was: tuple[float, float, float],
) -> Seen:
    """A point `drift` s ahead; of its velocity a share, and what is missing from that before."""
    (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
    angle, rest = body.angle + drift * omega, 1.0 - share
    cos, sin = math.cos(angle), math.sin(angle)
    rx, ry = cos * at[0] - sin * at[1], sin * at[0] + cos * at[1]
    u, w, turning = share * vx + rest * was[0], share * vy + rest * was[1], share * omega
    turning += rest * was[2]
    place = Place(
        x + drift * vx + rx, y + drift * vy + ry, u - turning * ry, w + turning * rx, angle
    )
    return rx, ry, place
