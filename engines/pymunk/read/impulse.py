"""The impulses of the last step, by the quantities that are wanted."""

import math
from collections.abc import Callable, Mapping, Sequence
from functools import partial

from pymunk.arbiter import Arbiter
from pymunk.body import Body
from pymunk.constraints import Constraint
from pymunk.shapes import Shape

from ....cases.scene import Scene, Vector
from ..model.world import World

Planes = dict[str, tuple[float, float]]


def impulses(world: World, reactions: tuple[str, ...]) -> Callable[[], list[float]]:
    """A function that reads them [N s]: a joint's size, an edge's, a plane's two.

    Of a step that was cut they are what its last part would give in a whole one.
    """
    parts = [quantity.rpartition(".") for quantity in reactions]
    joints = [_holding(world, name) for name, _, _ in parts]
    limits = [world.limits.get(name) for name, _, _ in parts]
    pins = [world.pins.get(quantity) for quantity in reactions]
    points = [_points(world.scene, name) for name, _, _ in parts]
    wanted = {name for names in points for name in names}
    bodies, pairs = _contacts(world, wanted), _pairs(world, wanted)
    felt: Planes = {}
    several = [
        *((body, _one if len(names) == 1 and not pairs else _several, names)
          for body, names in bodies.items()),
        *((body, _paired, names) for body, names in pairs.items()),
    ]  # fmt: skip
    reads: list[Callable[[], float]] = []
    for (name, _, what), joint, pin, limit, names in zip(
        parts, joints, pins, limits, points, strict=True
    ):
        if pin:
            reads.append(pin.impulse)
        elif limit:
            reads.append(partial(limit.impulse, what))
        elif joint:
            reads.append(partial(_size, joint))
        else:
            reads.append(partial(_along, *_way(world, name, what), names, felt))

    def read() -> list[float]:
        felt.clear()
        for body, how, names in several:
            body.each_arbiter(how, names, felt)
        row = [each() for each in reads]
        share = world.share[0]
        return row if share == 1.0 else [impulse / share for impulse in row]

    return read


def _size(joint: Sequence[Constraint]) -> float:
    return math.hypot(*[part.impulse for part in joint])


def _along(x: float, y: float, names: Sequence[str], felt: Planes) -> float:
    """The impulse [N s] along (x, y), in sum over the named contacts that are felt."""
    total = 0.0
    for name in names:
        if name in felt:
            along, up = felt[name]
            total += x * along + y * up
    return total


def _holding(world: World, name: str) -> list[Constraint]:
    """Constraints that exert a joint's force: in a slide one holds, one rubs across."""
    if name not in world.joints:
        return []
    rubs = name in world.brakes and world.scene.joints[name].shifts
    return [world.joints[name][0], *([world.brakes[name]] if rubs else [])]


def _points(scene: Scene, name: str) -> list[str]:
    """The names of what touches: of a contact each of its points, of a joint nothing."""
    if name in scene.pairs:
        return [name]
    return [c.name for c in scene.contacts[name].each()] if name in scene.contacts else []


def _way(world: World, name: str, what: str) -> Vector:
    """The direction in which a contact's force counts; a pair's is given in its own axes."""
    if name in world.scene.pairs:
        return (1.0, 0.0) if what == "tangent" else (0.0, 1.0)
    if name not in world.scene.contacts:
        return (0.0, 0.0)
    plane = world.scene.contacts[name].plane
    return plane.along if what == "tangent" else plane.normal


def _contacts(world: World, wanted: set[str]) -> Mapping[Body, Mapping[Shape, str]]:
    """The bodies with wanted contacts, each with all of its own."""
    by_body: dict[Body, dict[Shape, str]] = {}
    for name, shape in world.touching.items():
        by_body.setdefault(world.wheel(name), {})[shape] = name
    return {body: names for body, names in by_body.items() if wanted & set(names.values())}


def _pairs(world: World, wanted: set[str]) -> Mapping[Body, Mapping[Shape, str]]:
    """The bodies that touch others in wanted pairs, each with what touches."""
    names: dict[Body, dict[Shape, str]] = {}
    for name, (touching, _) in world.pairs.items():
        if name in wanted:
            names.setdefault(world.bodies[world.scene.pairs[name].body], {})[touching] = name
    return names


def _one(arbiter: Arbiter, names: Mapping[Shape, str], felt: Planes) -> None:
    """Its only contact: asking for the shapes would cost more than the impulse."""
    for name in names.values():
        felt[name] = arbiter.total_impulse


def _several(arbiter: Arbiter, names: Mapping[Shape, str], felt: Planes) -> None:
    for shape in arbiter.shapes:
        if shape in names:
            felt[names[shape]] = arbiter.total_impulse


def _paired(arbiter: Arbiter, names: Mapping[Shape, str], felt: Planes) -> None:
    """In the axes of the pair, whose normal points to what touches; pymunk's leads away from it."""
    for shape in arbiter.shapes:
        if shape in names:
            x, y = arbiter.total_impulse
            nx, ny = -arbiter.normal
            felt[names[shape]] = (x * ny - y * nx, x * nx + y * ny)
