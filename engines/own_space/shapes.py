"""Shapes of a Space: outlines, and for each two that may collide the contacts that say so.

What moves touches with its rim, if it is one circle about its centre of mass, or with the corners
of its polygons and the ends of its segments, where they are sharp. It touches a static line, on the
side on which it starts, or that side of a static polygon, or of a box that moves, before which it
starts. In a case file static lines have no ends, and nothing touches in another way: `meeting` sees
in the motion whether that is enough.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, pairwise
from math import hypot, pi

from pymunk.body import Body
from pymunk.shape_filter import ShapeFilter
from pymunk.shapes import Circle, Poly, Segment, Shape
from pymunk.space import Space
from pymunk.vec2d import Vec2d

from ...cases.scene import GROUND
from ...cases.scene.pair import FACES
from ...cases.scene.shape import CORNERS
from .reading import Reading, Words, travels, turns

ALIKE = 1e-9  # of a length or a moment: what rounding leaves of a difference


@dataclass(frozen=True, eq=False)
class Outline:
    """A shape: corners in its body's axes from the centre of mass, as far around as the radius.

    place: in the Space; body: its name, or None on the ground, where corners are in ground axes.
    """

    place: str
    name: str
    shape: Shape
    body: str | None
    corners: tuple[Vec2d, ...]
    radius: float


@dataclass(frozen=True)
class Side:
    """A straight side of an outline: from where to where, and its outward normal, as placed."""

    begins: Vec2d
    ends: Vec2d
    normal: Vec2d


@dataclass(frozen=True, eq=False)
class Touch:
    """The contacts of two outlines, and their planes: by their names, in the words of a case file.

    side: where it is at the start, on which they are; None: a rim.
    """

    first: Outline
    second: Outline
    contacts: Words
    planes: Words
    side: Side | None


def outlines(reading: Reading) -> list[Outline]:
    """Returns the shapes that can collide; those that cannot be read are refused."""
    readable = list[Outline]()
    for k, shape in enumerate(reading.space.shapes):
        place, body = f"space.shapes[{k}]: {type(shape).__name__}", shape.body
        if shape.sensor:
            continue  # it meets nothing, and tells only handlers
        if body is None or (body not in reading.names and body.body_type == Body.DYNAMIC):
            reading.refuse(place, "has no body in the space")
            continue
        if shape.surface_velocity.length:
            reading.refuse(place, "has a surface_velocity, which has no word")
        if body not in reading.names and travels(body):
            reading.refuse(place, "moves with its body, and no plane of a case file does")
        corners = _corners(shape)
        name = reading.names.get(body)
        if name is None:
            corners = [body.local_to_world(corner) for corner in corners]
        else:
            corners = [corner - body.center_of_gravity for corner in corners]
        readable.append(
            Outline(place, f"shape{k}", shape, name, (*corners,), getattr(shape, "radius", 0.0))
        )
    return readable


def _corners(shape: Shape) -> list[Vec2d]:
    if isinstance(shape, Circle):
        return [shape.offset]
    if isinstance(shape, Segment):
        return [shape.a, shape.b]
    assert isinstance(shape, Poly)
    return shape.get_vertices()


def collisions(known: Sequence[Outline], space: Space) -> list[tuple[Outline, Outline]]:
    """Returns each pair that pymunk lets collide, with a body of the scene first.

    As `cpSpaceStep` asks: not of one body, nor of two whose filters or joints forbid it.
    """
    exempt = [{c.a, c.b} for c in space.constraints if not c.collide_bodies]
    return [
        (first, second) if first.body else (second, first)
        for first, second in combinations(known, 2)
        if first.body != second.body and {first.shape.body, second.shape.body} not in exempt
        if _may_collide(first.shape.filter, second.shape.filter)
    ]


def _may_collide(a: ShapeFilter, b: ShapeFilter) -> bool:
    in_one_group = a.group != 0 and a.group == b.group
    return not in_one_group and bool(a.categories & b.mask) and bool(b.categories & a.mask)


def body_shapes(reading: Reading, known: Sequence[Outline]) -> Words:
    """Returns the bodies in words: a disk, a block, a particle, or any rigid body with points."""
    return {
        name: _body_words(body, [o for o in known if o.body == name], reading.own_points[name])
        for body, name in reading.names.items()
    }


def _body_words(body: Body, own: list[Outline], points: Words) -> Words:
    rest = {"points": points} if points else {}
    if not turns(body):
        return {"particle": {"mass": body.mass}}
    if radius := _rim(own):
        if _alike(body.moment, body.mass * radius**2 / 2):
            return {"disk": {"mass": body.mass, "radius": radius}, **rest}
        return {"rigid": {"mass": body.mass, "inertia": body.moment, "radius": radius}, **rest}
    if size := _box(own, body):
        return {"block": {"mass": body.mass, "width": size[0], "height": size[1]}, **rest}
    return {"rigid": {"mass": body.mass, "inertia": body.moment}, **rest}


def _alike(a: float, b: float) -> bool:
    return abs(a - b) <= ALIKE * abs(b)


def _rim(own: list[Outline]) -> float:
    """The radius of a body that is one circle about its centre of mass, else 0."""
    round_ = len(own) == 1 and len(own[0].corners) == 1
    return own[0].radius if round_ and own[0].corners[0].length <= ALIKE * own[0].radius else 0.0


def _box(own: list[Outline], body: Body) -> tuple[float, float] | None:
    """The width and height of what is one sharp box along its axes, with a box's moment."""
    if len(own) != 1 or len(own[0].corners) != 4 or own[0].radius:
        return None
    (x, y), *_ = own[0].corners
    w, h = 2 * abs(x), 2 * abs(y)
    near = ALIKE * hypot(w, h)
    square = all(hypot(abs(a) - w / 2, abs(b) - h / 2) <= near for a, b in own[0].corners)
    return (w, h) if square and _alike(body.moment, body.mass * (w**2 + h**2) / 12) else None


def find_contacts(
    reading: Reading, known: Sequence[Outline], first: Outline, second: Outline
) -> Touch | None:
    """Returns the contacts of the two, of which the first moves; None where there is no word."""
    if second.body is None:
        return _on_ground(reading, known, first, second)
    both = [_on_body(reading, known, *pair) for pair in ((first, second), (second, first))]
    candidates = [touch for touch in both if touch]
    return max(candidates, key=_within_side, default=None)


def _on_body(
    reading: Reading, known: Sequence[Outline], first: Outline, second: Outline
) -> Touch | None:
    """The contacts with a moving body: its rim, or the side of a box that faces the first."""
    body = second.shape.body
    assert body is not None
    own = [outline for outline in known if outline.body == second.body]
    words, touched, side = _touch_points(reading, known, first), str(second.body), None
    if not (turns(body) and words):
        return None
    if _box(own, body):
        side = _facing_side(first, _sides(second))
        turned = side.normal.rotated(-body.angle)
        touched += f".{max(FACES, key=lambda face: turned.dot(FACES[face].normal))}"
    elif not (_rim(own) and len(words) == 1):
        return None
    contacts = {
        f"{first.name}_on_{second.name}{end}": _contact_words(first, second, word, touched)
        for word, end in words.items()
    }
    return Touch(first, second, contacts, {}, side)


def _within_side(touch: Touch) -> bool:
    """Whether the corner of the first nearest to the side is within the side's ends."""
    if touch.side is None:
        return True
    side, along = touch.side, touch.side.ends - touch.side.begins
    nearest = min(start_corners(touch.first), key=lambda c: (c - side.begins).dot(side.normal))
    return 0.0 <= (nearest - side.begins).dot(along) <= along.dot(along)


def _contact_words(first: Outline, second: Outline, touching: str, touched: str) -> Words:
    """The words of a contact; pymunk multiplies frictions and elasticities of two shapes."""
    return {
        "between": (touching, touched),
        "friction": first.shape.friction * second.shape.friction,
        "restitution": first.shape.elasticity * second.shape.elasticity,
    }


def _touch_points(reading: Reading, known: Sequence[Outline], outline: Outline) -> dict[str, str]:
    """Returns the points that touch, in words, each with the ending of its contact's name."""
    body, name = outline.shape.body, outline.body
    assert body is not None
    assert name is not None
    own = [other for other in known if other.body == name]
    if not turns(body):
        return {}
    if _rim(own):
        return {name: ""}
    if outline.radius or any(_rim([other]) for other in own):
        return {}
    boxed = _box(own, body) is not None
    endings: dict[str, str] = {}
    for k, (x, y) in enumerate(outline.corners):
        point = CORNERS[2 * (y > 0) + (x > 0)] if boxed else f"{outline.name}_{k}"
        if not boxed:
            reading.own_points[name][point] = (x, y)
        endings[f"{name}.{point}"] = f"_{point}" if boxed else f"_{k}"
    return endings


def _on_ground(
    reading: Reading, known: Sequence[Outline], first: Outline, second: Outline
) -> Touch | None:
    """The contacts with the ground, on planes; a body that cannot turn is a particle."""
    sides, body = _sides(second), first.shape.body
    assert body is not None
    if not sides:
        return None
    side = _facing_side(first, sides)
    plane, at, named = f"{second.name}_{sides.index(side)}", side.begins, first.name
    words = _touch_points(reading, known, first)
    if not turns(body):
        arms = [corner.rotated(body.angle).dot(side.normal) for corner in first.corners]
        at += (first.radius - min(arms)) * side.normal
        plane, words = f"{plane}_of_{first.name}", {str(first.body): ""}
    contacts = {
        f"{named}_on_{second.name}{end}": _contact_words(first, second, word, f"{GROUND}.{plane}")
        for word, end in words.items()
    }
    planes = {plane: {"at": tuple(at), "normal": tuple(side.normal)}}
    return Touch(first, second, contacts, planes, side) if contacts else None


def _sides(outline: Outline) -> list[Side]:
    """The straight sides of a segment or polygon at the start, of a segment both; of a circle none.

    pymunk has corners counter-clockwise.
    """
    corners = start_corners(outline)
    sides = list[Side]()
    for p, q in pairwise((*corners, corners[0])):
        normal = (q - p).normalized().rotated(-pi / 2)
        away = outline.radius * normal
        sides.append(Side(p + away, q + away, normal))
    return sides if len(corners) > 1 else []


def start_corners(outline: Outline) -> list[Vec2d]:
    """The corners of an outline at the start, in ground axes."""
    body = outline.shape.body
    if outline.body is None or body is None:
        return [*outline.corners]
    centre = body.local_to_world(body.center_of_gravity)
    return [centre + corner.rotated(body.angle) for corner in outline.corners]


def _facing_side(outline: Outline, sides: list[Side]) -> Side:
    """The side that faces the outline: the one with the largest clearance."""
    corners = start_corners(outline)
    return max(sides, key=lambda s: min((c - s.begins).dot(s.normal) for c in corners))
