"""A torque between two bodies, given to both before every step."""

from collections.abc import Callable, Iterator

from pymunk.body import Body

from ...cases.scene.forces.couple import Couple
from ..signal import acting, in_time
from .direct import turning
from .law.line import Exerted
from .wording import as_text
from .world import World


def couple(world: World, force: Couple, step: float, drift: float) -> Callable[[float], None]:
    """Its torque in the middle of the step, or at its start."""
    first, second = (turning(body) for body in _both(world, force))
    torque = acting(force.signal, drift)

    def apply(t: float) -> None:
        (size,) = torque(t)
        first(-size)
        second(size)

    return apply


def couple_load(world: World, force: Couple, name: str) -> Exerted:
    """What it exerts on the body `name`."""
    way = 1.0 if name == force.second else -1.0
    torque = in_time(force.signal)
    return lambda t, drift, state: (0.0, 0.0, way * torque(t)[0])


def couple_script(
    world: World, force: Couple, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    """Lines of Python."""
    (torque,) = as_text(force.signal, midpoint=midpoint)
    for body, sign in zip(_both(world, force), "-+", strict=True):
        yield f"    {of(body)}.torque {sign}= {torque}"


def _both(world: World, force: Couple) -> tuple[Body, Body]:
    return world.bodies[force.first], world.bodies[force.second]
