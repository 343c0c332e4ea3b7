"""Points and lines ahead of the step in which their forces act."""

import math
from collections.abc import Callable
from functools import partial

from ....cases.scene import GROUND, Anchor, Vector
from ....cases.scene.forces.force import Line
from ...law import TENSIONS
from ..model.chipmunk_state import State, pushing, reading
from ..model.world import World

Point = tuple[Vector, float, float, float, float]
"""Lever from the centre of mass; x, y, vx, vy; all in ground axes."""
Load = tuple[float, float, float]
"""fx, fy [N] and torque [N m] about a body's centre of mass."""
Exerted = Callable[[float, float, State], Load]
"""At a time t [s], `drift` s from the present state of the body. It is asked before every step."""
Tension = Callable[[float, float], float]
"""Of a line [N], by its length and how fast that grows."""


def drifting(world: World, anchor: Anchor) -> Callable[[float], Point]:
    """A point after so many seconds at the present velocities."""
    if _rests(world, anchor):
        x, y = world.local(anchor)
        rests = (x, y), x, y, 0.0, 0.0
        return lambda drift: rests
    read, point = reading(world.body(anchor)), drifted(*world.local(anchor))
    return lambda drift: point(read(), drift)


def drifted(a: float, b: float) -> Callable[[State, float], Point]:
    """A point of a body, in its axes, so many seconds after the body has had a state."""

    def centre(state: State, drift: float) -> Point:
        x, y, _, vx, vy, _ = state
        return (0.0, 0.0), x + drift * vx, y + drift * vy, vx, vy

    def point(state: State, drift: float) -> Point:
        x, y, angle, vx, vy, omega = state
        angle += drift * omega
        cos, sin = math.cos(angle), math.sin(angle)
        rx, ry = cos * a - sin * b, sin * a + cos * b
        return (rx, ry), x + drift * vx + rx, y + drift * vy + ry, vx - omega * ry, vy + omega * rx

    return point if a or b else centre  # turning does not move a centre, or a driven point


def _rests(world: World, anchor: Anchor) -> bool:
    return anchor.body == GROUND and anchor.point not in world.driven


def pull(world: World, line: Line, name: str) -> Exerted:
    """The load of the line on the body `name` at one of its ends."""
    near, far = (line.a, line.b) if line.a.body == name else (line.b, line.a)
    here, there = drifted(*world.local(near)), drifting(world, far)
    pulls = partial(TENSIONS[type(line)], line)

    def exerted(t: float, drift: float, state: State) -> Load:
        (rx, ry), xa, ya, vxa, vya = here(state, drift)
        _, xb, yb, vxb, vyb = there(drift)
        px, py = _along(pulls, xb - xa, yb - ya, vxb - vxa, vyb - vya)
        return px, py, rx * py - ry * px

    return exerted


def midpoint_force(world: World, line: Line, step: float) -> Callable[[float], None]:
    """The line's force at the midpoint, with the velocities extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints: their forces are in the velocities.
    """
    a, b = _midpoint(world, line.a, step), _midpoint(world, line.b, step)
    push_a, push_b = (
        None if end.body == GROUND else pushing(world.bodies[end.body]) for end in (line.a, line.b)
    )
    pulls = partial(TENSIONS[type(line)], line)

    def apply(t: float) -> None:
        (at_a, xa, ya, vxa, vya), (at_b, xb, yb, vxb, vyb) = a(), b()
        px, py = _along(pulls, xb - xa, yb - ya, vxb - vxa, vyb - vya)
        if push_a:
            push_a((px, py), at_a)
        if push_b:
            push_b((-px, -py), at_b)

    return apply


def _along(pulls: Tension, dx: float, dy: float, vx: float, vy: float) -> Vector:
    """How the line pulls its first end towards its second [N]."""
    length = math.hypot(dx, dy)
    if length:
        size = pulls(length, (dx * vx + dy * vy) / length) / length
        return size * dx, size * dy
    if speed := math.hypot(vx, vy):  # the ends meet, and part along their velocity
        size = pulls(0.0, speed) / speed
        return size * vx, size * vy
    return 0.0, 0.0  # no direction to act in


def _midpoint(world: World, anchor: Anchor, step: float) -> Callable[[], Point]:
    """Reads a point after the drift, with its velocity extrapolated to the midpoint.

    In place of its lever where pymunk is told that the force acts: with it from the present centre.
    """
    if _rests(world, anchor):
        rests = drifting(world, anchor)(0.0)
        return lambda: rests
    read, (a, b) = reading(world.body(anchor)), world.local(anchor)
    *_, was_vx, was_vy, was_omega = read()  # there is no step before the first

    def ahead() -> Point:
        nonlocal was_vx, was_vy, was_omega
        x, y, angle, vx, vy, omega = read()
        angle += step * omega
        turned = 1.5 * omega - 0.5 * was_omega
        cos, sin = math.cos(angle), math.sin(angle)
        rx, ry = cos * a - sin * b, sin * a + cos * b
        u, w = 1.5 * vx - 0.5 * was_vx - turned * ry, 1.5 * vy - 0.5 * was_vy + turned * rx
        was_vx, was_vy, was_omega = vx, vy, omega
        return (x + rx, y + ry), x + step * vx + rx, y + step * vy + ry, u, w

    return ahead
