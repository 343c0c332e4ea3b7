"""All that is done before every step: forces that pymunk has to be told, friction, circles."""

from collections.abc import Callable

from ..contact import Tip, follower, is_tip, steers
from ..drive import tells as turned
from ..edge import driver
from ..force import tells
from ..pair import pair_followers
from ..world import World
from .friction import laws

Apply = Callable[[float], None]  # at time t [s]


def forces(world: World, step: float, *, midpoint: bool, law: bool, reflects: bool) -> list[Apply]:
    """What has to be called before each step; law: whether friction is ours too.

    reflects: whether a point stays on the floor as `follower` says.
    """
    friction = laws(world, step) if law else []
    told = [*turned(world, step, midpoint=midpoint), *tells(world, step, midpoint=midpoint)]
    told += [*friction, *_followers(world, step, reflects)]
    walks = [steers(world.stride, world.wheels, world.place)] if world.stride else []
    return [*told, *walks, *driver(world, step)]  # which has to know what has been told


def _followers(world: World, step: float, reflects: bool) -> list[Apply]:
    scene = world.scene
    tips: dict[str, list[Tip]] = {}
    for contact in scene.touching.values():
        if is_tip(scene, contact):
            tip = Tip(contact, scene.bodies[contact.body], world.wheels[contact.name])
            tips.setdefault(contact.body, []).append(tip)
    found = [
        follower(world.bodies[body], those, step, reflects=reflects) for body, those in tips.items()
    ]
    return [*found, *pair_followers(world, step, reflects=reflects)]
