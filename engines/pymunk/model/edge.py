"""Edges, which pymunk has no joint for: pin joints that our law lays anew before each step."""

from collections.abc import Callable, Iterator
from inspect import getsource

from pymunk.body import Body
from pymunk.constraints import PinJoint
from pymunk.vec2d import Vec2d

from ....cases.scene import Edge, Scene, Signal, Vector
from ...signal import in_time
from .chipmunk_state import State
from .number_text import written
from .pin import LENGTH, Pin, Way, laid
from .script_signals import as_text
from .world import World

NO_EDGE = "engine: pymunk has no joint across a line that turns with its own body"
_REST = Signal("constant", (0.0,))
_LAID = [
    "from pymunk import PinJoint",
    "",
    f"LENGTH = {LENGTH!r}",
    f"Way, State = {Way}, {State}",
    "",
    "",
    "def state(body: pymunk.Body) -> State:",
    "    rates = (*body.velocity, body.angular_velocity)",
    "    return (*body.position, body.angle, *rates)",
    "",
    "",
    *getsource(laid).splitlines(),
    "",
]


def rows(edge: Edge) -> Iterator[tuple[str, Vector, Signal]]:
    """Constraint rows of an edge: reaction, direction in body axes, law of the speed."""
    yield "force", edge.across, _REST
    if edge.speed is not None:
        yield "drive", edge.along, edge.speed


def count(scene: Scene) -> int:
    """How many pin joints its edges take."""
    return sum(len(list(rows(edge))) for edge in scene.constraints.values())


def add_edges(world: World) -> None:
    """The joints of all edges, in the order of the case file."""
    for edge in world.scene.constraints.values():
        body, place = world.body(edge.at), Vec2d(*world.local(edge.at))
        for name, way, law in rows(edge):
            far = body.local_to_world(place + LENGTH * Vec2d(*way))
            joint = PinJoint(body, world.space.static_body, place, far)
            joint.distance, joint.error_bias = LENGTH, 0.0
            world.pins[f"{edge.name}.{name}"] = Pin(joint, way, in_time(law))
            world.space.add(joint)


def joints_as_text(world: World, of: Callable[[Body], str]) -> Iterator[str]:
    """Lines of Python that build the edges' pin joints; `of` is how a body is called."""
    if not world.pins:
        return
    yield from ("", *_LAID, "pins, before = {}, {}")
    for name, pin in world.pins.items():
        joint = pin.joint
        yield ""
        yield f"pins[{name!r}] = joint = pymunk.PinJoint("
        yield f"    {of(joint.a)}, ground, {written(joint.anchor_a)}, {written(joint.anchor_b)},"
        yield ")"
        yield f"joint.distance, joint.error_bias = LENGTH, {joint.error_bias!r}"
        yield f"before[{name!r}] = state(joint.a)"
        yield "space.add(joint)"


def lays_as_text(world: World) -> Iterator[str]:
    """Lines of Python that lay the edges' pin joints before step n."""
    if world.pins:
        yield "    t = (n + 1) * h"
    for edge in world.scene.constraints.values():
        for field, way, law in rows(edge):
            name = f"{edge.name}.{field}"
            yield f"    joint = pins[{name!r}]"
            given = f"joint.anchor_a, {written(way)}, {as_text(law)[0]}, h, before[{name!r}]"
            yield "    now = state(joint.a)"
            yield f"    joint.anchor_b, _ = laid(now, {given})"
            yield f"    before[{name!r}] = now"


def lays(world: World, step: float) -> list[Callable[[float], None]]:
    """The function that lays the edges' pin joints before the step that starts at t [s], if any."""
    gravity = world.space.gravity

    def lay(t: float) -> None:
        for pin in world.pins.values():
            pin.lay(t, step, gravity)

    return [lay] if world.pins else []


def alone(scene: Scene, name: str) -> bool:
    """Whether the edge's body changes its momentum by the edge and by what pymunk is told."""
    body = scene.constraints[name].at.body
    ties = [*scene.joints.values(), *scene.springs(), *scene.dampers()]
    others = [edge for edge in scene.constraints.values() if edge.at.body == body]
    return len(others) == 1 and all(body not in (tie.a.body, tie.b.body) for tie in ties)
