"""The points at which a force by law acts, ahead of the step."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from ....cases.scene import Anchor
from ...point_forces import Place
from ..model.chipmunk_state import State, reading
from ..model.world import World

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
