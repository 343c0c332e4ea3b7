"""Dry friction by its law (2.89), (2.95): ours, told to pymunk's friction before every step.

pymunk knows one bound of friction. The law sets it to the mean force of the coming step, and
pymunk holds with it, or brakes. `ruled` says where the law is known beforehand: on a part that
nothing else joins or touches.
"""

import math
from collections.abc import Callable
from functools import partial

from ....cases.scene import GROUND, Bounds, Contact, DryFriction, Joint, Scene, Vector
from ..force import load
from ..world import World
from .breakaway import bound, smooth_mean
from .slip import Slip, turn

Told = Callable[[float], None]  # called before the step that starts at t [s]
RESTING = 1e-9  # m/s: a part that neither falls nor rises; above rounding, below any impact


def ruled(scene: Scene) -> bool:
    """Whether there is dry friction with more than pymunk's one bound, and its law is known."""
    joints = [j for j in scene.joints.values() if j.dry_friction]
    contacts = [c for c in scene.contacts.values() if _two_bounds(c)]
    alone = all(j.a.body == GROUND and _only(scene, j.b.body) for j in joints) and all(
        _only(scene, c.body) and _simple(scene, c) for c in contacts
    )
    return bool(joints or contacts) and alone


def laws(world: World, step: float) -> list[Told]:
    """What has to be called before each step where friction goes by its law."""
    found: list[Told] = []
    for joint in world.scene.joints.values():
        if joint.dry_friction:
            found.append(_joint(world, joint, joint.dry_friction, step))
    for contact in world.scene.contacts.values():
        if _two_bounds(contact):
            found.append(_contact(world, contact, step))
    return found


def _two_bounds(contact: Contact) -> bool:
    return contact.switches and contact.static != contact.kinetic


def _only(scene: Scene, body: str) -> bool:
    """Whether one joint or contact is all that holds the body, and no rope or stop ever does."""
    joints = [j for j in scene.joints.values() if body in (j.a.body, j.b.body)]
    pairs = [p for p in scene.pairs.values() if body in (p.body, p.touched)]
    contacts = [c for c in scene.contacts.values() if c.body == body]
    limited = any(
        body in (end.body for end in scene.ends(force))
        for force in scene.forces.values()
        if force.given
    )
    return len(joints) + len(pairs) + len(contacts) == 1 and not limited


def _simple(scene: Scene, contact: Contact) -> bool:
    """Where normal force and friction do not feel each other: a disk or a particle."""
    body = scene.bodies[contact.body]
    return body.radius is not None or not body.turns


def _joint(world: World, joint: Joint, friction: DryFriction, step: float) -> Told:
    brake, smooth = world.brakes[joint.name], friction.smooth
    slip = _slide(world, joint, step) if joint.shifts else turn(world, joint, step)

    def exact(t: float) -> None:
        applied = partial(slip.applied, t)
        brake.max_force, force = bound(friction, slip.speed(), slip.mass, applied, step)
        if force:
            slip.push(force)

    def blurred(t: float) -> None:
        assert smooth is not None
        middle, v = slip.applied(t, step / 2), slip.speed()
        force = smooth_mean(friction, smooth, v, slip.mass, middle, step)
        brake.max_force = 0.0  # nothing rests: a force, not a bound
        slip.push(force)

    return blurred if smooth else exact


def _slide(world: World, joint: Joint, step: float) -> Slip:
    body, acting = world.bodies[joint.b.body], load(world, joint.b.body, step)
    ux, uy = joint.along
    carried = world.scene.points[joint.a.point].velocity  # of a driven rail

    def along(t: float, ahead: float) -> float:
        fx, fy, _ = acting(t, ahead)
        return ux * fx + uy * fy

    def speed() -> float:
        vx, vy = body.velocity
        return ux * (vx - carried[0]) + uy * (vy - carried[1])

    def push(force: float) -> None:
        body.apply_force_at_world_point((ux * force, uy * force), body.position)

    return Slip(body.mass, along, speed, push)


def _contact(world: World, contact: Contact, step: float) -> Told:
    """By the slip of the point that touches, and the mass that resists it there."""
    part = world.scene.bodies[contact.body]
    body, shape = world.bodies[contact.body], world.wheels[contact.name]
    acting, ((ux, uy), (nx, ny)) = load(world, contact.body, step), _axes(contact)
    radius = part.radius or 0.0
    turn = radius / part.inertia if part.inertia else 0.0  # slip per angular impulse
    mass = 1 / (1 / part.mass + radius * turn)

    def along(t: float, normal: float, ahead: float) -> float:
        """With what static friction has lost by then, or gained, so that its bound stays."""
        fx, fy, torque = acting(t, ahead)
        force = mass * ((ux * fx + uy * fy) / part.mass + turn * torque)
        gained = normal + nx * fx + ny * fy
        return force + math.copysign(1.0, force) * contact.static * gained

    def exact(t: float) -> None:
        shape.friction = contact.kinetic
        (vx, vy), (fx, fy, _) = body.velocity, acting(t, step / 2)
        normal = -(nx * fx + ny * fy)
        if abs(nx * vx + ny * vy) > RESTING or normal <= 0:
            return  # in flight, or in an impact, which is no place to rest
        slip = ux * vx + uy * vy + radius * body.angular_velocity
        both = DryFriction(
            Bounds(contact.static * normal, contact.static * normal),
            Bounds(contact.kinetic * normal, contact.kinetic * normal),
        )
        limit, push = bound(both, slip, mass, partial(along, t, normal), step)
        shape.friction = limit / normal
        if push:
            lowest = body.position - (radius * nx, radius * ny)
            body.apply_force_at_world_point((push * ux, push * uy), lowest)

    return exact


def _axes(contact: Contact) -> tuple[Vector, Vector]:
    """Along its plane, and away from it."""
    return contact.plane.along, contact.plane.normal
