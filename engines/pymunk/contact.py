"""What touches the floor, as pymunk's circles.

A point of a body (a particle, a bar's end) is a circle whose lowest point is the point: placed
above it before every step, at the angle after the drift, so that the floor finds the contact and
its lever arm exactly there. A circle about the point itself would touch with its rim, and a
tiny one falls through the floor at v h > r.
"""

import math
from collections.abc import Callable

from pymunk.body import Body
from pymunk.shape_filter import ShapeFilter
from pymunk.shapes import Circle

from ...cases.scene import Body as Part
from ...cases.scene import Contact, Scene, Vector
from ..engine import Start

FLOOR_FRICTION = 1.0  # pymunk multiplies the frictions of two shapes: the circle carries all of µ
FLOOR_ELASTICITY = 1.0  # likewise the restitution
ABOVE = 0.1  # m; it must only be more than a step's way: up to 10 m/s with a user's 10 ms
Follow = Callable[[float], None]  # before the step that starts at t [s]
TOUCHING = 1e-9  # m: a start that the assembly has found to 1e-12, and no visible height
_GROUP = ShapeFilter(group=1)  # circles touch the floor and not each other


def is_tip(scene: Scene, contact: Contact) -> bool:
    """Whether a point of a turning body touches, and no rim."""
    body = scene.bodies[contact.body]
    return body.turns and body.radius is None


def circle(contact: Contact, part: Part, body: Body) -> Circle:
    """The contact's shape: the disk itself, or the circle above the point."""
    if part.radius is None:
        shape = Circle(body, ABOVE, above(part.points[contact.at.point], body.angle))
    else:
        shape = Circle(body, part.radius)
    shape.friction = contact.friction
    shape.elasticity = contact.restitution
    shape.filter = _GROUP
    return shape


def above(point: Vector, angle: float) -> Vector:
    """The circle's centre in body axes, ABOVE m over the point in ground axes."""
    return (point[0] + math.sin(angle) * ABOVE, point[1] + math.cos(angle) * ABOVE)


def follower(
    contact: Contact, part: Part, shape: Circle, step: float, *, reflects: bool
) -> Follow | None:
    """Keeps the circle above the point of a body that turns.

    reflects: while it stays on the floor its elasticity is 1. A contact holds the velocity at the
    new place alone, J(n+½) v(n+1) = 0, and the point's curved path then lifts it a little in each
    step, until it opens and falls back. J(n+½) (v(n+1) + v(n)) = 0 leaves it on the floor.
    """
    body = shape.body
    if part.radius is not None or not part.turns or body is None:
        return None
    a, b = part.points[contact.at.point]
    impact = now = contact.restitution
    touched = False

    def follow(t: float) -> None:
        nonlocal now, touched
        angle = body.angle
        if reflects:
            # as pymunk found it in the step before; in the first step it strikes the floor
            low = body.position.y + math.sin(angle) * a + math.cos(angle) * b
            stays = touched and low < shape.radius - ABOVE
            touched = True
            if now != (1.0 if stays else impact):
                shape.elasticity = now = 1.0 if stays else impact
        turned = angle + step * body.angular_velocity
        sin, cos = math.sin(turned), math.cos(turned)
        shape.unsafe_set_offset((a + sin * ABOVE, b + cos * ABOVE))

    return follow


def closed(scene: Scene, start: Start) -> list[Contact]:
    """The contacts that touch at the start: as near to it as the book's scenes are assembled."""
    return [c for c in scene.contacts.values() if abs(_gap(scene, start, c)) <= TOUCHING]


def _gap(scene: Scene, start: Start, contact: Contact) -> float:
    """Height [m] of the point that touches."""
    part, (_, y, angle, *_) = scene.bodies[contact.body], start[contact.body]
    if part.radius is not None:
        return y - part.radius
    a, b = part.points[contact.at.point]
    return y + math.sin(angle) * a + math.cos(angle) * b


def sink(part: Part, shape: Circle, depth: float) -> None:
    """Starts the contact `depth` m in the floor; a point's circle grows, a disk is moved."""
    if part.radius is None:
        shape.unsafe_set_radius(ABOVE + depth)
    elif shape.body:
        shape.body.position -= (0.0, depth)
