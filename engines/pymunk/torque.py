"""A torque on a body, given to it before every step."""

from collections.abc import Callable, Iterator

from pymunk.body import Body

from ...cases.scene.forces.force import Torque
from ..signal import acting, in_time
from .direct import turning
from .law.line import Exerted
from .wording import as_text
from .world import World


def torque(world: World, force: Torque, step: float, drift: float) -> Callable[[float], None]:
    """In the middle of the step, or at its start."""
    turn, turned = turning(world.bodies[force.body]), acting(force.signal, drift)
    return lambda t: turn(turned(t)[0])


def torque_load(world: World, force: Torque, name: str) -> Exerted:
    """What it exerts on its body."""
    turned = in_time(force.signal)
    return lambda t, drift, state: (0.0, 0.0, turned(t)[0])


def torque_script(
    world: World, force: Torque, of: Callable[[Body], str], midpoint: bool
) -> Iterator[str]:
    """A line of Python."""
    (size,) = as_text(force.signal, midpoint=midpoint)
    yield f"    {of(world.bodies[force.body])}.torque += {size}"
