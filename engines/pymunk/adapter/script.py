"""A scene as a stand-alone Python script, written from the very objects that would be stepped."""

from collections.abc import Callable, Iterable, Iterator, Mapping
from functools import partial
from inspect import getsource
from typing import Any

from pymunk.body import Body
from pymunk.constraints import (
    Constraint,
    DampedRotarySpring,
    DampedSpring,
    GearJoint,
    GrooveJoint,
    PinJoint,
    PivotJoint,
    RotaryLimitJoint,
    SimpleMotor,
    SlideJoint,
)
from pymunk.shapes import Circle, Segment

from ....cases.scene import Anchor, Scene
from ....cases.scene.pair import Pair
from ....cases.scene.plane import LEVEL, Plane
from ...engine import Start
from ..callbacks.force import script
from ..callbacks.unilateral_spring import as_text
from ..model.contact import ABOVE, GROUP, closed, is_tip
from ..model.drive import as_lines
from ..model.edge import joints_as_text, lays_as_text
from ..model.number_text import written
from ..model.pair import closed_pairs
from ..model.script_signals import helpers
from ..model.slot import LENGTH, carried
from ..model.world import World
from ..stepping.run import COLD
from ..stepping.scene import build

_ARGUMENTS: dict[type[Constraint], tuple[str, ...]] = {
    PivotJoint: ("anchor_a", "anchor_b"),
    GrooveJoint: ("groove_a", "groove_b", "anchor_b"),
    PinJoint: ("anchor_a", "anchor_b"),
    GearJoint: ("phase", "ratio"),
    SimpleMotor: ("rate",),
    DampedRotarySpring: ("rest_angle", "stiffness", "damping"),
    RotaryLimitJoint: ("min", "max"),
    SlideJoint: ("anchor_a", "anchor_b", "min", "max"),
    DampedSpring: ("anchor_a", "anchor_b", "rest_length", "stiffness", "damping"),
}
_CARRIED = [
    "from collections.abc import Callable",
    "",
    "from pymunk import Constraint, PinJoint, Space, Vec2d",
    "",
    f"LENGTH = {LENGTH!r}",
    "",
    "",
    *getsource(carried).splitlines(),
    "",
]
SHIFT = """
# pymunk drifts, then kicks: start h/2 back, so that forces act in the middle of a step.
for body in bodies.values():
    body.position -= h / 2 * body.velocity
    body.angle -= h / 2 * body.angular_velocity"""


def text(
    scene: Scene,
    start: Start,
    step: float,
    numbers: Mapping[str, Any],
    head: Iterable[str],
    duration: float,
) -> str:
    """The script: builds the scene, runs its duration [s], prints name x y angle vx vy omega.

    head: what the scene is, as comments.
    """
    world = build(scene, start, numbers, "native")
    midpoint = numbers.get("time.midpoint")
    position, angle = (" + h / 2 * body.velocity", " + h / 2 * body.angular_velocity")
    lines = [
        *(f"# {line}" for line in head),
        "import math",
        "",
        "import pymunk",
        "",
        f"h = {step!r}  # s",
        f"steps = {max(1, round(duration / step))}  # {duration:g} s",
        *building(world, start, numbers),
        "\nfor n in range(steps):",
        *_sweeps(world, numbers),
        *before_each(world, numbers),
        "    space.step(h)",
        "",
        "for name, body in bodies.items():",
        f"    x, y = body.position{position if midpoint else ''}",
        f"    angle = body.angle{angle if midpoint else ''}",
        "    print(name, x, y, angle, *body.velocity, body.angular_velocity)",
    ]
    return "\n".join(lines) + "\n"


def building(world: World, start: Start, numbers: Mapping[str, Any]) -> list[str]:
    """Lines that build `space`, `bodies` and `wheels`, where h is the step [s]."""
    of = partial(_of, world)
    lines = [
        "space = pymunk.Space()",
        f"space.gravity = {written(world.space.gravity)}",
        *_attributes(world, numbers),
        "ground = space.static_body",
        "bodies = {}",
        *(["joints = []  # all that hold bodies"] if _kept(world) else []),
        *(["limits = []  # ropes and stops, which give way"] if world.limits else []),
        *(["motors = {}"] if world.motors else []),
        *helpers(world.scene.laws()),
        *(["", *_CARRIED] if world.slots else []),
        *_bodies(world),
        *planes(world, of, reflects=bool(numbers.get("contact.reflects"))),
        *shapes(world, of),
        *_constraints(world, numbers),
        *joints_as_text(world, of),
    ]
    midpoint, seed = numbers.get("time.midpoint"), numbers.get("start.seed")
    if world.stride:
        lines.append(f"meets = {world.stride.meets!r}  # the feet that the floor meets")
    if seed:
        lines += seeds(world, start, seed)
    return lines + ([SHIFT] if midpoint else [])


def _attributes(world: World, numbers: Mapping[str, Any]) -> Iterator[str]:
    """The setting's numbers of the space, and its damping where that is a force of the scene."""
    slowed = {"space.damping": world.space.damping} if world.slowed else {}
    for name, value in {**numbers, **slowed}.items():
        if name.startswith("space."):
            yield f"{name} = {written(value)}"


def before_each(world: World, numbers: Mapping[str, Any]) -> list[str]:
    """Indented lines that are run before step n."""
    midpoint = bool(numbers.get("time.midpoint"))
    lines = script(world, lambda body: _of(world, body), midpoint=midpoint)
    turned = as_lines(world, midpoint=midpoint)
    of = partial(_of, world)
    circles = [*followers(world, of, numbers), *followed(world, of, numbers)]
    return [*lines, *turned, *circles, *feet(world, of), *lays_as_text(world)]


def _sweeps(world: World, numbers: Mapping[str, Any]) -> Iterator[str]:
    cold, usual = numbers.get("start.iterations"), world.space.iterations
    if cold and cold != usual:
        yield f"    space.iterations = {cold} if n < {COLD} else {usual}"


def seeds(world: World, start: Start, seed: float) -> list[str]:
    """Lines that let what only touches do so a little deeper."""
    if world.plain:
        return ["", f"shape.unsafe_set_radius(shape.radius + {seed!r})  # or it falls for one step"]
    lines = ["", "# a circle that only touches would fall freely for one step"]
    for contact in closed(world.scene, start):
        body, wheel = _of(world, world.wheel(contact.name)), world.wheels[contact.name]
        if world.scene.bodies[contact.body].radius is not None:
            nx, ny = contact.plane.normal
            lines.append(f"{body}.position -= ({seed * nx!r}, {seed * ny!r})")
        else:
            lines.append(f"wheels[{contact.name!r}].unsafe_set_radius({wheel.radius + seed!r})")
    lines += pair_seeds(world, start, seed)
    return lines if len(lines) > 2 else []


def _of(world: World, body: Body) -> str:
    """How the script calls a body."""
    names = {id(b): name for name, b in _all(world).items()}
    return f"bodies[{names[id(body)]!r}]" if id(body) in names else "ground"


def _all(world: World) -> dict[str, Body]:
    """The bodies, and the driven points under names that no body has."""
    return world.bodies | {f"ground.{name}": body for name, body in world.driven.items()}


def _bodies(world: World) -> Iterator[str]:
    for name, body in _all(world).items():
        kind = "body_type=pymunk.Body.KINEMATIC"
        if body.body_type == Body.DYNAMIC:
            kind = f"{written(body.mass)}, {written(body.moment)}"
        yield ""
        yield f"bodies[{name!r}] = body = pymunk.Body({kind})"
        for attribute in ("position", "angle", "velocity", "angular_velocity"):
            yield f"body.{attribute} = {written(getattr(body, attribute))}"
        yield "space.add(body)"


def _kept(world: World) -> bool:
    """Whether a setting has joints to change."""
    return bool(world.joints or world.limits)


def _owners(world: World, name: str) -> tuple[str, ...]:
    """Whose numbers a joint has."""
    if name in world.limits:
        return "constraint", "limit"
    return ("constraint",) if name in world.joints else ()


def _constraints(world: World, numbers: Mapping[str, Any]) -> Iterator[str]:
    brakes = {name: (brake,) for name, brake in world.brakes.items()}
    named = {name: (*parts, *brakes.get(name, ())) for name, parts in world.joints.items()}
    named |= {name: (line,) for name, line in world.lines.items()}
    named |= {name: (limit.joint,) for name, limit in world.limits.items()}
    for name, parts in named.items():
        for part in parts:
            yield ""
            yield f"joint = pymunk.{type(part).__name__}(  # {name}"
            yield f"    {_of(world, part.a)}, {_of(world, part.b)},"
            arguments = (written(getattr(part, key)) for key in _ARGUMENTS[type(part)])
            yield f"    {', '.join(arguments)},"
            yield ")"
            yield from (as_text(s, "joint") for s in world.scene.one_sided() if s.name == name)
            if part in brakes.get(name, ()):
                yield "joint.max_bias = 0.0  # a friction joint corrects no position"
                yield f"joint.max_force = {part.max_force!r}"
                yield "space.add(joint)"
                continue
            for key, value in numbers.items():
                owner, _, attribute = key.partition(".")
                if owner in _owners(world, name):
                    yield f"joint.{attribute} = {written(value)}"
            lists = {"constraint": "joints", "limit": "limits"}
            yield from (f"{lists[owner]}.append(joint)" for owner in _owners(world, name))
            if part is world.motors.get(name):
                yield f"motors[{name!r}] = joint"
            if isinstance(part, PinJoint) and name in world.slots:
                cut = world.slots[name]
                yield f"joint.distance = {LENGTH!r}"
                point, along = (f"Vec2d{written(v)}" for v in (cut.point, cut.along))
                yield f"joint.pre_solve = carried({point}, {along})"
            yield "space.add(joint)"


# Two bodies that touch, as lines of the script; `of` is how a body is called there.


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
        bits = f"categories={touching.filter.categories}, mask={touching.filter.mask}"
        yield f"rim.filter = other.filter = pymunk.ShapeFilter({bits})"
        yield "space.add(rim, other)"


def pair_seeds(world: World, start: Start, seed: float) -> Iterator[str]:
    """Lines that let two bodies which touch at the start do so a little deeper."""
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
    """Lines that place the pair's circle where `above` finds it for the end of the step."""
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


# Contacts as lines of the script; `of` is how a body is called there.


def planes(world: World, of: Of, *, reflects: bool) -> Iterator[str]:
    """The planes, and the circles that touch them."""
    several = (len(world.planes) > 1 or bool(world.pairs)) and not world.plain
    for name, shape in world.planes.items():
        yield ""
        ends = f"{written(shape.a)}, {written(shape.b)}"
        yield f"plane = pymunk.Segment(ground, {ends}, 0.0)  # {name}"
        yield f"plane.friction = {shape.friction!r}"
        if reflects or world.plain or any(w.elasticity for w in world.wheels.values()):
            yield f"plane.elasticity = {shape.elasticity!r}"
        if several:
            yield f"plane.filter = pymunk.ShapeFilter(categories={shape.filter.categories})"
        yield "space.add(plane)"
    if world.plain:
        yield from _plain(world, of)
        return
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


def _plain(world: World, of: Of) -> Iterator[str]:
    """The one shape that a user has."""
    name, shape = next(iter(world.plain.items()))
    part = world.scene.bodies[world.scene.contacts[name].body]
    body = of(world.wheel(name))
    if isinstance(shape, Circle):
        yield f"shape = pymunk.Circle({body}, {shape.radius!r})"
    else:
        yield f"shape = pymunk.Poly.create_box({body}, {part.size!r})"
    yield "shape.friction = shape.elasticity = 1.0  # pymunk takes the product of both"
    yield "space.add(shape)"


def followers(world: World, of: Of, numbers: Mapping[str, Any]) -> Iterator[str]:
    """Keeps the circle of a turning body's point above it, see `follower`."""
    for contact in world.scene.touching.values():
        if world.plain or not is_tip(world.scene, contact):
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
