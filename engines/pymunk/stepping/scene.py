"""Scene and start state → a pymunk Space: construction only, nothing moves here.

Masses and inertias are given to the bodies; shapes carry none, because pymunk's inertia of a
segment with a radius is that of a box. Only what touches a plane has a shape.
"""

import math
from collections.abc import Mapping
from typing import Any

from pymunk.body import Body
from pymunk.constraints import Constraint, GearJoint, GrooveJoint, PinJoint, PivotJoint, SimpleMotor
from pymunk.shapes import Segment
from pymunk.space import Space

from ....cases.scene import GROUND, DryFriction, Joint, Scene, Vector
from ...engine import Realised, Start
from ...foot_contact import stride
from ..callbacks.force import damp, limits, lines
from ..model.contact import FLOOR_ELASTICITY, FLOOR_FRICTION, circle, closed, only, planes
from ..model.edge import add_edges
from ..model.pair import add_pairs
from ..model.plain_shapes import SHAPES, add_plain_shapes
from ..model.slot import holds_angle, line, oblique, pinned, turns
from ..model.world import World

# Half the length [m] of planes, and of a slide's groove, which pymunk wants finite. Every step
# takes anew 1e-16 × the length of a place, and so 1e-16 × length × mass / h² of a force: 1e-6 N of
# 1 kg at 1e-4 s.
NEAR = 100.0
FAR = 1e4  # of those of the ground, once a body has left them; longer, a disk's seed is lost


def build(scene: Scene, start: Start, numbers: Mapping[str, Any], realised: Realised) -> World:
    """The scene at its start, with a setting's numbers; `law` leaves the dampers to a force."""
    space = Space()
    space.gravity = scene.gravity
    walks = stride(scene, [contact.name for contact in closed(scene, start)])
    world = World(scene, space, numbers.get("ground.reach", NEAR), stride=walks)
    _bodies(world, start)
    (add_plain_shapes if SHAPES in numbers else _contacts)(world)
    _joints(world, start, across=bool(numbers.get("slot.across")))
    add_edges(world)
    limits(world)
    lines(world, realised)
    joints = [part for parts in world.joints.values() for part in parts]
    ends = [limit.joint for limit in world.limits.values()]
    joints += ends
    for name, value in numbers.items():
        owner, _, attribute = name.partition(".")
        for part in {"space": [space], "constraint": joints, "limit": ends}.get(owner, ()):
            setattr(part, attribute, value)
    damp(world, start, realised)
    return world


def _bodies(world: World, start: Start) -> None:
    for body in world.scene.bodies.values():
        part = Body(body.mass, body.moment if body.turns else math.inf)
        x, y, angle, vx, vy, omega = start[body.name]
        part.position, part.velocity = (x, y), (vx, vy)
        part.angle, part.angular_velocity = (angle, omega) if body.turns else (0.0, 0.0)
        world.bodies[body.name] = part
    for name, point in world.scene.points.items():
        if point.driven:
            part = Body(body_type=Body.KINEMATIC)
            x, y, vx, vy = point.state(0.0)
            part.position, part.velocity = (x, y), (vx, vy)
            world.driven[name] = part
    world.space.add(*world.bodies.values(), *world.driven.values())


def _contacts(world: World) -> None:
    known = planes(world.scene)
    for plane, sides in known.items():
        (x, y), (ux, uy), far = plane.at, plane.along, world.reach
        ends = (x - far * ux, y - far * uy), (x + far * ux, y + far * uy)
        segment = Segment(world.space.static_body, *ends, 0.0)
        segment.friction, segment.elasticity = FLOOR_FRICTION, FLOOR_ELASTICITY
        segment.filter = sides
        world.planes[plane.name] = segment
        world.space.add(segment)
    for contact in world.scene.touching.values():
        wheel = circle(world.scene, contact, world.bodies[contact.body])
        world.wheels[contact.name] = wheel
        only(wheel, known[contact.plane])
        world.space.add(wheel)
    add_pairs(world, len(known))


def _joints(world: World, start: Start, *, across: bool) -> None:
    """In the order of the case file: another order is another order of the solver's sweeps.

    across: whether an oblique groove is a pin joint.
    """
    for joint in world.scene.joints.values():
        a, b = world.body(joint.a), world.body(joint.b)
        if joint.shifts:
            first, last, anchor = groove(world, joint)
            parts: list[Constraint] = [GrooveJoint(a, b, first, last, anchor)]
            if across and oblique(world.scene, joint):
                world.slots[joint.name] = cut = line(first, last)
                parts = [pinned(a, b, cut, anchor)]
        elif joint.swings:
            parts = [PinJoint(a, b, world.local(joint.a), world.local(joint.b))]
        else:
            parts = [PivotJoint(a, b, world.local(joint.a), world.local(joint.b))]
        if not joint.turns and holds_angle(world.scene, joint):
            parts.append(GearJoint(a, b, phase(joint, start), 1.0))
        if law := world.scene.drives.get(f"{joint.name}.omega"):
            world.motors[joint.name] = motor = SimpleMotor(a, b, -law.at_start()[0])
            parts.append(motor)
        world.joints[joint.name] = tuple(parts)
        world.space.add(*parts)
        if joint.dry_friction:
            brake = _across(world, joint) if joint.shifts else SimpleMotor(a, b, 0.0)
            _rub(brake, joint.dry_friction)
            world.brakes[joint.name] = brake
            world.space.add(brake)


def _rub(brake: GrooveJoint | SimpleMotor, friction: DryFriction) -> None:
    """It stops the slip with no more than its force or moment, and corrects no position."""
    brake.max_bias = 0.0
    # the engine knows one for both directions, and for rest and motion
    brake.max_force = (friction.kinetic.forward + friction.kinetic.backward) / 2


def _across(world: World, joint: Joint) -> GrooveJoint:
    """The groove joint that rubs in a slide; in a pin it is a motor that stands still.

    A groove across the slide, because a pivot would take part of the load that the slide holds;
    through both centres, where pymunk solves it alone (see `groove`). What that shifts the force
    sideways is a couple, which the slide takes.
    """
    (x, y), (ux, uy) = world.local(joint.a), joint.along
    if turns(world.scene, joint.a):
        x, y = 0.0, 0.0
    far = reach(world, joint)
    ends = (x + far * uy, y - far * ux), (x - far * uy, y + far * ux)
    return GrooveJoint(world.body(joint.a), world.body(joint.b), *ends, (0.0, 0.0))


def reach(world: World, joint: Joint) -> float:
    """How far [m] the second part can shift to each side."""
    return world.reach if joint.a.body == GROUND else NEAR


def phase(joint: Joint, start: Start) -> float:
    """The held angle of b against a [rad], on the turn at which the start stands."""
    first, second = (0.0 if p.body == GROUND else start[p.body][2] for p in (joint.a, joint.b))
    return joint.angle + round((second - first - joint.angle) / math.tau) * math.tau


def groove(world: World, joint: Joint) -> tuple[Vector, Vector, Vector]:
    """A slide's groove on its first part (two ends), and the point of the second in it.

    A slot has its own line. As a slide lets nothing turn, any parallel line holds the same: it
    runs through the centre of a first part that turns, else of the second, and meets the other
    where it is nearest to that one's centre. pymunk projects K⁻¹(v_bias − v) onto the groove's
    normal, and only there is the normal a principal axis of K; see `slot.oblique` for elsewhere.
    """
    (ax, ay), (ux, uy) = world.local(joint.a), joint.along
    cos, sin = math.cos(joint.angle), math.sin(joint.angle)
    bx, by = world.local(joint.b)
    bx, by = cos * bx - sin * by, sin * bx + cos * by  # in the first part's axes
    px, py, anchor, far = ax - bx, ay - by, (0.0, 0.0), reach(world, joint)
    if joint.turns:
        bx, by = world.local(joint.b)
        return (ax - far * ux, ay - far * uy), (ax + far * ux, ay + far * uy), (bx, by)
    if turns(world.scene, joint.a) and holds_angle(world.scene, joint):
        offset = uy * px - ux * py  # from the second centre to the line, along n
        nx, ny = -uy * offset, ux * offset
        px, py, anchor = 0.0, 0.0, (cos * nx + sin * ny, cos * ny - sin * nx)
    ends = (px - far * ux, py - far * uy), (px + far * ux, py + far * uy)
    return *ends, anchor
