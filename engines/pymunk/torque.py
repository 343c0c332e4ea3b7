"""A torque on a body, given to it before every step."""

from collections.abc import Callable, Iterator

from pymunk.body import Body

from ...cases.force import Torque
from ..signal import acting, value
from .law.line import Exerted
from .wording import as_text
from .world import World


def torque(world: World, force: Torque, step: float, drift: float) -> Callable[[float], None]:
    """In the middle of the step, or at its start."""
    body, turned = world.bodies[force.body], acting(force.signal, drift)

    def apply(t: float) -> None:
        body.torque += turned(t)[0]

    return apply


def torque_load(world: World, force: Torque, name: str) -> Exerted:
    """What it exerts on its body."""
    return lambda t, drift: (0.0, 0.0, value(force.signal, t)[0])


def torque_script(
    world: World, force: Torque, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    """A line of Python."""
    (size,) = as_text(force.signal, midpoint=midpoint)
    yield f"    {of(world.bodies[force.body])}.torque += {size}"
