"""Points and lines ahead of the step in which their forces act."""

import math
from collections.abc import Callable

from ....cases.force import Line
from ....cases.scene import GROUND, Anchor, Vector
from ...law import tension
from ..world import World

Point = tuple[Vector, float, float, float, float]
"""Lever from the centre of mass; x, y, vx, vy; all in ground axes."""
Load = tuple[float, float, float]
"""fx, fy [N] and torque [N m] about a body's centre of mass."""
Exerted = Callable[[float, float], Load]
"""At a time t [s], `drift` s from the present place. It is asked before every step."""


def drifting(world: World, anchor: Anchor) -> Callable[[float], Point]:
    """A point after so many seconds at the present velocities."""
    if anchor.body == GROUND and anchor.point not in world.driven:
        x, y = world.local(anchor)
        rests = (x, y), x, y, 0.0, 0.0
        return lambda drift: rests
    body, (a, b) = world.body(anchor), world.local(anchor)

    def centre(drift: float) -> Point:
        (x, y), (vx, vy) = body.position, body.velocity
        return (0.0, 0.0), x + drift * vx, y + drift * vy, vx, vy

    def point(drift: float) -> Point:
        (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
        angle = body.angle + drift * omega
        cos, sin = math.cos(angle), math.sin(angle)
        rx, ry = cos * a - sin * b, sin * a + cos * b
        return (rx, ry), x + drift * vx + rx, y + drift * vy + ry, vx - omega * ry, vy + omega * rx

    return point if a or b else centre  # turning does not move a centre, or a driven point


def pull(world: World, line: Line, name: str) -> Exerted:
    """What the line exerts on the body `name` at one of its ends."""
    ends = (line.a, line.b) if line.a.body == name else (line.b, line.a)
    here, there = (drifting(world, end) for end in ends)

    def exerted(t: float, drift: float) -> Load:
        (rx, ry), xa, ya, vxa, vya = here(drift)
        _, xb, yb, vxb, vyb = there(drift)
        px, py = _along(line, xb - xa, yb - ya, vxb - vxa, vyb - vya)
        return px, py, rx * py - ry * px

    return exerted


def told(world: World, line: Line, step: float) -> Callable[[float], None]:
    """The line's force at the midpoint, with the velocities extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints: their forces are in the velocities.
    """
    a, b = _midpoint(world, line.a, step), _midpoint(world, line.b, step)
    body_a = None if line.a.body == GROUND else world.bodies[line.a.body]
    body_b = None if line.b.body == GROUND else world.bodies[line.b.body]

    def apply(t: float) -> None:
        (lever_a, xa, ya, vxa, vya), (lever_b, xb, yb, vxb, vyb) = a(), b()
        px, py = _along(line, xb - xa, yb - ya, vxb - vxa, vyb - vya)
        if body_a:
            body_a.apply_force_at_world_point((px, py), body_a.position + lever_a)
        if body_b:
            body_b.apply_force_at_world_point((-px, -py), body_b.position + lever_b)

    return apply


def _along(line: Line, dx: float, dy: float, vx: float, vy: float) -> Vector:
    """How the line pulls its first end towards its second [N]."""
    length = math.hypot(dx, dy)
    if not length:
        return 0.0, 0.0  # no direction to act in
    size = tension(line, length, (dx * vx + dy * vy) / length) / length
    return size * dx, size * dy


def _midpoint(world: World, anchor: Anchor, step: float) -> Callable[[], Point]:
    """Reads a point after the drift, with its velocity extrapolated to the midpoint."""
    body, (a, b) = world.body(anchor), world.local(anchor)
    before = (*body.velocity, body.angular_velocity)  # there is no step before the first

    def read() -> Point:
        nonlocal before
        (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
        was_vx, was_vy, was_omega = before
        before = (vx, vy, omega)
        angle, turned = body.angle + step * omega, 1.5 * omega - 0.5 * was_omega
        cos, sin = math.cos(angle), math.sin(angle)
        rx, ry = cos * a - sin * b, sin * a + cos * b
        return (
            (rx, ry),
            x + step * vx + rx,
            y + step * vy + ry,
            1.5 * vx - 0.5 * was_vx - turned * ry,
            1.5 * vy - 0.5 * was_vy + turned * rx,
        )

    return read
