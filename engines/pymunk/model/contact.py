"""Contacts with a plane of the ground, as pymunk's circles.

A point of a body (a particle, a bar's end) is a circle whose lowest point is the point: placed
above it before every step, at the angle after the drift, so that the plane finds the contact and
its lever arm exactly there. A circle about the point itself would touch with its rim, and a
tiny one falls through the floor at v h > r.
"""

import math
from collections.abc import Callable, Mapping, Sequence

from pymunk.body import Body
from pymunk.shape_filter import ShapeFilter
from pymunk.shapes import Circle

from ....cases.scene import Contact, Scene, Vector
from ....cases.scene.plane import Plane
from ...engine import Start
from ...foot_contact import Place, Stride
from .chipmunk_state import reading

FLOOR_FRICTION = 1.0  # pymunk multiplies the frictions of two shapes: the circle carries all of µ
FLOOR_ELASTICITY = 1.0  # likewise the restitution
ABOVE = 0.1  # m; it must only be more than a step's way: up to 10 m/s with a user's 10 ms
FALLEN = 0.01  # s²: where g is of another unit of length, as pixels, a second's fall in 10 ms
Follow = Callable[[float], None]  # before the step that starts at t [s]
TOUCHING = 1e-9  # m: a start that the assembly has found to 1e-12, and no visible height
GROUP = 1  # of circles, which touch planes and not each other
PASSES = ShapeFilter(group=GROUP, mask=0)


def is_tip(scene: Scene, contact: Contact) -> bool:
    """Whether a point of a turning body touches, and no rim."""
    body = scene.bodies[contact.body]
    return body.turns and body.radius is None


def tip_radius(scene: Scene) -> float:
    """Returns the radius [m] of the circles above points."""
    return max(ABOVE, FALLEN * math.hypot(*scene.gravity))


def circle(scene: Scene, contact: Contact, body: Body) -> Circle:
    """The contact's shape: the disk itself, or the circle above the point."""
    part = scene.bodies[contact.body]
    if part.radius is None:
        normal, radius = contact.plane.normal, tip_radius(scene)
        point, turned = part.points[contact.at.point], (math.cos(body.angle), math.sin(body.angle))
        shape = Circle(body, radius, circle_centre(normal, point, *turned, radius))
    else:
        shape = Circle(body, part.radius)
    shape.friction = contact.friction
    shape.elasticity = contact.restitution
    shape.filter = ShapeFilter(group=GROUP)
    return shape


def planes(scene: Scene) -> dict[Plane, ShapeFilter]:
    """The planes that are touched, each with what its segment is told."""
    planes = list(dict.fromkeys(contact.plane for contact in scene.contacts.values()))
    if len(planes) < 2 and not scene.pairs:
        return dict.fromkeys(planes, ShapeFilter())
    return {plane: ShapeFilter(categories=1 << i) for i, plane in enumerate(planes)}


def only(shape: Circle, plane: ShapeFilter) -> None:
    """Lets the circle touch one plane of several: what stands over a point is no part of a body."""
    if plane != ShapeFilter():
        shape.filter = ShapeFilter(group=GROUP, mask=plane.categories)


def circle_centre(normal: Vector, point: Vector, cos: float, sin: float, radius: float) -> Vector:
    """The circle's centre by the normal in ground axes, and the angle's cosine and sine."""
    nx, ny = normal
    return (point[0] + (cos * nx + sin * ny) * radius, point[1] + (cos * ny - sin * nx) * radius)


class Tip:
    """A point of a turning body that touches, with its circle, as pymunk was told of it."""

    def __init__(self, scene: Scene, contact: Contact, shape: Circle) -> None:
        self._shape, self._impact, self._told = shape, contact.restitution, contact.restitution
        point = scene.bodies[contact.body].points[contact.at.point]
        self._place, self._radius = (*point, *contact.plane.normal), tip_radius(scene)
        self._level, self._depth = contact.plane.height(0.0, 0.0), shape.radius - self._radius
        # what already turns at the start stands on the floor; else it strikes in the first step
        self._touched = contact.ideal == "pivot"

    def set_elasticity(self, x: float, y: float, cos: float, sin: float) -> None:
        """By its body as it is now: whether it stays on the floor, as in the step before."""
        a, b, nx, ny = self._place
        low = self._level + nx * (x + cos * a - sin * b) + ny * (y + sin * a + cos * b)
        elasticity = 1.0 if self._touched and low < self._depth else self._impact
        self._touched = True
        if self._told != elasticity:
            self._shape.elasticity = self._told = elasticity

    def move_circle(self, cos: float, sin: float) -> None:
        """By its body's angle after the step: the circle stands over the point."""
        a, b, nx, ny = self._place
        self._shape.unsafe_set_offset(circle_centre((nx, ny), (a, b), cos, sin, self._radius))


def follower(body: Body, tips: Sequence[Tip], step: float, *, reflects: bool) -> Follow:
    """Keeps the circles above the points of a body that turns.

    reflects: while one stays on the floor its elasticity is 1. A contact holds the velocity at the
    new place alone, J(n+½) v(n+1) = 0, and the point's curved path then lifts it a little in each
    step, until it opens and falls back. J(n+½) (v(n+1) + v(n)) = 0 leaves it on the floor.
    """
    read = reading(body)

    def follow(t: float) -> None:
        x, y, angle, _, _, omega = read()
        if reflects:
            cos, sin = math.cos(angle), math.sin(angle)
            for tip in tips:
                tip.set_elasticity(x, y, cos, sin)
        turned = angle + step * omega
        cos, sin = math.cos(turned), math.sin(turned)
        for tip in tips:
            tip.move_circle(cos, sin)

    return follow


def steers(walks: Stride, shapes: Mapping[str, Circle], place: Place) -> Follow:
    """Before each step, lets the floor meet the feet that it has to, and no other."""

    meeting = {name: shapes[name].filter for name in walks.meets}

    def steer(t: float) -> None:
        walks.look(place)
        for name, meets in walks.meets.items():
            shapes[name].filter = meeting[name] if meets else PASSES

    return steer


def closed(scene: Scene, start: Start) -> list[Contact]:
    """The contacts that touch at the start, and are not about to rise from the floor.

    As near to it as the book's scenes are assembled.
    """
    touching = (c for c in scene.touching.values() if abs(_gap(scene, start, c)) <= TOUCHING)
    return [c for c in touching if _rising(scene, start, c) <= 0.0]


def _rising(scene: Scene, start: Start, contact: Contact) -> float:
    """How fast [m/s] the point that touches leaves its plane; rounding is no motion."""
    (nx, ny), (*_, angle, vx, vy, omega) = contact.plane.normal, start[contact.body]
    a, b = scene.bodies[contact.body].points[contact.at.point]
    cos, sin = math.cos(angle), math.sin(angle)
    rate = nx * (vx - omega * (sin * a + cos * b)) + ny * (vy + omega * (cos * a - sin * b))
    return rate if abs(rate) > TOUCHING * math.hypot(vx, vy) else 0.0


def _gap(scene: Scene, start: Start, contact: Contact) -> float:
    """Height [m] of the point that touches."""
    part, (x, y, angle, *_) = scene.bodies[contact.body], start[contact.body]
    a, b = part.points[contact.at.point]
    cos, sin = math.cos(angle), math.sin(angle)
    place = x + cos * a - sin * b, y + sin * a + cos * b
    return float(contact.plane.height(*place)) - (part.radius or 0.0)


def sink(scene: Scene, contact: Contact, shape: Circle, depth: float) -> None:
    """Starts the contact `depth` m in its plane; a point's circle grows, a disk is moved."""
    if scene.bodies[contact.body].radius is None:
        shape.unsafe_set_radius(tip_radius(scene) + depth)
    elif shape.body:
        nx, ny = contact.plane.normal
        shape.body.position -= (depth * nx, depth * ny)
