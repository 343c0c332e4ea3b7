"""Two bodies that touch, as lines of the script; `of` is how a body is called there."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from pymunk.body import Body
from pymunk.shapes import Segment

from ...cases.scene.pair import Pair
from ..engine import Start
from .contact import ABOVE
from .pair import closed_pairs
from .world import World
from .written import written

Of = Callable[[Body], str]


def shapes(world: World, of: Of) -> Iterator[str]:
    """Both shapes of each pair: what touches stands in `pairs`."""
    if world.pairs:
        yield "pairs = {}"
    for name, (touching, touched) in world.pairs.items():
        pair = world.scene.pairs[name]
        at = f", {written(touching.offset)}" if any(touching.offset) else ""
        body, other = (of(world.bodies[b]) for b in (pair.body, pair.touched))
        yield f"pairs[{name!r}] = rim = pymunk.Circle({body}, {touching.radius!r}{at})"
        size = f"{touched.radius!r}"
        if isinstance(touched, Segment):
            size = f"{written(touched.a)}, {written(touched.b)}, 0.0"
        kind = type(touched).__name__
        yield f"other = pymunk.{kind}({other}, {size})  # {pair.on}"
        yield f"rim.friction, other.friction = {touching.friction!r}, {touched.friction!r}"
        both = f"{touching.elasticity!r}, {touched.elasticity!r}"
        yield f"rim.elasticity, other.elasticity = {both}"
        told = f"categories={touching.filter.categories}, mask={touching.filter.mask}"
        yield f"rim.filter = other.filter = pymunk.ShapeFilter({told})"
        yield "space.add(rim, other)"


def pair_seeds(world: World, start: Start, seed: float) -> Iterator[str]:
    """What touches at the start does so a little deeper."""
    for pair in closed_pairs(world.scene, start):
        grown = world.pairs[pair.name][0].radius + seed
        yield f"pairs[{pair.name!r}].unsafe_set_radius({grown!r})"


def followed(world: World, of: Of, numbers: Mapping[str, Any]) -> Iterator[str]:
    """Before each step, what `pair_followers` does."""
    for pair in world.scene.pairs.values():
        rim = f"pairs[{pair.name!r}]"
        body, other = of(world.bodies[pair.body]), of(world.bodies[pair.touched])
        radius = pair.radius(world.scene.bodies)
        if numbers.get("contact.reflects"):
            yield f"    apart = {_gap(world, pair, body, other)}"
            yield f"    stays = apart < {rim}.radius - {radius or ABOVE!r}"
            yield f"    {rim}.elasticity = 1.0 if stays else {pair.restitution!r}"
        if not radius:
            yield from _over(world, pair, body, other)


def _over(world: World, pair: Pair, body: str, other: str) -> Iterator[str]:
    """What `above` finds for the end of the step."""
    point = f"pymunk.Vec2d{written(world.local(pair.at))}"
    yield f"    turned = {body}.angle + h * {body}.angular_velocity"
    if pair.face:
        yield f"    normal = pymunk.Vec2d{written(pair.side.normal)}"
        yield f"    normal = normal.rotated({other}.angle + h * {other}.angular_velocity)"
    else:
        yield f"    apart = {body}.position - {other}.position"
        yield f"    apart += h * ({body}.velocity - {other}.velocity)"
        yield f"    normal = (apart + {point}.rotated(turned)).normalized()"
    offset = f"{point} + normal.rotated(-turned) * {ABOVE!r}"
    yield f"    pairs[{pair.name!r}].unsafe_set_offset({offset})"


def _gap(world: World, pair: Pair, body: str, other: str) -> str:
    both = pair.radius(world.scene.bodies) + pair.reach(world.scene.bodies)
    point = f"{body}.local_to_world({written(world.local(pair.at))})"
    if pair.face is None:
        return f"({point} - {other}.position).length - {both!r}"
    (nx, ny), corner = pair.side.normal, world.local(pair.corner)
    level = nx * corner[0] + ny * corner[1] + both
    return f"{other}.world_to_local({point}).dot({written(pair.side.normal)}) - {level!r}"
