"""Forces that pymunk has no element for: by their laws, at the points where they act."""

from collections.abc import Callable, Sequence
from typing import Any

from ....cases.scene import GROUND, Force
from ...point_forces import Exerted, Place, law_of, living
from ..model.chipmunk_state import State, pushing, reading
from ..model.world import World
from .force_points import ahead, at_midpoint
from .inner_state import taken_along
from .line_forces import Exerted as Acting
from .line_forces import Load


def told_at_points(world: World, force: Force, step: float) -> Callable[[float], None]:
    """The force at the midpoint, with the velocities extrapolated to 3/2 vₙ − 1/2 vₙ₋₁.

    Of second order, explicit, and indifferent to joints, as that of a line is.
    """
    ends = world.scene.ends(force)
    points = [at_midpoint(world, at, step) for at in ends]
    pushed = [None if at.body == GROUND else pushing(world.bodies[at.body]) for at in ends]
    keep = taken_along(world, force, step, points) if force.inner else None
    law = _law(world, force)

    def apply(t: float) -> None:
        seen = [point.read() for point in points]
        places = [place for _, _, place in seen]
        if keep:
            keep(places)
        pushes = law(t + step / 2, places)
        for pushing_it, (x, y, _), force in zip(pushed, seen, pushes, strict=True):
            if pushing_it:
                pushing_it(force, (x, y))

    return apply


def exerted_at_points(world: World, force: Force, name: str) -> Acting:
    """The load of the force on the body `name`, `drift` s ahead at the present velocities."""
    law, ends = _law(world, force), world.scene.ends(force)
    looks = [(reading(world.body(at)), world.local(at)) for at in ends]

    def exerted(t: float, drift: float, state: State) -> Load:
        seen = []
        for read, at in looks:
            now = read()
            seen.append(ahead(now, at, drift, 1.0, now))
        pushes = law(t, [place for _, _, place in seen])
        fx = fy = torque = 0.0
        for at, (rx, ry, _), (px, py) in zip(ends, seen, pushes, strict=True):
            if at.body == name:
                fx, fy, torque = fx + px, fy + py, torque + rx * py - ry * px
        return fx, fy, torque

    return exerted


def _law(world: World, force: Force) -> Callable[[float, Sequence[Place]], Exerted]:
    """A law without a state, or with the state that is kept of it."""
    if not force.inner:
        return law_of(world.scene, force)
    law, name = living(world.scene, force), f"{force.name}.{force.inner}"
    return lambda t, places: law.exerts(places, world.inner[name][-1])


BY_LAW: dict[str, Any] = {
    "load": exerted_at_points,
    "tell": lambda world, force, step, drift: told_at_points(world, force, step),
}
"""What an `Element` is that is only told, at the points where it acts."""
