"""Forces with an inner state, which pymunk does not know: ours is taken along, step by step.

The state u stands in the middle of the step whose force it gives: it is integrated from the middle
before, with the points on straight lines between, and read between two of them.
"""

from collections.abc import Callable, Sequence

import numpy as np

from ....cases.scene import Force
from ....cases.trajectory import Array
from ...point_forces import Living, Place, living
from ..model.world import World
from .force_points import Point


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
    found = {}
    for name, kept in world.inner.items():
        middles = np.append(0.0, (np.arange(len(kept) - 1) + 0.5) * step)
        values = np.append(kept, kept[-1] + (kept[-1] - kept[-2]) if len(kept) > 2 else kept[-1])
        found[name] = np.interp(times, np.append(middles, middles[-1] + step), values)
    return found
