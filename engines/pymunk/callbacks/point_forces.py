"""Forces that pymunk has no element for: by their laws, at the points where they act."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from ....cases.scene import GROUND, Anchor, Force
from ....cases.trajectory import Array
from ...point_forces import Exerted, Living, Place, law_of, living
from ..model.chipmunk_state import State, pushing, reading
from ..model.world import World
from .line_forces import Exerted as Acting
from .line_forces import Load

# The points at which a force by law acts, ahead of the step.


Seen = tuple[float, float, Place]
"""The lever of a force about the centre of mass, and the point."""


@dataclass(frozen=True)
class Point:
    """begun: where it is at the start. read: where it is in the middle of the step to come.

    With it pymunk's x and y of where a force acts: its lever from the present centre.
    """

    begun: Place
    read: Callable[[], Seen]


def at_midpoint(world: World, anchor: Anchor, step: float) -> Point:
    """Read after the drift, with the velocity extrapolated to 3/2 vₙ − 1/2 vₙ₋₁."""
    look, at = reading(world.body(anchor)), world.local(anchor)
    before = look()  # there is no step before the first

    def read() -> Seen:
        nonlocal before
        was, before = before, look()
        rx, ry, place = ahead(before, at, step, 1.5, was)
        return before[0] + rx, before[1] + ry, place

    return Point(ahead(before, at, step / 2, 1.0, before)[2], read)


def ahead(state: State, at: tuple[float, float], drift: float, share: float, was: State) -> Seen:
    """A point `drift` s ahead; of its velocity a share, and what is missing from that before."""
    x, y, angle, vx, vy, omega = state
    *_, was_vx, was_vy, was_omega = was
    angle, rest = angle + drift * omega, 1.0 - share
    cos, sin = math.cos(angle), math.sin(angle)
    rx, ry = cos * at[0] - sin * at[1], sin * at[0] + cos * at[1]
    u, w = share * vx + rest * was_vx, share * vy + rest * was_vy
    turning = share * omega + rest * was_omega
    place = Place(
        x + drift * vx + rx, y + drift * vy + ry, u - turning * ry, w + turning * rx, angle
    )
    return rx, ry, place


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


# Forces with an inner state, which pymunk does not know: ours is taken along, step by step.
#
# The state u stands in the middle of the step whose force it gives: it is integrated from the
# middle before, with the points on straight lines between, and read between two of them.


def taken_along(
    world: World, force: Force, step: float, points: Sequence[Point]
) -> Callable[[Sequence[Place]], None]:
    """A function that takes the state on to the middle of each step, and keeps it in the world."""
    law = living(world.scene, force)
    kept = world.inner[f"{force.name}.{force.inner}"] = [law.begins]
    before = [point.begun for point in points]
    length = step / 2  # from the start to the first middle; whole steps from then on

    def keep(places: Sequence[Place]) -> None:
        nonlocal before, length
        kept.append(advanced(law, before, places, kept[-1], length))
        before, length = list(places), step

    return keep


def advanced(
    law: Living, start: Sequence[Place], end: Sequence[Place], u: float, length: float
) -> float:
    """u after so long, by the classical Runge and Kutta."""
    middle = [
        Place(*((x + y) / 2 for x, y in zip(a, b, strict=True)))
        for a, b in zip(start, end, strict=True)
    ]
    k1 = law.rate(start, u)
    k2 = law.rate(middle, u + length / 2 * k1)
    k3 = law.rate(middle, u + length / 2 * k2)
    k4 = law.rate(end, u + length * k3)
    return u + length / 6 * (k1 + 2 * k2 + 2 * k3 + k4)


def states(world: World, times: Array, step: float) -> dict[str, Array]:
    """(N,) of each inner state, by quantity: between middles, and beyond the last as before it."""
    inner = {}
    for name, kept in world.inner.items():
        middles = np.append(0.0, (np.arange(len(kept) - 1) + 0.5) * step)
        values = np.append(kept, kept[-1] + (kept[-1] - kept[-2]) if len(kept) > 2 else kept[-1])
        inner[name] = np.interp(times, np.append(middles, middles[-1] + step), values)
    return inner
