"""Stepping pymunk.

Midpoint protocol: pymunk moves bodies by h v first and then changes v. Every body is started
h/2 back along its velocity, so that the engine's positions belong to tₙ − h/2 when its
velocities belong to tₙ; positions are read h/2 ahead. Forces at positions then act at the
middle of a step, which makes the method time-symmetric, and of second order.
"""

from collections.abc import Callable, Mapping
from itertools import repeat
from typing import Any

from ....cases.scene import Scene
from ...engine import Realised, Start
from ..callbacks.cut import Strikes, cuts
from ..callbacks.force import tells
from ..callbacks.friction import laws
from ..model.contact import Tip, closed, follower, is_tip, sink, steers
from ..model.drive import tells as turned
from ..model.edge import lays
from ..model.pair import closed_pairs, pair_followers, press
from ..model.plain_shapes import swell
from ..model.world import World
from .scene import build

Steps = Callable[[int], None]
COLD = 5  # steps that begin without impulses worth keeping; measured: from the third on they are


def placed(
    scene: Scene, start: Start, step: float, numbers: Mapping[str, Any], realised: Realised
) -> World:
    """The world where a setting starts it: wheels seeded, bodies half a step back."""
    world = build(scene, start, numbers, realised)
    if world.plain:
        swell(world, numbers.get("start.seed", 0.0))
    for contact in () if world.plain else closed(scene, start):
        seed = numbers.get("start.seed", 0.0)
        sink(scene, contact, world.wheels[contact.name], seed)
    for pair in closed_pairs(scene, start):
        press(world, pair, numbers.get("start.seed", 0.0))
    if numbers.get("time.midpoint"):
        for body in (*world.bodies.values(), *world.driven.values()):
            body.position -= step / 2 * body.velocity
            body.angle -= step / 2 * body.angular_velocity
    return world


def stepper(
    world: World,
    step: float,
    numbers: Mapping[str, Any],
    realised: Realised,
    keep: Callable[[], None] | None = None,
) -> Steps:
    """A function that runs n steps, with the forces pymunk has to be told before each.

    keep: what is called after each.
    """
    space, usual = world.space, world.space.iterations
    cold, done = numbers.get("start.iterations", usual), 0
    between = _between(world, step, numbers, realised, keep)

    def run(n: int) -> None:
        nonlocal done
        first, done = done, done + n
        if first < COLD and cold != usual:
            middle = min(done, COLD)
            space.iterations = cold
            between(first, middle)
            space.iterations, first = usual, middle
        between(first, done)

    return run


def _between(
    world: World,
    step: float,
    numbers: Mapping[str, Any],
    realised: Realised,
    keep: Callable[[], None] | None,
) -> Callable[[int, int], None]:
    """A function that takes the steps from one number up to another."""
    if cuts(world.scene):
        return _cutting(Strikes(world, numbers.get("start.seed", 0.0)), step, keep)
    take, midpoint = world.space.step, bool(numbers.get("time.midpoint"))
    reflects = bool(numbers.get("contact.reflects"))
    applied = forces(world, step, midpoint=midpoint, law=realised != "native", reflects=reflects)

    def free(first: int, last: int) -> None:
        for _ in repeat(None, last - first):
            take(step)

    def forced(first: int, last: int) -> None:
        for i in range(first, last):
            t = i * step
            for apply in applied:
                apply(t)
            take(step)

    if keep is None:
        return forced if applied else free

    def kept(first: int, last: int) -> None:
        for i in range(first, last):
            t = i * step
            for apply in applied:
                apply(t)
            take(step)
            keep()

    def kept_free(first: int, last: int) -> None:
        for _ in repeat(None, last - first):
            take(step)
            keep()

    return kept if applied else kept_free


def _cutting(
    strikes: Strikes, step: float, keep: Callable[[], None] | None
) -> Callable[[int, int], None]:
    """A function that takes steps by our driver, which cuts a step where a foot strikes."""

    def cut(first: int, last: int) -> None:
        for _ in repeat(None, last - first):
            strikes.step(step)
            if keep is not None:
                keep()

    return cut


# The functions called before every step: forces that pymunk has to be told, friction, circles.


Apply = Callable[[float], None]  # at time t [s]


def forces(world: World, step: float, *, midpoint: bool, law: bool, reflects: bool) -> list[Apply]:
    """The functions to call before each step; law: whether friction is ours too.

    reflects: whether a point stays on the floor as `follower` says.
    """
    friction = laws(world, step) if law else []
    before = [*turned(world, step, midpoint=midpoint), *tells(world, step, midpoint=midpoint)]
    before += [*friction, *_followers(world, step, reflects)]
    walks = [steers(world.stride, world.wheels, world.place)] if world.stride else []
    return [*before, *walks, *lays(world, step)]  # which has to know what has been told


def _followers(world: World, step: float, reflects: bool) -> list[Apply]:
    scene = world.scene
    tips: dict[str, list[Tip]] = {}
    for contact in scene.touching.values():
        if is_tip(scene, contact) and not world.plain:
            tip = Tip(scene, contact, world.wheels[contact.name])
            tips.setdefault(contact.body, []).append(tip)
    following = [
        follower(world.bodies[body], those, step, reflects=reflects) for body, those in tips.items()
    ]
    return [*following, *pair_followers(world, step, reflects=reflects)]
