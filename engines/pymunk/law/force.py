"""All that is done before every step: forces that pymunk has to be told, friction, circles."""

from collections.abc import Callable

from ..contact import follower
from ..force import tells
from ..world import World
from .friction import laws

Apply = Callable[[float], None]  # at time t [s]


def forces(world: World, step: float, *, midpoint: bool, law: bool) -> list[Apply]:
    """What has to be called before each step; law: whether friction is ours too."""
    friction = laws(world, step) if law else []
    return [*tells(world, step, midpoint=midpoint), *friction, *_followers(world, step)]


def _followers(world: World, step: float) -> list[Apply]:
    scene = world.scene
    contacts = scene.contacts.values()
    found = [follower(c, scene.bodies[c.body], world.wheels[c.name], step) for c in contacts]
    return [follow for follow in found if follow]
