"""Prescribed rates of joints: motors of any strength, told anew before each step how fast to turn.

pymunk counts the first body's rate against the second's. A step ends with the motor's rate, so it
is told that of the end of the step; a user who does not know tells the present one.
"""

from collections.abc import Callable, Iterator

from ..signal import in_time
from .wording import as_text
from .world import World

NO_LINE = "engine: pymunk has no motor along a line"


def tells(world: World, step: float, *, midpoint: bool) -> list[Callable[[float], None]]:
    """What is called before the step that starts at t [s]."""
    ahead = step if midpoint else 0.0
    return [_told(world, name, ahead) for name in world.motors]


def _told(world: World, name: str, ahead: float) -> Callable[[float], None]:
    motor, rate = world.motors[name], in_time(world.scene.drives[f"{name}.omega"])

    def tell(t: float) -> None:
        motor.rate = -rate(t + ahead)[0]

    return tell


def as_lines(world: World, *, midpoint: bool) -> Iterator[str]:
    """The same as lines of Python."""
    if world.motors:
        yield f"    t = {'(n + 1) * h' if midpoint else 'n * h'}"
    for name in world.motors:
        (rate,) = as_text(world.scene.drives[f"{name}.omega"])
        yield f"    motors[{name!r}].rate = -({rate})"
