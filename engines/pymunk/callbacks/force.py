"""pymunk's element for each force element, and what it has none for: one table, ELEMENTS.

A spring or a damper is a DampedSpring. What pymunk has no element for is told before every step
through its force input. pymunk drifts first, so a force set before a step acts at positions one
drift later. The midpoint protocol evaluates it there; else it is the force at the present place.
"""

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Any

from pymunk.body import Body
from pymunk.constraints import Constraint, DampedRotarySpring, DampedSpring

from ....cases.scene import Force, Limit, Scene
from ....cases.scene.forces.force import (
    Couple,
    Damper,
    Drag,
    LinearMuscle,
    Magnetic,
    Motor,
    Muscle,
    Push,
    Rope,
    Spring,
    Stops,
    Torque,
    Torsion,
    TorsionDamper,
    Viscous,
)
from ...engine import Realised, Start
from ...signal import acting, in_time
from ..model.chipmunk_state import State, pushing, reading, turning
from ..model.damping import not_alike, rate, slowing
from ..model.damping import numbers as damped_numbers
from ..model.limit import pressed, pulled, rope_joint, rope_numbers, stop_numbers, stops_joint
from ..model.number_text import written
from ..model.script_signals import as_text
from ..model.world import Held, World
from . import unilateral_spring as one_side
from .line_forces import Exerted, Load, drifted, midpoint_force, pull
from .point_forces import BY_LAW
from .turning import couple_as_text, motor, motor_load, twist, twisted
from .unilateral_spring import NO_SIDE

# A torque on a body, given to it before every step.


def torque(world: World, force: Torque, step: float, drift: float) -> Callable[[float], None]:
    """In the middle of the step, or at its start."""
    turn, turned = turning(world.bodies[force.body]), acting(force.signal, drift)
    return lambda t: turn(turned(t)[0])


def torque_load(world: World, force: Torque, name: str) -> Exerted:
    """The load of a torque on its body, as a function of the time."""
    turned = in_time(force.signal)
    return lambda t, drift, state: (0.0, 0.0, turned(t)[0])


def torque_script(
    world: World, force: Torque, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    """A line of Python."""
    (size,) = as_text(force.signal, midpoint=midpoint)
    yield f"    {of(world.bodies[force.body])}.torque += {size}"


# A torque between two bodies, given to both before every step.


def couple(world: World, force: Couple, step: float, drift: float) -> Callable[[float], None]:
    """Its torque in the middle of the step, or at its start."""
    first, second = (turning(body) for body in _both(world, force))
    torque = acting(force.signal, drift)

    def apply(t: float) -> None:
        (size,) = torque(t)
        first(-size)
        second(size)

    return apply


def couple_load(world: World, force: Couple, name: str) -> Exerted:
    """The load of a couple on the body `name`, one of its two, as a function of the time."""
    way = 1.0 if name == force.second else -1.0
    torque = in_time(force.signal)
    return lambda t, drift, state: (0.0, 0.0, way * torque(t)[0])


def couple_script(
    world: World, force: Couple, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    """Lines of Python."""
    (torque,) = as_text(force.signal, midpoint=midpoint)
    for body, sign in zip(_both(world, force), "-+", strict=True):
        yield f"    {of(body)}.torque {sign}= {torque}"


def _both(world: World, force: Couple) -> tuple[Body, Body]:
    return world.bodies[force.first], world.bodies[force.second]


Apply = Callable[[float], None]
"""Called before the step that starts at t [s]."""


@dataclass(frozen=True)
class Element:
    """One kind of force, as pymunk has it or is told; called with the world and the force element.

    line: the numbers of its DampedSpring, about a joint its DampedRotarySpring, and back: what the
    audit reads of one. by_length: its force [N] by that, if not as pymunk has it. tell: the force
    that is given before each step of `step` s, `drift` s ahead (0: at the present place); of what
    has a line too, only where we realise its law. load: what it exerts on a body, by the body's
    name. script: the same as lines of Python. lacks: why pymunk has none, so that our law tells it.
    """

    load: Callable[[World, Any, str], Exerted] = lambda world, force, name: _nothing
    line: Callable[[Any], dict[str, float]] | None = None
    numbers: Callable[[Any], dict[str, float]] = lambda line: {}
    by_length: Callable[[Any], Callable[[Any, float], float] | None] = lambda force: None
    tell: Callable[[World, Any, float, float], Apply] | None = None
    script: Callable[[World, Any, Callable[[Body], str], bool], Iterator[str]] | None = None
    lacks: str = ""
    limit: "Limited | None" = None


@dataclass(frozen=True)
class Limited:
    """A limit as a joint of pymunk's, none of which throws back what strikes it.

    called: the joint's name in words. numbers: for the audit. impulse: of its last step at one of
    the limit's sides [N s, N m s].
    """

    called: str
    joint: Callable[[World, Any], Constraint]
    numbers: Callable[[Any, Any], dict[str, float]]
    impulse: Callable[[Any, str], float]


def limits(world: World) -> None:
    """Adds the limits' joints, in the order of the case file."""
    for limit in world.scene.limits():
        its = _limited(limit)
        joint = its.joint(world, limit)
        world.limits[limit.name] = Held(joint, partial(its.impulse, joint))
        world.space.add(joint)


def throws_back(scene: Scene) -> str | None:
    """Why pymunk's joints cannot throw back as the scene's limits do; None if none of them does."""
    for limit in scene.limits():
        if limit.back:
            return (
                f"engine: pymunk's {_limited(limit).called} throws nothing back, and {limit.name} "
                f"has the restitution {limit.back:g}"
            )
    return None


def _limited(limit: Limit) -> Limited:
    limited = ELEMENTS[type(limit)].limit
    assert limited is not None, limit.word
    return limited


def damp(world: World, start: Start, realised: Realised) -> None:
    """Lets the space slow its bodies, where that is what slows them, beside what a setting says."""
    if realised == "native" and slowing(world.scene) and not not_alike(world.scene, start):
        world.space.damping *= math.exp(-rate(world.scene))
        world.slowed.update(force.name for force in slowing(world.scene))


def lines(world: World, realised: Realised) -> None:
    """Adds the lines that pymunk realises itself, in the order of the case file."""
    for force in world.scene.forces.values():
        element = ELEMENTS[type(force)]
        if element.line is None or (realised != "native" and element.tell):
            continue
        a, b = world.scene.ends(force)
        bodies, places = (world.body(a), world.body(b)), (world.local(a), world.local(b))
        if force.about is None:
            line = DampedSpring(*bodies, *places, **_LINE | element.line(force))
            if by_length := element.by_length(force):
                line.force_func = by_length
        else:
            line = DampedRotarySpring(*bodies, **_TURN | element.line(force))
        world.lines[force.name] = line
        world.space.add(line)


_LINE = {"rest_length": 0.0, "stiffness": 0.0, "damping": 0.0}
_TURN = {"rest_angle": 0.0, "stiffness": 0.0, "damping": 0.0}


def damped(scene: Scene) -> bool:
    """Whether a damper is among the forces: pymunk's own act after the kick."""
    return any(force.numbers().get("damping") for force in scene.forces.values())


def tells(world: World, step: float, *, midpoint: bool) -> list[Apply]:
    """The functions to call before each step, for all forces that pymunk has no object for."""
    drift = step if midpoint else 0.0
    return [
        tell(world, force, step, drift)
        for force in world.scene.forces.values()
        if force.name not in {*world.lines, *world.slowed}
        if (tell := ELEMENTS[type(force)].tell)
    ]


def numbers(world: World) -> dict[str, float]:
    """The numbers of pymunk's lines and limits, as `Force.numbers` names them."""
    held = {
        f"{limit.name}.{key}": number
        for limit in world.scene.limits()
        for key, number in _limited(limit).numbers(world.limits[limit.name].joint, limit).items()
    }
    held |= damped_numbers(world.scene, world.space.damping) if world.slowed else {}
    return held | {
        f"{name}.{key}": number
        for name, line in world.lines.items()
        for key, number in ELEMENTS[type(world.scene.forces[name])].numbers(line).items()
    }


def load(world: World, name: str, step: float) -> Callable[[float, float, State], Load]:
    """The load of all forces and gravity on a body, at t + ahead as seen between steps at t.

    By the body's state at t, with positions of the midpoint protocol, h/2 behind.
    """
    body, (gx, gy) = world.bodies[name], world.space.gravity
    scene = world.scene
    forces = [f for f in scene.forces.values() if name in {p.body for p in scene.ends(f)}]
    loads = [ELEMENTS[type(force)].load(world, force, name) for force in forces]
    weight = body.mass * gx, body.mass * gy

    def acting(t: float, ahead: float, state: State) -> Load:
        (fx, fy), torque = weight, 0.0
        for exerted in loads:
            x, y, turn = exerted(t + ahead, ahead + step / 2, state)
            fx, fy, torque = fx + x, fy + y, torque + turn
        return fx, fy, torque

    return acting


def script(world: World, of: Callable[[Body], str], *, midpoint: bool) -> Iterator[str]:
    """Lines of Python that are run before each step; `of` is how a body is called."""
    lines = []
    for force in world.scene.forces.values():
        if (text := ELEMENTS[type(force)].script) and force.name not in world.lines:
            lines += [f"    # {force.name}", *text(world, force, of, midpoint)]
    if lines:
        yield f"    t = {'n * h + h / 2' if midpoint else 'n * h'}"
        yield from lines


def _push(world: World, force: Push, step: float, drift: float) -> Apply:
    body, (a, b) = world.body(force.at), world.local(force.at)
    pushed, read, push = acting(force.signal, drift), reading(body), pushing(body)

    def apply(t: float) -> None:
        x, y, angle, _, _, omega = read()
        angle += drift * omega
        cos, sin = math.cos(angle), math.sin(angle)
        fx, fy = pushed(t)
        push((fx, fy), (x + (cos * a - sin * b), y + (sin * a + cos * b)))

    def central(t: float) -> None:  # as most are: turning does not move a centre
        x, y, *_ = read()
        fx, fy = pushed(t)
        push((fx, fy), (x, y))

    return apply if a or b else central


def _push_load(world: World, force: Push, name: str) -> Exerted:
    place, pushed = drifted(*world.local(force.at)), in_time(force.signal)

    def exerted(t: float, drift: float, state: State) -> Load:
        fx, fy = pushed(t)
        (rx, ry), *_ = place(state, drift)
        return fx, fy, rx * fy - ry * fx

    return exerted


def _push_script(
    world: World, force: Push, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    yield f"    body = {of(world.body(force.at))}"
    place = "body.position"
    if any(world.local(force.at)):
        turn = "body.angle + h * body.angular_velocity" if midpoint else "body.angle"
        yield f"    lever = pymunk.Vec2d{written(world.local(force.at))}.rotated({turn})"
        place += " + lever"
    pair = ", ".join(as_text(force.signal, midpoint=midpoint))
    yield f"    body.apply_force_at_world_point(({pair}), {place})"


def _motor_script(
    world: World, force: Motor, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    yield from couple_as_text(world, force, of, as_text(force.signal, midpoint=midpoint)[0])


def _nothing(t: float, drift: float, state: State) -> Load:
    return 0.0, 0.0, 0.0


def _named(*names: str) -> dict[str, Any]:
    """A line whose numbers have the names of the noun's."""

    def same(of: Any) -> dict[str, float]:
        return {name: getattr(of, name) for name in names}

    return {"line": same, "numbers": same}


ELEMENTS: dict[type[Force], Element] = {
    Spring: Element(
        load=pull,
        line=_named("rest_length", "stiffness")["line"],
        numbers=one_side.numbers,
        by_length=one_side.pushed,
    ),
    Damper: Element(
        load=pull, **_named("damping"),
        tell=lambda world, damper, step, drift: midpoint_force(world, damper, step),
    ),
    Push: Element(load=_push_load, tell=_push, script=_push_script),
    Torque: Element(load=torque_load, tell=torque, script=torque_script),
    Couple: Element(load=couple_load, tell=couple, script=couple_script),
    Torsion: Element(
        load=twist,
        # pymunk counts the first body's angle against the second's
        line=lambda torsion: {"rest_angle": -torsion.rest_angle, "stiffness": torsion.stiffness},
        numbers=lambda line: {"stiffness": line.stiffness, "rest_angle": -line.rest_angle},
    ),
    TorsionDamper: Element(
        load=twist, **_named("damping"),
        tell=lambda world, damper, step, drift: twisted(world, damper, step),
    ),
    Motor: Element(load=motor_load, tell=motor, script=_motor_script),
    Drag: Element(**BY_LAW),  # or the space's damping
    Viscous: Element(**BY_LAW),
    Magnetic: Element(**BY_LAW, lacks="engine: pymunk has no force of a magnetic field"),
    Muscle: Element(**BY_LAW, lacks="engine: pymunk has no muscle"),
    LinearMuscle: Element(**BY_LAW, lacks="engine: pymunk has no muscle"),
    Rope: Element(limit=Limited("slide joint", rope_joint, rope_numbers, pulled)),
    Stops: Element(limit=Limited("rotary limit", stops_joint, stop_numbers, pressed)),
}  # fmt: skip


# Forces of a scene that pymunk has no element for.


def lacking(scene: Scene, start: Start) -> list[tuple[Force, str]]:
    """The forces that pymunk has no element for, and why: our laws tell it them."""
    elements = ((force, ELEMENTS[type(force)].lacks) for force in scene.forces.values())
    one_sided = ((spring, NO_SIDE) for spring in scene.one_sided())
    slowed: list[tuple[Force, str]] = []
    if unlike := not_alike(scene, start):
        first, why = unlike  # and with it all of them: the space has one damping
        forces = sorted(slowing(scene), key=lambda force: force.name != first)
        slowed = [(scene.forces[force.name], why) for force in forces]
    return [*slowed, *((force, why) for force, why in elements if why), *one_sided]
