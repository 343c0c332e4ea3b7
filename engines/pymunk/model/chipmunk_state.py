"""A body's state by Chipmunk's own calls, where a loop reads it in every step.

pymunk wraps each in a Vec2d, which together cost more than a step. Nothing else here reaches
inside: steps are taken, and forces told, by the calls that a user makes, for what pymunk does in
them is measured. Should its inside be another one day, its public names serve: with the same
numbers.
"""

from collections.abc import Callable
from functools import partial

from pymunk import batch
from pymunk.batch import BodyFields, Buffer, get_space_bodies
from pymunk.body import Body
from pymunk.space import Space

State = tuple[float, float, float, float, float, float]
"""x, y, angle, vx, vy and omega of a body."""
Pair = tuple[float, float]
Push = Callable[[Pair, Pair], None]
"""Adds a force [N] that acts at a place [m], both in ground axes, until the next step."""


def reading(body: Body) -> Callable[[], State]:
    """A function that reads the body's state."""
    try:
        lib, it = batch.lib, body._body
        position, angle = lib.cpBodyGetPosition, lib.cpBodyGetAngle
        velocity, omega = lib.cpBodyGetVelocity, lib.cpBodyGetAngularVelocity
    except AttributeError:

        def look() -> State:
            (x, y), (vx, vy) = body.position, body.velocity
            return x, y, body.angle, vx, vy, body.angular_velocity

        return look

    def read() -> State:
        p, v = position(it), velocity(it)
        return p.x, p.y, angle(it), v.x, v.y, omega(it)

    return read


def spinning(body: Body) -> Callable[[], Pair]:
    """A function that reads the body's angle and omega."""
    try:
        lib, it = batch.lib, body._body
        angle, omega = lib.cpBodyGetAngle, lib.cpBodyGetAngularVelocity
    except AttributeError:
        return lambda: (body.angle, body.angular_velocity)
    return lambda: (angle(it), omega(it))


def forced(body: Body) -> Callable[[], Pair]:
    """A function that reads the force [N] that the body has been told since the last step."""
    try:
        it, force = body._body, batch.lib.cpBodyGetForce
    except AttributeError:
        return lambda: (body.force.x, body.force.y)

    def read() -> Pair:
        f = force(it)
        return f.x, f.y

    return read


def pushing(body: Body) -> Push:
    """`body.apply_force_at_world_point`."""
    return body.apply_force_at_world_point


def turning(body: Body) -> Callable[[float], None]:
    """A function that adds a torque [N m] until the next step."""

    def turn(torque: float) -> None:
        body.torque += torque

    return turn


def copier(space: Space, fields: BodyFields, buffer: Buffer) -> Callable[[], None]:
    """A function that copies the fields of all bodies behind what the buffer holds.

    `get_space_bodies` prepares the same call of Chipmunk's anew each time, which costs more than
    the copies and a step.
    """
    try:
        data = batch.ffi.new("pmBatchedData *")
        data.fields = fields.value
        data.floatArray, data.intArray = buffer._float_arr, buffer._int_arr
        each = batch.ffi.addressof(batch.lib, "pmSpaceBodyGetIteratorFuncBatched")
        return partial(batch.lib.cpSpaceEachBody, space._space, each, data)
    except Exception:  # of many kinds: cffi raises its own
        return partial(get_space_bodies, space, fields, buffer)
