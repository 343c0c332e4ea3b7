"""All that acts on a body but friction and constraints, ahead of the step in which it acts.

A dry friction law has to know it before the step; pymunk tells no force, so it is summed here.
Only for bodies that turn with nothing else: what joints pass on is not in the sum.
"""

import math
from collections.abc import Callable

from ....cases.scene import Anchor, Damper, Push, Spring, Torque
from ...law import tension, value
from ..scene import World

Load = Callable[[float, float], tuple[float, float, float]]
"""(t, ahead) → fx, fy [N] and torque [N m] about the centre of mass, at the time t + ahead [s];
called between steps at the time t."""


def load(world: World, name: str, step: float) -> Load:
    """The load on the body `name`; positions are those of the midpoint protocol, h/2 behind."""
    scene, body = world.scene, world.bodies[name]
    signals = [s for s in scene.signals() if _acts(s, name)]
    lines = [f for f in (*scene.springs(), *scene.dampers()) if name in (f.a.body, f.b.body)]
    gx, gy = world.space.gravity

    def acting(t: float, ahead: float) -> tuple[float, float, float]:
        drift = ahead + step / 2
        fx, fy, torque = body.mass * gx, body.mass * gy, 0.0
        for signal in signals:
            now = value(signal.signal, t + ahead)
            if isinstance(signal, Torque):
                torque += now[0]
                continue
            rx, ry, *_ = _point(world, signal.at, drift)
            fx, fy, torque = fx + now[0], fy + now[1], torque + rx * now[1] - ry * now[0]
        for line in lines:
            here, there = (line.a, line.b) if line.a.body == name else (line.b, line.a)
            rx, ry, px, py = _pull(world, line, here, there, drift)
            fx, fy, torque = fx + px, fy + py, torque + rx * py - ry * px
        return fx, fy, torque

    return acting


def _acts(signal: Push | Torque, name: str) -> bool:
    return name == (signal.body if isinstance(signal, Torque) else signal.at.body)


def _point(
    world: World, anchor: Anchor, drift: float
) -> tuple[float, float, float, float, float, float]:
    """Lever from the centre; x, y, vx, vy after `drift` seconds at the present velocities."""
    body, (a, b) = world.body(anchor), world.local(anchor)
    (x, y), (vx, vy), omega = body.position, body.velocity, body.angular_velocity
    angle = body.angle + drift * omega
    cos, sin = math.cos(angle), math.sin(angle)
    rx, ry = cos * a - sin * b, sin * a + cos * b
    return rx, ry, x + drift * vx + rx, y + drift * vy + ry, vx - omega * ry, vy + omega * rx


def _pull(
    world: World, line: Spring | Damper, here: Anchor, there: Anchor, drift: float
) -> tuple[float, float, float, float]:
    """The lever on this body, and how the line pulls it towards its other end [N]."""
    rx, ry, xa, ya, vxa, vya = _point(world, here, drift)
    _, _, xb, yb, vxb, vyb = _point(world, there, drift)
    dx, dy = xb - xa, yb - ya
    length = math.hypot(dx, dy)
    if not length:
        return rx, ry, 0.0, 0.0  # no direction to act in
    pull = tension(line, length, (dx * (vxb - vxa) + dy * (vyb - vya)) / length) / length
    return rx, ry, pull * dx, pull * dy
