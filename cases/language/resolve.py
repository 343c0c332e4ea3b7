"""The grammar's models → the nouns of the project."""

from collections.abc import Mapping
from math import cos, sin

from .. import scene, shape
from ..case import Case, Deviation, Event, Origin, Placement
from ..mistake import Source
from ..scene import STANDARD_GRAVITY, Anchor, GroundPoint, Scene, Signal
from .grammar import body as bodies
from .grammar import force as forces
from .grammar import joint as joints
from .grammar.file import File, Near
from .grammar.friction import Coefficients, DryFriction, TwoWay, both_ways

_COORDINATES = ("x", "y", "angle", "vx", "vy", "omega")


def resolve_scene(file: File) -> Scene:
    """The scene, with its references as they stand (cases/links.py checks them)."""
    s = file.scene
    return Scene(
        gravity=_gravity(s.gravity, s.incline),
        points={name: _ground(p) for name, p in s.points.items()},
        bodies={name: _body(name, b) for name, b in s.bodies.items()},
        joints={name: _joint(name, j) for name, j in s.joints.items()},
        contacts={name: _contact(name, c) for name, c in s.contacts.items()},
        forces={name: _force(name, f) for name, f in s.forces.items()},
    )


def resolve_case(name: str, file: File, scene: Scene, source: Source) -> Case:
    """The case of a file without mistakes."""
    book = file.source
    return Case(
        name=name,
        title=file.title,
        origin=Origin(book.equations, book.example, book.exercise, book.figure, book.section),
        system=file.system,
        parameters={name: amount.value for name, amount in file.parameters.items()},
        drops_out=file.drops_out,
        scene=scene,
        initial=_placements(file.initial),
        near=_placements(file.near),
        duration=file.duration,
        samples=file.samples,
        step=file.step,
        allow={q: None if amount is None else amount.value for q, amount in file.allow.items()},
        reach={
            way: {q: amount.value for q, amount in bounds.items()}
            for way, bounds in file.reach.items()
        },
        deviates={
            setting: {
                q: Deviation(
                    d.because,
                    limit=None if d.limit is None else d.limit.value,
                    by=None if d.by is None else (d.by[0].value, d.by[1].value),
                )
                for q, d in known.items()
            }
            for setting, known in file.deviates.items()
        },
        rests=file.rests,
        events={
            event: Event(quantity, rule)  # type: ignore[arg-type]  # the grammar's word
            for event, rules in file.events.items()
            for quantity, rule in rules.items()
        },
        source=source,
    )


def anchor(word: str) -> Anchor:
    body, _, point = word.partition(".")
    return Anchor(body, point)


def _gravity(gravity: str | None, incline: float | None) -> scene.Vector:
    if gravity == "none":
        return (0.0, 0.0)
    if incline is None:
        return (0.0, -STANDARD_GRAVITY)
    return (STANDARD_GRAVITY * sin(incline), -STANDARD_GRAVITY * cos(incline))


def _ground(point: tuple[float, float] | joints.DrivenPoint) -> GroundPoint:
    if isinstance(point, joints.DrivenPoint):
        return GroundPoint(point.at, point.velocity)
    return GroundPoint(point)


def _body(name: str, body: bodies.Body) -> scene.Body:
    match body:
        case bodies.BarBody(bar=s, points=points):
            return shape.bar(name=name, mass=s.mass, length=s.length, points=points)
        case bodies.DiskBody(disk=s, points=points):
            return shape.disk(name=name, mass=s.mass, radius=s.radius, points=points)
        case bodies.BlockBody(block=s, points=points):
            return shape.block(
                name=name, mass=s.mass, width=s.width, height=s.height, points=points
            )
        case bodies.ParticleBody(particle=s):
            return shape.particle(name=name, mass=s.mass)
        case bodies.RigidBody(rigid=s, points=points):
            return shape.rigid(name=name, mass=s.mass, inertia=s.inertia, points=points)


def _joint(name: str, joint: joints.Joint) -> scene.Joint:
    match joint:
        case joints.Pin(pin=(a, b)):
            return scene.Joint(name, "pin", anchor(a), anchor(b))
        case joints.Slide(slide=(a, b), along=along, angle=angle, dry_friction=dry):
            friction = None if dry is None else _dry_friction(dry)
            return scene.Joint(name, "slide", anchor(a), anchor(b), along, angle, friction)
        case joints.Weld(weld=(a, b), angle=angle):
            return scene.Joint(name, "weld", anchor(a), anchor(b), angle=angle)


def _dry_friction(dry: DryFriction) -> scene.DryFriction:
    return scene.DryFriction(
        static=_bounds(dry.kinetic if dry.static is None else dry.static),
        kinetic=_bounds(dry.kinetic),
        smooth=None if dry.smooth is None else scene.Smooth(dry.smooth.band, dry.smooth.sharpness),
    )


def _bounds(force: float | TwoWay) -> scene.Bounds:
    both = both_ways(force)
    return scene.Bounds(both.forward, both.backward)


def _contact(name: str, contact: joints.Contact) -> scene.Contact:
    body, _, point = contact.between[0].partition(".")
    mu = contact.friction
    static, kinetic = (mu.static, mu.kinetic) if isinstance(mu, Coefficients) else (mu, mu)
    return scene.Contact(
        name,
        Anchor(body, point or scene.CENTER),
        static,
        kinetic,
        contact.restitution,
        contact.ideal,  # type: ignore[arg-type]  # the grammar's word
    )


def _force(name: str, force: forces.Force) -> scene.Force:
    match force:
        case forces.Spring(spring=(a, b), stiffness=c, rest_length=length):
            return scene.Spring(name, anchor(a), anchor(b), c, length)
        case forces.Damper(damper=(a, b), damping=d):
            return scene.Damper(name, anchor(a), anchor(b), d)
        case forces.Push(push=at):
            return scene.Push(name, anchor(at), _signal(force))
        case forces.Torque(torque=body):
            return scene.Torque(name, body, _signal(force))


def _signal(force: forces.Push | forces.Torque) -> Signal:
    if force.sine is not None:
        sine = force.sine
        return Signal("sine", _components(sine.amplitude), sine.angular_frequency, sine.phase)
    if force.ramp is not None:
        return Signal("ramp", _components(force.ramp))
    assert force.constant is not None  # the grammar asks for exactly one
    return Signal("constant", _components(force.constant))


def _components(value: float | tuple[float, float]) -> tuple[float, ...]:
    return value if isinstance(value, tuple) else (value,)


def _placements(places: Mapping[str, Near]) -> dict[str, Placement]:
    return {
        body: Placement(
            given={c: v for c in _COORDINATES if (v := getattr(place, c, None)) is not None},
            points=dict(place.places),
        )
        for body, place in places.items()
    }
