"""The shape of one body as a user gives it: a `Poly` or a `Circle`, which every plane meets."""

from pymunk.shapes import Circle, Poly, Segment

from ....cases.scene import Body as Part
from .contact import FLOOR_ELASTICITY, FLOOR_FRICTION
from .world import World

SHAPES = "scene.shapes"  # a number of a setting, by which the scene is built with them


def add_plain_shapes(world: World) -> None:
    """The planes, and the body's shape; pymunk multiplies the frictions of two, and elasticities.

    So that two planes may differ, theirs are the contacts', and the shape has 1.
    """
    scene = world.scene
    for contact in scene.contacts.values():
        plane = contact.plane
        if plane.name in world.planes:
            continue
        (x, y), (ux, uy), far = plane.at, plane.along, world.reach
        ends = (x - far * ux, y - far * uy), (x + far * ux, y + far * uy)
        segment = Segment(world.space.static_body, *ends, 0.0)
        segment.friction, segment.elasticity = contact.friction, contact.restitution
        world.planes[plane.name] = segment
        world.space.add(segment)
    ((name, part),) = scene.bodies.items()
    shape = _shape(world, part, name)
    shape.friction, shape.elasticity = FLOOR_FRICTION, FLOOR_ELASTICITY
    world.plain.update(dict.fromkeys(scene.contacts, shape))
    world.space.add(shape)


def _shape(world: World, part: Part, name: str) -> Circle | Poly:
    if part.radius is not None:
        return Circle(world.bodies[name], part.radius)
    assert part.size is not None  # else it is unsuited
    return Poly.create_box(world.bodies[name], part.size)


def swell(world: World, seed: float) -> None:
    """Grows each shape that only touches by the seed [m], as the pasted lines do."""
    for shape in set(world.plain.values()):
        shape.unsafe_set_radius(shape.radius + seed)
