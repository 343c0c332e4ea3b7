"""How many sweeps a world's joints need, from its bodies and joints alone.

A sweep solves one joint after the other, and the error of the velocities that it leaves is a
linear map of the error before. The map's spectral radius ρ is what the slowest error keeps of
itself. With error_bias = 0 steps are stable if and only if ρ^iterations < 1/2. No step size
stands in that: smaller steps only take more of them to blow up.
"""

import math
from collections.abc import Iterator

import numpy as np
from pymunk.body import Body
from pymunk.constraints import (
    Constraint,
    GearJoint,
    GrooveJoint,
    PinJoint,
    PivotJoint,
    RotaryLimitJoint,
    SimpleMotor,
    SlideJoint,
)
from pymunk.space import Space
from pymunk.vec2d import Vec2d

from ....cases.scene import Contact, Pair
from ....cases.scene.motion import Motion
from ....cases.trajectory import Array, Trajectory
from .world import World

NEVER = 1e9  # sweeps that nobody takes: ρ is 1 up to rounding
DEPENDENT = 1e-9  # of the largest singular value: rows that say what the others say
Columns = dict[Body, int]  # where a body's vx, vy, omega stand


def halving(world: World) -> float:
    """How many sweeps halve the slowest error at the present pose: ln 2 / −ln ρ, at least 1.

    Contacts count as closed and, like dry friction, as sticking.
    """
    steps = list(_steps(world))
    if not steps:
        return 1.0
    acting = np.vstack([acts for _, _, acts in steps])
    _, sizes, across = np.linalg.svd(acting, full_matrices=False)
    held = across[sizes > DEPENDENT * sizes[0]]  # nothing acts on what is left
    error = held.T
    for measured, solved, acts in steps:
        error = error - acts.T @ (solved @ (measured @ error))
    rho = float(max(abs(np.linalg.eigvals(held @ error))))
    if rho <= 0.5:
        return 1.0
    return min(NEVER, math.log(2) / -math.log(rho)) if rho < 1 else NEVER


def _steps(world: World) -> Iterator[tuple[Array, Array, Array]]:
    """The arrays of a sweep's step for each contact and joint, in pymunk's order.

    The rows that it measures, what it makes of them, and the rows along which it acts. Velocities
    are multiplied by the roots of the masses.
    """
    columns, weights = _columns(world)
    for contact in _together(world):
        body, part = world.wheel(contact.name), world.scene.bodies[contact.body]
        local = Vec2d(*world.local(contact.at)).rotated(body.angle)
        place = local if part.radius is None else Vec2d(0.0, -part.radius)
        rows = _moves(columns, len(weights), body, place) * weights
        yield rows, np.diag(1 / np.sum(rows**2, axis=1)), rows
    for pair in world.scene.pairs.values():
        rows = _parting(world, pair, columns, len(weights)) * weights
        yield rows, np.diag(1 / np.sum(rows**2, axis=1)), rows
    for joint in world.space.constraints:
        of_joint = _joint(world.space, joint, columns, len(weights))
        if of_joint is not None:
            rows, normal = of_joint[0] * weights, of_joint[1]
            yield rows, normal @ np.linalg.inv(rows @ rows.T), normal @ rows


def _parting(world: World, pair: Pair, columns: Columns, n: int) -> Array:
    """(2, n): how both slip and part where they touch, or are nearest."""
    body, other = world.bodies[pair.body], world.bodies[pair.touched]
    states = {
        name: np.array([[*world.bodies[name].position, world.bodies[name].angle, 0.0, 0.0, 0.0]])
        for name in (pair.body, pair.touched)
    }
    motion = Motion(world.scene.bodies, {}, Trajectory(np.zeros(1), states, {}))
    (x, y), (nx, ny) = pair.place(motion)[0].tolist(), pair.normal_and_gap(motion)[0][0].tolist()
    moves = _moves(columns, n, body, Vec2d(x, y) - body.position)
    moves -= _moves(columns, n, other, Vec2d(x, y) - other.position)
    return np.array([ny * moves[0] - nx * moves[1], nx * moves[0] + ny * moves[1]])


def _together(world: World) -> Iterator[Contact]:
    """Contacts closed at once: of spokes the two lowest tips, of two feet the one that stands."""
    stands = world.stride and world.stride.stands(world.place)
    for contact in world.scene.contacts.values():
        if contact.ahead_of is not None and contact.name != stands:
            continue
        body = world.bodies[contact.body]
        lowest = sorted(contact.each(), key=lambda c: body.local_to_world(world.local(c.at)).y)
        yield from lowest[:2]


def _columns(world: World) -> tuple[Columns, Array]:
    """The columns, and 1/√m, 1/√m, 1/√J in them."""
    columns: Columns = {}
    weights: list[float] = []
    for body in world.bodies.values():
        columns[body] = len(weights)
        weights += [1 / math.sqrt(body.mass)] * 2 + [1 / math.sqrt(body.moment)]
    return columns, np.array(weights)


def _joint(space: Space, joint: Constraint, columns: Columns, n: int) -> tuple[Array, Array] | None:
    """The relative velocities that it measures, and the normals along which it acts."""
    a, b = joint.a, joint.b
    if isinstance(joint, GearJoint | SimpleMotor | RotaryLimitJoint):  # as if it were struck
        row = np.zeros((1, n))
        for body, sign in ((a, -1.0), (b, getattr(joint, "ratio", 1.0))):
            if body in columns:
                row[0, columns[body] + 2] = sign
        return row, np.eye(1)
    if isinstance(joint, PivotJoint):
        there, normal = joint.anchor_b.rotated(b.angle), np.eye(2)
        here = joint.anchor_a.rotated(a.angle)
    elif isinstance(joint, GrooveJoint):
        there = joint.anchor_b.rotated(b.angle)
        here = there + b.position - a.position
        along = (joint.groove_b - joint.groove_a).rotated(a.angle).normalized()
        normal = np.array([[-along.y, along.x]])
    elif isinstance(joint, PinJoint | SlideJoint):  # a rope counts as taut, as a contact as closed
        if joint.pre_solve:
            joint.pre_solve(joint, space)  # across its slot at this pose
        there, here = joint.anchor_b.rotated(b.angle), joint.anchor_a.rotated(a.angle)
        across = there + b.position - a.position - here
        if not across.length:
            return None
        rows = _moves(columns, n, b, there) - _moves(columns, n, a, here)
        return np.array([across.normalized()]) @ rows, np.eye(1)
    else:
        return None  # a spring is not swept
    return _moves(columns, n, b, there) - _moves(columns, n, a, here), normal


def _moves(columns: Columns, n: int, body: Body, lever: Vec2d) -> Array:
    """(2, n): how a point of the body moves by all velocities; the ground's does not."""
    rows = np.zeros((2, n))
    if body in columns:
        i = columns[body]
        rows[0, i] = rows[1, i + 1] = 1.0
        rows[0, i + 2], rows[1, i + 2] = -lever.y, lever.x
    return rows
