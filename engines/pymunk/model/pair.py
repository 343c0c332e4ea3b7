"""Two bodies that touch, as shapes of pymunk that meet each other and nothing else.

A rim is a circle, a face a segment. A point is a circle above the point, as on a plane, but along
the normal of what it touches.
"""

import math
from collections.abc import Callable

from pymunk.body import Body
from pymunk.shape_filter import ShapeFilter
from pymunk.shapes import Circle, Segment
from pymunk.vec2d import Vec2d

from ....cases.scene import Scene, Vector
from ....cases.scene.pair import Pair
from ...engine import Start, begun
from .contact import FLOOR_ELASTICITY, FLOOR_FRICTION, TOUCHING, Follow, tip_radius
from .world import World

MOST = 32  # bits of a category: one for each plane and pair


def add_pairs(world: World, first: int) -> None:
    """Two shapes for each pair, with a category of their own; the planes have those below first."""
    for i, pair in enumerate(world.scene.pairs.values(), first):
        bits = ShapeFilter(categories=1 << i, mask=1 << i)
        both = _touching(world, pair), _touched(world, pair)
        for shape in both:
            shape.filter = bits
        world.pairs[pair.name] = both
        world.space.add(*both)


def _touching(world: World, pair: Pair) -> Circle:
    """It carries all of the friction, and of the restitution."""
    body, radius = world.bodies[pair.body], pair.radius(world.scene.bodies)
    circle = Circle(body, radius or tip_radius(world.scene))
    if not radius:
        circle.unsafe_set_offset(circle_centre(world, pair, 0.0))
    circle.friction, circle.elasticity = pair.friction, pair.restitution
    return circle


def _touched(world: World, pair: Pair) -> Circle | Segment:
    body, scene = world.bodies[pair.touched], world.scene
    shape: Circle | Segment
    if pair.face is None:
        shape = Circle(body, pair.reach(scene.bodies))
    else:
        first, last = (scene.bodies[pair.touched].points[end] for end in pair.side.ends)
        shape = Segment(body, first, last, 0.0)
    shape.friction, shape.elasticity = FLOOR_FRICTION, FLOOR_ELASTICITY
    return shape


def circle_centre(world: World, pair: Pair, ahead: float) -> Vector:
    """The circle's centre over the point, in its body's axes, so long [s] after now."""
    body, other = _bodies(world, pair)
    turned = body.angle + ahead * body.angular_velocity
    point = Vec2d(*world.local(pair.at))
    if pair.face:
        turns = other.angle + ahead * other.angular_velocity
        normal = Vec2d(*pair.side.normal).rotated(turns)
    else:
        apart = body.position - other.position + ahead * (body.velocity - other.velocity)
        normal = (apart + point.rotated(turned)).normalized()
    return point + normal.rotated(-turned) * tip_radius(world.scene)


def pair_followers(world: World, step: float, *, reflects: bool) -> list[Follow]:
    """Before each step keep the circles over their points, and, as `contact.follower` has it, what
    stays in contact has elasticity 1: one rim's path around another, too, is curved.
    """
    follows: list[Follow] = []
    for pair in world.scene.pairs.values():
        if not pair.radius(world.scene.bodies):
            follows.append(_over(world, pair, step))
        if reflects:
            follows.append(_reflecting(world, pair))
    return follows


def _over(world: World, pair: Pair, step: float) -> Follow:
    circle = world.pairs[pair.name][0]

    def follow(t: float) -> None:
        circle.unsafe_set_offset(circle_centre(world, pair, step))

    return follow


def _reflecting(world: World, pair: Pair) -> Follow:
    circle, gap = world.pairs[pair.name][0], _gap(world, pair)
    ungrown = pair.radius(world.scene.bodies) or tip_radius(world.scene)
    now = pair.restitution

    def follow(t: float) -> None:
        nonlocal now
        wanted = 1.0 if gap() < circle.radius - ungrown else pair.restitution
        if now != wanted:
            circle.elasticity = now = wanted

    return follow


def _gap(world: World, pair: Pair) -> Callable[[], float]:
    """Between both [m], as pymunk has them."""
    body, other = _bodies(world, pair)
    both = pair.radius(world.scene.bodies) + pair.reach(world.scene.bodies)
    point = world.local(pair.at)
    if pair.face is None:
        return lambda: (body.local_to_world(point) - other.position).length - both
    (nx, ny), corner = pair.side.normal, world.local(pair.corner)
    level = nx * corner[0] + ny * corner[1] + both

    def gap() -> float:
        x, y = other.world_to_local(body.local_to_world(point))
        return nx * x + ny * y - level

    return gap


def _bodies(world: World, pair: Pair) -> tuple[Body, Body]:
    return world.bodies[pair.body], world.bodies[pair.touched]


def closed_pairs(scene: Scene, start: Start) -> list[Pair]:
    """The pairs that touch at the start, and are not about to part."""
    motion = begun(scene, start)
    lines = []
    for pair in scene.pairs.values():
        gap, parting = pair.normal_and_gap(motion)[1][0], pair.slip_and_gap_rate(motion)[1][0]
        fastest = max(math.hypot(*start[name][3:5]) for name in (pair.body, pair.touched))
        if abs(gap) <= TOUCHING and parting <= TOUCHING * fastest:
            lines.append(pair)
    return lines


def press(world: World, pair: Pair, depth: float) -> None:
    """Starts the pair `depth` m in contact: the circle that touches grows."""
    circle = world.pairs[pair.name][0]
    circle.unsafe_set_radius(circle.radius + depth)
