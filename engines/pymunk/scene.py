"""Scene and start state → a pymunk Space: construction only, nothing moves here.

Masses and inertias are given to the bodies; shapes carry none, because pymunk's inertia of a
segment with a radius is that of a box. Only what touches the floor has a shape.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from pymunk.body import Body
from pymunk.constraints import Constraint, DampedSpring, GearJoint, GrooveJoint, PivotJoint
from pymunk.shapes import Circle, Segment
from pymunk.space import Space

from ...cases.scene import GROUND, Anchor, DryFriction, Joint, Scene, Spring, Vector
from ..engine import Realised, State
from .contact import FLOOR_ELASTICITY, FLOOR_FRICTION, circle

# Half the length [m] of the floor and of a slide's groove, which pymunk wants finite: farther
# than a case travels, and short enough that rounding (100 m × 1e-16) stays below every reach.
FAR = 100.0


@dataclass(frozen=True)
class World:
    """The space and its parts by their names in the scene.

    A joint's first constraint carries its force. driven: the driven points' bodies. brakes: the
    friction joints of slides.
    """

    scene: Scene
    space: Space
    bodies: dict[str, Body] = field(default_factory=dict)
    driven: dict[str, Body] = field(default_factory=dict)
    joints: dict[str, tuple[Constraint, ...]] = field(default_factory=dict)
    brakes: dict[str, GrooveJoint] = field(default_factory=dict)
    lines: dict[str, DampedSpring] = field(default_factory=dict)
    wheels: dict[str, Circle] = field(default_factory=dict)

    def body(self, anchor: Anchor) -> Body:
        if anchor.body != GROUND:
            return self.bodies[anchor.body]
        return self.driven.get(anchor.point, self.space.static_body)

    @property
    def bounded(self) -> bool:
        """Whether something in it is only FAR long."""
        return bool(self.wheels) or any(j.kind == "slide" for j in self.scene.joints.values())

    def wheel(self, contact: str) -> Body:
        """The body that touches the floor."""
        return self.bodies[self.scene.contacts[contact].body]

    def local(self, anchor: Anchor) -> Vector:
        """The anchor in its body's axes from its centre of mass."""
        if anchor.body != GROUND:
            return self.scene.bodies[anchor.body].points[anchor.point]
        return (0.0, 0.0) if anchor.point in self.driven else self.scene.points[anchor.point].at


def build(scene: Scene, start: State, numbers: Mapping[str, Any], realised: Realised) -> World:
    """The scene at its start, with a setting's numbers; `law` leaves the dampers to a force."""
    space = Space()
    space.gravity = scene.gravity
    world = World(scene, space)
    _bodies(world, start)
    _contacts(world)
    _joints(world, start)
    _lines(world, realised)
    joints = [part for parts in world.joints.values() for part in parts]
    for name, value in numbers.items():
        owner, _, attribute = name.partition(".")
        for part in {"space": [space], "constraint": joints}.get(owner, ()):
            setattr(part, attribute, value)
    return world


def _bodies(world: World, start: State) -> None:
    for body in world.scene.bodies.values():
        part = Body(body.mass, math.inf if body.inertia is None else body.inertia)
        x, y, angle, vx, vy, omega = start[body.name]
        part.position, part.velocity = (x, y), (vx, vy)
        part.angle, part.angular_velocity = (angle, omega) if body.turns else (0.0, 0.0)
        world.bodies[body.name] = part
    for name, point in world.scene.points.items():
        if point.driven:
            part = Body(body_type=Body.KINEMATIC)
            part.position, part.velocity = point.at, point.velocity
            world.driven[name] = part
    world.space.add(*world.bodies.values(), *world.driven.values())


def _contacts(world: World) -> None:
    if not world.scene.contacts:
        return
    floor = Segment(world.space.static_body, (-FAR, 0.0), (FAR, 0.0), 0.0)
    floor.friction, floor.elasticity = FLOOR_FRICTION, FLOOR_ELASTICITY
    world.space.add(floor)
    for contact in world.scene.contacts.values():
        part, body = world.scene.bodies[contact.body], world.bodies[contact.body]
        world.wheels[contact.name] = circle(contact, part, body)
        world.space.add(world.wheels[contact.name])


def _joints(world: World, start: State) -> None:
    """In the order of the case file: another order is another order of the solver's sweeps."""
    for joint in world.scene.joints.values():
        a, b = world.body(joint.a), world.body(joint.b)
        if joint.kind == "slide":
            parts: list[Constraint] = [GrooveJoint(a, b, *groove(world, joint))]
        else:
            parts = [PivotJoint(a, b, world.local(joint.a), world.local(joint.b))]
        if joint.kind != "pin" and holds_angle(world.scene, joint):
            parts.append(GearJoint(a, b, phase(joint, start), 1.0))
        world.joints[joint.name] = tuple(parts)
        world.space.add(*parts)
        if joint.dry_friction:
            world.brakes[joint.name] = _brake(world, joint, joint.dry_friction)
            world.space.add(world.brakes[joint.name])


def _brake(world: World, joint: Joint, friction: DryFriction) -> GrooveJoint:
    """A friction joint: it stops the shift along the slide with no more than its force, and
    corrects no position.

    A groove across the slide, because a pivot would take part of the load that the slide holds;
    through both centres, where pymunk solves it alone (see `groove`). What that shifts the force
    sideways is a couple, which the slide takes.
    """
    (x, y), (ux, uy) = world.local(joint.a), joint.along
    if turns(world.scene, joint.a):
        x, y = 0.0, 0.0
    ends = (x + FAR * uy, y - FAR * ux), (x - FAR * uy, y + FAR * ux)
    brake = GrooveJoint(world.body(joint.a), world.body(joint.b), *ends, (0.0, 0.0))
    brake.max_bias = 0.0
    # the engine knows one force for both directions, and for rest and motion
    brake.max_force = (friction.kinetic.forward + friction.kinetic.backward) / 2
    return brake


def _lines(world: World, realised: Realised) -> None:
    """Springs without damping, dampers without stiffness."""
    dampers = world.scene.dampers() if realised == "native" else ()
    for force in (*world.scene.springs(), *dampers):
        a, b = world.body(force.a), world.body(force.b)
        numbers = (
            (force.rest_length, force.stiffness, 0.0)
            if isinstance(force, Spring)
            else (0.0, 0.0, force.damping)
        )
        world.lines[force.name] = DampedSpring(
            a, b, world.local(force.a), world.local(force.b), *numbers
        )
        world.space.add(world.lines[force.name])


def holds_angle(scene: Scene, joint: Joint) -> bool:
    """Whether both parts have an angle and one of them can turn; a particle has none."""
    bodies = [scene.bodies[p.body] for p in (joint.a, joint.b) if p.body != GROUND]
    return all(body.turns for body in bodies)


def turns(scene: Scene, anchor: Anchor) -> bool:
    return anchor.body != GROUND and scene.bodies[anchor.body].turns


def phase(joint: Joint, start: State) -> float:
    """The held angle of b against a [rad], on the turn at which the start stands."""
    first, second = (0.0 if p.body == GROUND else start[p.body][2] for p in (joint.a, joint.b))
    return joint.angle + round((second - first - joint.angle) / math.tau) * math.tau


def groove(world: World, joint: Joint) -> tuple[Vector, Vector, Vector]:
    """A slide's groove on its first part (two ends), and the point of the second in it.

    As the slide lets nothing turn, any parallel line holds the same. It runs through the centre
    of a first part that turns, else of the second, and meets the other where it is nearest to
    that one's centre: pymunk projects K⁻¹(v_bias − v) onto the groove's normal, and only there
    is the normal a principal axis of K; see `oblique` for what happens elsewhere.
    """
    (ax, ay), (ux, uy) = world.local(joint.a), joint.along
    cos, sin = math.cos(joint.angle), math.sin(joint.angle)
    bx, by = world.local(joint.b)
    bx, by = cos * bx - sin * by, sin * bx + cos * by  # in the first part's axes
    px, py, anchor = ax - bx, ay - by, (0.0, 0.0)
    if turns(world.scene, joint.a) and holds_angle(world.scene, joint):
        offset = uy * px - ux * py  # from the second centre to the line, along n
        nx, ny = -uy * offset, ux * offset
        px, py, anchor = 0.0, 0.0, (cos * nx + sin * ny, cos * ny - sin * nx)
    ends = (px - FAR * ux, py - FAR * uy), (px + FAR * ux, py + FAR * uy)
    return *ends, anchor


def oblique(scene: Scene, joint: Joint) -> bool:
    """Whether a groove has to lie where K is oblique to it: a particle beside a turning centre.

    There the solver settles with the particle off the line by c h times its sliding speed: the
    motion is of first order, and starts with a kick.
    """
    if joint.kind != "slide" or not turns(scene, joint.a) or holds_angle(scene, joint):
        return False
    (x, y), (ux, uy) = scene.bodies[joint.a.body].points[joint.a.point], joint.along
    return abs(ux * y - uy * x) > 1e-12 * math.hypot(x, y)
