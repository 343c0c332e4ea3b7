"""What touches, as lines of the script; `of` is how a body is called there."""

from collections.abc import Callable, Iterator, Mapping
from typing import Any

from pymunk.body import Body

from ...cases.scene import Anchor
from ...cases.scene.plane import LEVEL, Plane
from .contact import ABOVE, GROUP, is_tip
from .world import World
from .written import written

Of = Callable[[Body], str]


def planes(world: World, of: Of, *, reflects: bool) -> Iterator[str]:
    """The planes, and the circles that touch them."""
    several = len(world.planes) > 1 or bool(world.pairs)
    for name, shape in world.planes.items():
        yield ""
        ends = f"{written(shape.a)}, {written(shape.b)}"
        yield f"plane = pymunk.Segment(ground, {ends}, 0.0)  # {name}"
        yield f"plane.friction = {shape.friction!r}"
        if reflects or any(wheel.elasticity for wheel in world.wheels.values()):
            yield f"plane.elasticity = {shape.elasticity!r}"
        if several:
            yield f"plane.filter = pymunk.ShapeFilter(categories={shape.filter.categories})"
        yield "space.add(plane)"
    if world.planes:
        yield "wheels = {}"
    for name, wheel in world.wheels.items():
        size = f"{wheel.radius!r}, {written(wheel.offset)}" if any(wheel.offset) else wheel.radius
        yield f"wheels[{name!r}] = wheel = pymunk.Circle({of(world.wheel(name))}, {size})"
        yield f"wheel.friction = {wheel.friction!r}  # pymunk takes the product of both"
        if wheel.elasticity:
            yield f"wheel.elasticity = {wheel.elasticity!r}  # of these too"
        mask = f", mask={wheel.filter.mask}" if several else ""
        yield f"wheel.filter = pymunk.ShapeFilter(group={wheel.filter.group}{mask})"
        yield "space.add(wheel)"


def followers(world: World, of: Of, numbers: Mapping[str, Any]) -> Iterator[str]:
    """Keeps the circle of a turning body's point above it, see `follower`."""
    for contact in world.scene.touching.values():
        if not is_tip(world.scene, contact):
            continue
        body, (a, b) = of(world.wheel(contact.name)), world.local(contact.at)
        wheel = f"wheels[{contact.name!r}]"
        if numbers.get("contact.reflects"):
            yield f"    low = pymunk.Vec2d({a!r}, {b!r}).rotated({body}.angle)"
            yield f"    low = {_height(contact.plane, f'({body}.position + low)')}"
            yield f"    low -= {wheel}.radius - {ABOVE}"
            begins = "" if contact.ideal == "pivot" else "n > 0 and "
            yield f"    stays = {begins}low < 0"
            yield f"    {wheel}.elasticity = 1.0 if stays else {contact.restitution!r}"
        yield f"    turned = {body}.angle + h * {body}.angular_velocity"
        nx, ny = contact.plane.normal
        along = _sum(a, (ABOVE * nx, "math.cos(turned)"), (ABOVE * ny, "math.sin(turned)"))
        up = _sum(b, (ABOVE * ny, "math.cos(turned)"), (-ABOVE * nx, "math.sin(turned)"))
        offset = f"({along}, {up})"
        yield f"    {wheel}.unsafe_set_offset({offset})"


def _height(plane: Plane, place: str) -> str:
    """How far a place is above the plane."""
    if plane == LEVEL:
        return f"{place}.y"
    return f"({place} - {written(plane.at)}).dot({written(plane.normal)})"


def _sum(first: float, *terms: tuple[float, str]) -> str:
    """Without the terms that are nothing."""
    return " + ".join([repr(first), *(f"{size!r} * {what}" for size, what in terms if size)])


def feet(world: World, of: Of) -> Iterator[str]:
    """Lets the floor meet the feet that it has to, as `Stride.look` says."""
    if world.stride is None:
        return
    places = [
        f"({_point(world, of, foot.at)}, {name!r})" for name, foot in world.stride.feet.items()
    ]
    yield f"    behind, front = sorted([{', '.join(places)}])"
    yield f"    if front[0].x > behind[0].x + {world.stride.ahead!r}:"
    yield "        if front[0].y > 0:"
    yield "            meets[front[1]] = True"
    yield "        elif meets[front[1]]:"
    yield "            meets[behind[1]] = False"
    yield "    for name in meets:"
    yield "        mask = pymunk.ShapeFilter.ALL_MASKS() if meets[name] else 0"
    yield f"        wheels[name].filter = pymunk.ShapeFilter(group={GROUP}, mask=mask)"


def _point(world: World, of: Of, at: Anchor) -> str:
    return f"{of(world.body(at))}.local_to_world({written(world.local(at))})"
