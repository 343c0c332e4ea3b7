"""Prescribed rates of joints: motors of any strength, told anew before each step how fast to turn.

pymunk counts the first body's rate against the second's. A step ends with the motor's rate, so it
is told that of the end of the step; a user who does not know tells the present one.
"""

from collections.abc import Callable, Iterator

from ...signal import derivative, in_time, rate
from .script_signals import as_text
from .world import World

NO_LINE = "engine: pymunk has no motor along a line"


def tells(world: World, step: float, *, midpoint: bool) -> list[Callable[[float], None]]:
    """The functions to call before the step that starts at t [s], which set prescribed rates."""
    ahead = step if midpoint else 0.0
    points = [name for name in world.driven if world.scene.points[name].moves]
    moved = [_moved(world, name) for name in points]
    return [*moved, *(_told(world, name, ahead) for name in world.motors)]


def _moved(world: World, name: str) -> Callable[[float], None]:
    """A driven point's velocity at the present time: that is the middle of how far a step goes."""
    body, law = world.driven[name], world.scene.points[name].moves
    assert law

    def tell(t: float) -> None:
        vx, vy = rate(law, t)
        body.velocity = vx, vy

    return tell


def _told(world: World, name: str, ahead: float) -> Callable[[float], None]:
    motor, wanted = world.motors[name], in_time(world.scene.drives[f"{name}.omega"])

    def tell(t: float) -> None:
        motor.rate = -wanted(t + ahead)[0]

    return tell


def as_lines(world: World, *, midpoint: bool) -> Iterator[str]:
    """Lines of Python that set prescribed rates before step n, as the functions of `tells` do."""
    for name in world.driven:
        if law := world.scene.points[name].moves:
            parts = zip(*(as_text(part) for part in derivative(law)), strict=True)
            x, y = (" + ".join(each) for each in parts)
            yield "    t = n * h"
            yield f"    bodies['ground.{name}'].velocity = ({x}, {y})"
    if world.motors:
        yield f"    t = {'(n + 1) * h' if midpoint else 'n * h'}"
    for name in world.motors:
        (rate,) = as_text(world.scene.drives[f"{name}.omega"])
        yield f"    motors[{name!r}].rate = -({rate})"
