"""Dry friction by its law (2.89), (2.95): ours, told to pymunk's friction before every step.

pymunk knows one bound of friction. The law sets it to the mean force of the coming step, and
pymunk holds with it, or brakes. The law is known beforehand on a part that nothing else joins or
touches; where that is not so of one, all friction of the scene stays pymunk's own.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass

from ....cases.scene import GROUND, Bounds, Contact, DryFriction, Joint, Scene, Smooth, Vector
from ...law import braking, dry_friction, smooth_under
from ..model.chipmunk_state import State, pushing, reading, turning
from ..model.world import World
from .force import load

# The slip in a joint of the ground, as the law of friction sees it: a mass, a speed, a force.


@dataclass(frozen=True)
class Slip:
    """mass: what resists the slip [kg; of a pin kg m²]. read: the state of what slips, by which
    the others know. applied: all else that acts along it [N or N m], at t + ahead. speed: [m/s or
    rad/s]. push: friction as a force of ours."""

    mass: float
    read: Callable[[], State]
    applied: Callable[[float, float, State], float]
    speed: Callable[[State], float]
    push: Callable[[float, State], None]


def turn(world: World, joint: Joint, step: float) -> Slip:
    """About a pin: its inertia there, and the moment there of all that acts at the centre."""
    part, body = world.scene.bodies[joint.b.body], world.bodies[joint.b.body]
    acting, (a, b) = load(world, joint.b.body, step), world.local(joint.b)

    def about(t: float, ahead: float, state: State) -> float:
        fx, fy, moment = acting(t, ahead, state)
        _, _, angle, _, _, omega = state
        angle += (ahead + step / 2) * omega  # which is h/2 behind
        cos, sin = math.cos(angle), math.sin(angle)
        return moment - (cos * a - sin * b) * fy + (sin * a + cos * b) * fx

    twist = turning(body)

    def push(moment: float, state: State) -> None:
        twist(moment)

    return Slip(part.about(joint.b.point), reading(body), about, lambda state: state[5], push)


Told = Callable[[float], None]  # called before the step that starts at t [s]
RESTING = 1e-9  # m/s: a part that neither falls nor rises; above rounding, below any impact


def ruled(scene: Scene) -> bool:
    """Whether there is dry friction with more than pymunk's one bound, and all its laws are known.

    Of some that are known beside others that are not a run would be of neither kind.
    """
    joints = [j for j in scene.joints.values() if j.dry_friction]
    contacts = [c for c in scene.contacts.values() if _two_bounds(c)]
    known = [_known_at_joint(scene, j) for j in joints] + [_known_at(scene, c) for c in contacts]
    return bool(known) and all(known)


def laws(world: World, step: float) -> list[Told]:
    """The functions to call before each step where friction goes by its law, which is known."""
    scene = world.scene
    if not ruled(scene):
        return []
    by_joint = [
        _joint(world, joint, joint.dry_friction, step)
        for joint in scene.joints.values()
        if joint.dry_friction
    ]
    contacts = [c for c in scene.contacts.values() if _two_bounds(c)]
    return [*by_joint, *(_contact(world, contact, step) for contact in contacts)]


def _known_at_joint(scene: Scene, joint: Joint) -> bool:
    """Whether nothing but the ground is joined to what slips there."""
    return joint.a.body == GROUND and _only(scene, joint.b.body)


def _known_at(scene: Scene, contact: Contact) -> bool:
    """The same of a contact."""
    return _only(scene, contact.body) and _simple(scene, contact)


def _two_bounds(contact: Contact) -> bool:
    return contact.switches and contact.static != contact.kinetic


def _only(scene: Scene, body: str) -> bool:
    """Whether one joint or contact is all that holds the body, and no limit ever does."""
    joints = [j for j in scene.joints.values() if body in (j.a.body, j.b.body)]
    pairs = [p for p in scene.pairs.values() if body in (p.body, p.touched)]
    contacts = [c for c in scene.contacts.values() if c.body == body]
    limited = any(body in (end.body for end in scene.ends(limit)) for limit in scene.limits())
    return len(joints) + len(pairs) + len(contacts) == 1 and not limited


def _simple(scene: Scene, contact: Contact) -> bool:
    """Where normal force and friction do not feel each other: a disk or a particle."""
    body = scene.bodies[contact.body]
    return body.radius is not None or not body.turns


def _joint(world: World, joint: Joint, friction: DryFriction, step: float) -> Told:
    brake, smooth = world.brakes[joint.name], friction.smooth
    slip = _slide(world, joint, step) if joint.shifts else turn(world, joint, step)

    read, applied, set_bound = slip.read, slip.applied, brake.max_force

    def exact(t: float) -> None:
        nonlocal set_bound
        state = read()
        limit, force = bound(
            friction, slip.speed(state), slip.mass, lambda ahead: applied(t, ahead, state), step
        )
        if limit != set_bound:
            brake.max_force = set_bound = limit
        if force:
            slip.push(force, state)

    if smooth is None:
        return exact
    brake.max_force = 0.0  # nothing rests: a force, not a bound

    def blurred(t: float) -> None:
        state = read()
        middle, v = applied(t, step / 2, state), slip.speed(state)
        slip.push(smooth_mean(friction, smooth, v, slip.mass, middle, step), state)

    return blurred


def _slide(world: World, joint: Joint, step: float) -> Slip:
    body, acting = world.bodies[joint.b.body], load(world, joint.b.body, step)
    ux, uy = joint.along
    carried = world.scene.points[joint.a.point].velocity  # of a driven rail

    pushes = pushing(body)

    def along(t: float, ahead: float, state: State) -> float:
        fx, fy, _ = acting(t, ahead, state)
        return ux * fx + uy * fy

    def speed(state: State) -> float:
        _, _, _, vx, vy, _ = state
        return ux * (vx - carried[0]) + uy * (vy - carried[1])

    def push(force: float, state: State) -> None:
        x, y, *_ = state
        pushes((ux * force, uy * force), (x, y))

    return Slip(body.mass, reading(body), along, speed, push)


def _contact(world: World, contact: Contact, step: float) -> Told:
    """By the slip of the point that touches, and the mass that resists it there."""
    part = world.scene.bodies[contact.body]
    body, shape = world.bodies[contact.body], world.wheels[contact.name]
    read, push = reading(body), pushing(body)
    acting, ((ux, uy), (nx, ny)) = load(world, contact.body, step), _axes(contact)
    radius = part.radius or 0.0
    turn = radius / part.moment if part.turns else 0.0  # slip per angular impulse
    mass = 1 / (1 / part.mass + radius * turn)

    def along(t: float, normal: float, ahead: float, state: State) -> float:
        """With what static friction has lost by then, or gained, so that its bound stays."""
        fx, fy, torque = acting(t, ahead, state)
        force = mass * ((ux * fx + uy * fy) / part.mass + turn * torque)
        gained = normal + nx * fx + ny * fy
        return force + math.copysign(1.0, force) * contact.static * gained

    def exact(t: float) -> None:
        state = read()
        x, y, _, vx, vy, omega = state
        fx, fy, _ = acting(t, step / 2, state)
        normal = -(nx * fx + ny * fy)
        if abs(nx * vx + ny * vy) > RESTING or normal <= 0:
            shape.friction = contact.kinetic
            return  # in flight, or in an impact, which is no place to rest
        slip = ux * vx + uy * vy + radius * omega
        both = DryFriction(
            Bounds(contact.static * normal, contact.static * normal),
            Bounds(contact.kinetic * normal, contact.kinetic * normal),
        )
        limit, force = bound(both, slip, mass, lambda ahead: along(t, normal, ahead, state), step)
        shape.friction = limit / normal
        if force:
            push((force * ux, force * uy), (x - radius * nx, y - radius * ny))

    return exact


def _axes(contact: Contact) -> tuple[Vector, Vector]:
    """Along its plane, and away from it."""
    return contact.plane.along, contact.plane.normal


# The mean force of a dry friction law (2.89) over one step.
#
# pymunk takes one force for the whole step. A part that stops or breaks loose within the step
# feels several; with their mean its velocity at the end of the step is right to h², and no event
# costs a whole step.


Applied = Callable[[float], float]
"""What else acts along the friction [N], so many seconds after the step's start."""
AT_REST = 1e-9
"""Below this share of what friction can stop in one step a speed is the solver's rounding."""


def bound(
    friction: DryFriction, speed: float, mass: float, applied: Applied, step: float
) -> tuple[float, float]:
    """The largest friction force [N] in the step, and the force [N] that must push in its place.

    pymunk uses as much of the bound as would stop the part: with the static bound where the law
    holds it, and the law's mean where it brakes. Only in a step that turns back without a rest
    may the mean push on, which no bound can.
    """
    middle = applied(step / 2)
    force = _mean(friction, speed, mass, middle, applied, step)
    stopping = -(middle + mass * speed / step)
    static = friction.static.forward if stopping < 0 else friction.static.backward
    if abs(force - stopping) <= AT_REST * static:
        return static, 0.0
    within = 0 <= force <= stopping or stopping <= force <= 0
    return (abs(force), 0.0) if within else (0.0, force)


def mean_friction(
    friction: DryFriction, speed: float, mass: float, applied: Applied, step: float
) -> float:
    """The mean friction force [N] over the step, for what else acts in its middle or at its end.

    A part that stops goes on, or stays, by the force in the middle of the step.
    """
    return _mean(friction, speed, mass, applied(step / 2), applied, step)


def _mean(
    friction: DryFriction, speed: float, mass: float, middle: float, applied: Applied, step: float
) -> float:
    """Mean friction force [N] over the step, for a force in its middle that is known already."""
    holding = max(friction.static.forward, friction.static.backward)
    if abs(speed) * mass <= AT_REST * holding * step:
        return _from_rest(friction, middle, applied(step))
    brakes = dry_friction(friction, speed, middle)
    after = speed + (middle + brakes) * step / mass
    if friction.stribeck:  # it changes with the speed: that in the middle of the motion
        half = (speed + after) / 2 if after * speed > 0 else speed / 2
        brakes = dry_friction(friction, half, middle)
        after = speed + (middle + brakes) * step / mass
    if after * speed > 0:
        return brakes
    moving = mass * speed / (-(middle + brakes) * step)  # the share of the step before it stops
    beyond = dry_friction(friction, 0.0, middle)
    if beyond == -middle:
        return -middle - mass * speed / step  # it stops and stays
    return moving * brakes + (1 - moving) * beyond


def _from_rest(friction: DryFriction, middle: float, end: float) -> float:
    """The mean friction force [N] over a step that begins at rest.

    What else acts grows from 2 middle − end to `end`; it slips from where it passes the bound.

    Over the slipping share s of the step the mean of the force left over is
    s (static − kinetic) + s² |end − middle|.
    """
    if dry_friction(friction, 0.0, end) == -end:
        return -middle
    static, kinetic = _ahead(friction, end)
    grown = abs(end - middle)  # in half a step
    slipping = (abs(end) - static) / (2 * grown) if grown else 1.0
    if slipping >= 1:  # beyond the bound from the start
        return dry_friction(friction, 0.0, end)
    unbalanced = slipping * (static - kinetic) + slipping**2 * grown
    return -middle + (unbalanced if end > 0 else -unbalanced)


def _ahead(friction: DryFriction, applied: float) -> tuple[float, float]:
    """Static and first kinetic friction [N] of the direction in which it is pushed."""
    static, sense = friction.static, 1 if applied > 0 else -1
    return static.forward if applied > 0 else static.backward, braking(friction, sense, 0.0)


def smooth_mean(
    friction: DryFriction,
    smooth: Smooth,
    speed: float,
    mass: float,
    applied: float,
    step: float,
) -> float:
    """(2.95) by the implicit midpoint rule [N]: explicitly, A F h / m = 30 is unstable.

    The solution of m (v − v₀) = h (F_a + F_fr((v₀ + v)/2, F_a)) nearest to the present speed.
    """
    force = smooth_under(friction, smooth, applied)

    def left(mean: float) -> float:
        return 2 * mass * (mean - speed) - step * (applied + force(mean))

    return force(_root(left, speed, slope=2 * mass, close=1e-9 * smooth.band))


def _root(residual: Callable[[float], float], near: float, *, slope: float, close: float) -> float:
    """A zero of `left`, which is negative far below and positive far above, beside `near`.

    Illinois' regula falsi needs no derivative and never leaves the bracket; the bracket ends a
    little beyond where `left` would be zero if it only had that slope.
    """
    here = residual(near)
    reach = -1.001 * here / slope
    far = near + reach
    while (there := residual(far)) * here > 0:
        near, here, reach = far, there, 2 * reach
        far += reach
    while here and there and abs(far - near) > close:
        middle = (near * there - far * here) / (there - here)
        now = residual(middle)
        if now * there < 0:
            near, here = far, there
        else:
            here /= 2
        far, there = middle, now
    return near if not here else far
