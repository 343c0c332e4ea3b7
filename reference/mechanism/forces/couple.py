"""A torque of one body on another."""

from collections.abc import Iterator, Sequence
from typing import Any

from ....cases.scene.forces.couple import Couple
from ...system import Array
from ..kinematics.coordinates import Coordinates, Point
from ..kinematics.signal import signal

Numbers = Sequence[Any]


def coupled(
    force: Couple, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    """M on the second body and −M on the first, each by a lever of 1 m on the angle alone."""
    (M,) = signal(force.signal, t)
    for body, moment in ((force.first, -M), (force.second, M)):
        phi = where.columns[body][1]
        yield (0.0, moment), Point((0, 0), (0, 0), (1.0, 0.0), 0, 0, None, phi)


def turned_apart(
    force: Couple, where: Coordinates, t: Any, q: Numbers, v: Numbers, Q: Array
) -> None:
    """(2.50) M·∂(φ₂ − φ₁)/∂qᵃ."""
    (M,) = signal(force.signal, t)
    Q[where.columns[force.second][1]] += M
    Q[where.columns[force.first][1]] -= M
