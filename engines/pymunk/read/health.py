"""Whether what pymunk has computed is a motion at all, before anybody compares it.

Once the sweeps of a step have converged, every joint's two points move so that the step's share of
their gap is closed. What is missing is the error of the sweeps, in m/s.
"""

import math
from collections.abc import Iterator

import numpy as np
from pymunk.body import Body
from pymunk.constraints import GrooveJoint, PinJoint, PivotJoint

from ....cases.trajectory import Array
from ...engine import Diverged
from ..model.slot import line
from ..model.solver_contraction import halving
from ..model.world import World
from ..stepping.scene import reach


class Left(Diverged):
    """A body is where neither a plane nor a groove goes on, which in the scene they do."""


def sound(world: World, rows: Array, times: Array, step: float) -> None:
    """Raises Diverged for pymunk's samples (N, bodies, 6) that are no motion, with the cause.

    times: of the positions. Sweeps that are too few come first: they make a body leave its floor,
    and numbers infinite.
    """
    finite = np.isfinite(rows).all(axis=(1, 2))
    _held(world, rows[finite], times[finite], step)
    if not finite.all():
        raise Diverged(f"pymunk: not finite any more at t = {times[np.argmin(finite)]:g} s")
    for what, end, way, speed in _ways(world, rows):
        limit = f"{what}, of which our adapter builds {end:g} m to each side"
        far = np.abs(way) > end
        # A groove's end may throw a body back before any sample sees it beyond.
        met = np.abs(way[:-1] + np.diff(times) * speed[:-1]) > end
        for where, does in ((far, "left"), (met, "came to the end of")):
            if where.any():
                at = times[np.argmax(where)]
                raise Left(f"pymunk: a body {does} {limit}, at t = {at:g} s")


def _ways(world: World, rows: Array) -> Iterator[tuple[str, float, Array, Array]]:
    """The planes and grooves along which bodies move, for each of them ends somewhere.

    Of each its name, its reach [m], where along it a body is and how fast (N,).
    """
    states = np.moveaxis(rows[:, :, [0, 1, 3, 4]], 1, 0).reshape(-1, len(rows), 2, 2)
    by_body = dict(zip(world.bodies, states, strict=True))
    still = np.zeros((len(rows), 2, 2))
    for contact in world.scene.contacts.values():
        plane = contact.plane
        place, velocity = np.moveaxis(by_body[contact.body], 1, 0)
        way, speed = (place - plane.at) @ plane.along, velocity @ plane.along
        yield f"{contact.name}'s {plane.name}", world.reach, way, speed
    for joint in world.scene.joints.values():
        if joint.shifts:
            apart = by_body.get(joint.b.body, still) - by_body.get(joint.a.body, still)
            place, velocity = np.moveaxis(apart, 1, 0)
            way, speed = np.linalg.norm(place, axis=1), np.linalg.norm(velocity, axis=1)
            away = np.sum(place * velocity, axis=1)
            np.divide(away, way, out=speed, where=way > 0)  # from the middle it only goes away
            yield f"{joint.name}'s groove", reach(world, joint), way, speed


def _held(world: World, rows: Array, times: Array, step: float) -> None:
    """Compares what the sweeps leave with what a step changes. After an impact they may leave as
    much; they are blamed if by their number no motion was stable.
    """
    if len(rows) < 2 or not world.joints:
        return
    lately = np.linalg.norm(np.diff(rows[:, :, 3:5], axis=0), axis=2) / np.diff(times)[:, None]
    rates = np.append(0.0, np.max(lately, axis=1))
    change = step * np.maximum(rates, math.hypot(*world.space.gravity))
    worst = np.max([np.zeros(len(rows)), *_left(world, rows, times, step)], axis=0)
    torn = worst > change
    if not torn.any():
        return
    first = int(np.argmax(torn))
    needed = 0.0
    for row in rows[: first + 1]:
        for body, (x, y, angle, *_) in zip(world.bodies.values(), row, strict=True):
            body.position, body.angle = (x, y), angle
        needed = max(needed, halving(world))
    joints = [part for parts in world.joints.values() for part in parts]
    share = max(1 - joint.error_bias**step for joint in joints)
    needed *= math.log2(1 + share)
    if needed > world.space.iterations:
        raise Diverged(
            f"pymunk: the sweeps were not enough: {world.space.iterations} a step, where the "
            f"joints need more than {needed:.0f}; at t = {times[first]:g} s they leave "
            f"{worst[first]:.2g} m/s"
        )


def _left(world: World, rows: Array, times: Array, step: float) -> list[Array]:
    """(N,) [m/s] of each joint that holds a point."""
    return [
        _missing(world, name, part, rows, times, step)
        for name, parts in world.joints.items()
        for part in parts
        if isinstance(part, PivotJoint | GrooveJoint | PinJoint)
    ]


def _missing(
    world: World,
    name: str,
    joint: PivotJoint | GrooveJoint | PinJoint,
    rows: Array,
    times: Array,
    step: float,
) -> Array:
    share = 1 - joint.error_bias**step
    a, b = (_motion(world, body, rows, times) for body in (joint.a, joint.b))
    rb = _turned(b, joint.anchor_b)
    if isinstance(joint, PivotJoint):
        ra = _turned(a, joint.anchor_a)
        gap = b[:2] + rb - a[:2] - ra
        return np.hypot(*(_speed(b, rb) - _speed(a, ra) + share / step * gap))
    if name not in world.slots and isinstance(joint, PinJoint):
        d = b[:2] + rb - a[:2] - _turned(a, joint.anchor_a)
        length = np.hypot(*d)
        ra = _turned(a, joint.anchor_a)
        closing = np.sum(d / length * (_speed(b, rb) - _speed(a, ra)), axis=0)
        return np.abs(closing + share / step * (length - joint.distance))
    cut = world.slots[name] if isinstance(joint, PinJoint) else line(joint.groove_a, joint.groove_b)
    normal = _turned(a, cut.across)
    gap = np.sum(normal * (b[:2] + rb - a[:2] - _turned(a, cut.point)), axis=0)
    ra = b[:2] + rb - a[:2] - normal * gap
    closing = np.sum(normal * (_speed(b, rb) - _speed(a, ra)), axis=0)
    return np.abs(closing + share / step * gap)


def _motion(world: World, body: Body, rows: Array, times: Array) -> Array:
    """(6, N) of a body, of the ground, or of a driven point, which keeps its velocity."""
    for i, other in enumerate(world.bodies.values()):
        if other is body:
            return rows[:, i].T
    still = np.zeros_like(times)
    for name, other in world.driven.items():
        if other is body:
            x, y, vx, vy = world.scene.points[name].states(times).T
            return np.array([x, y, still, vx, vy, still])
    return np.array([still] * 6)


def _turned(motion: Array, point: tuple[float, float]) -> Array:
    """(2, N): a point of the body in ground axes, from its centre."""
    cos, sin = np.cos(motion[2]), np.sin(motion[2])
    return np.array([cos * point[0] - sin * point[1], sin * point[0] + cos * point[1]])


def _speed(motion: Array, lever: Array) -> Array:
    """(2, N): the velocity of a point of the body."""
    return motion[3:5] + motion[5] * np.array([-lever[1], lever[0]])
