"""Forces that pymunk has no element for: by their laws, at the points where they act."""

import math
from collections.abc import Callable
from typing import Any

from pymunk.body import Body

from ....cases.scene import GROUND, Anchor, Force
from ...told import Place, law_of
from ..world import World
from .line import Exerted, Load

_Read = Callable[[], tuple[float, float, Place]]
"""The lever of the force about the centre of mass, and the point in the middle of the step."""


def told_at_points(world: World, force: Force, step: float) -> Callable[[float], None]:
    """The force at the midpoint, with the velocities extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints, as that of a line is.
    """
    law = law_of(world.scene, force)
    points = [
        (None if at.body == GROUND else world.bodies[at.body], _midpoint(world, at, step))
        for at in world.scene.ends(force)
    ]

    def apply(t: float) -> None:
        seen = [read() for _, read in points]
        pushes = law(t + step / 2, [place for _, _, place in seen])
        for (body, _), (rx, ry, _), push in zip(points, seen, pushes, strict=True):
            if body:
                x, y = body.position
                body.apply_force_at_world_point(push, (x + rx, y + ry))

    return apply


def exerted_at_points(world: World, force: Force, name: str) -> Exerted:
    """What it exerts on the body `name`, `drift` s ahead at the present velocities."""
    law, ends = law_of(world.scene, force), world.scene.ends(force)
    looks = [(world.body(at), world.local(at)) for at in ends]

    def exerted(t: float, drift: float) -> Load:
        seen = [_at(*look, drift, 1.0, _rates(look[0])) for look in looks]
        pushes = law(t, [place for _, _, place in seen])
        fx = fy = torque = 0.0
        for at, (rx, ry, _), (px, py) in zip(ends, seen, pushes, strict=True):
            if at.body == name:
                fx, fy, torque = fx + px, fy + py, torque + rx * py - ry * px
        return fx, fy, torque

    return exerted


def _midpoint(world: World, anchor: Anchor, step: float) -> _Read:
    """Reads a point after the drift, with its velocity extrapolated to the midpoint."""
    body, at = world.body(anchor), world.local(anchor)
    before = _rates(body)  # there is no step before the first

    def read() -> tuple[float, float, Place]:
        nonlocal before
        was, before = before, _rates(body)
        return _at(body, at, step, 1.5, was)

    return read


def _rates(body: Body) -> tuple[float, float, float]:
    vx, vy = body.velocity
    return vx, vy, body.angular_velocity


def _at(
    body: Body,
    at: tuple[float, float],
    drift: float,
    share: float,
    was: tuple[float, float, float],
) -> tuple[float, float, Place]:
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


BY_LAW: dict[str, Any] = {
    "load": exerted_at_points,
    "tell": lambda world, force, step, drift: told_at_points(world, force, step),
}
"""What an `Element` is that is only told, at the points where it acts."""
