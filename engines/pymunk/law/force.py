"""Forces pymunk has no element for, given before every step through its force input.

pymunk drifts first, so a force set before a step acts at positions one drift later. `midpoint`
evaluates it there, and half a step later in time; else it is what a user writes who does not
know: the force at the present time and place.
"""

import math
from collections.abc import Callable

from ....cases.scene import GROUND, Anchor, Damper, Push, Torque, Vector
from ...law import tension, value
from ..contact import follower
from ..scene import World
from .friction import rubs

Apply = Callable[[float], None]  # at time t [s]
Point = tuple[Vector, float, float, float, float]  # lever from the centre; x, y, vx, vy


def forces(world: World, step: float, *, midpoint: bool, law: bool) -> list[Apply]:
    """What has to be called before each step; law: whether dampers and friction are ours."""
    drift = step if midpoint else 0.0
    applied: list[Apply] = []
    for force in world.scene.signals():
        if isinstance(force, Torque):
            applied.append(_torque(world, force, drift / 2))
        else:
            applied.append(_push(world, force, drift))
    if law:
        applied += [_damper(world, force, step) for force in world.scene.dampers()]
        applied += rubs(world, step)
    return applied + _followers(world, step)


def _followers(world: World, step: float) -> list[Apply]:
    scene = world.scene
    contacts = scene.contacts.values()
    found = [follower(c, scene.bodies[c.body], world.wheels[c.name], step) for c in contacts]
    return [follow for follow in found if follow]


def _torque(world: World, force: Torque, ahead: float) -> Apply:
    body = world.bodies[force.body]

    def apply(t: float) -> None:
        body.torque += value(force.signal, t + ahead)[0]

    return apply


def _push(world: World, force: Push, drift: float) -> Apply:
    body, (a, b) = world.body(force.at), world.local(force.at)

    def apply(t: float) -> None:
        angle = body.angle + drift * body.angular_velocity
        cos, sin = math.cos(angle), math.sin(angle)
        lever = (cos * a - sin * b, sin * a + cos * b)
        f = value(force.signal, t + drift / 2)
        body.apply_force_at_world_point((f[0], f[1]), body.position + lever)

    return apply


def _damper(world: World, force: Damper, step: float) -> Apply:
    """F = −d λ̇ at the midpoint, with the velocities extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints: their forces are in the velocities.
    """
    a, b = _point(world, force.a, step), _point(world, force.b, step)
    body_a = None if force.a.body == GROUND else world.bodies[force.a.body]
    body_b = None if force.b.body == GROUND else world.bodies[force.b.body]

    def apply(t: float) -> None:
        (lever_a, xa, ya, vxa, vya), (lever_b, xb, yb, vxb, vyb) = a(), b()
        dx, dy = xb - xa, yb - ya
        length = math.hypot(dx, dy)
        if not length:
            return  # no direction to act in
        pull = tension(force, length, (dx * (vxb - vxa) + dy * (vyb - vya)) / length) / length
        if body_a:
            body_a.apply_force_at_world_point((pull * dx, pull * dy), body_a.position + lever_a)
        if body_b:
            body_b.apply_force_at_world_point((-pull * dx, -pull * dy), body_b.position + lever_b)

    return apply


def _point(world: World, anchor: Anchor, step: float) -> Callable[[], Point]:
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
