"""Muscles: a pull between two points, and the rate of the length that contracts."""

from collections.abc import Iterator, Sequence
from typing import Any

import numpy as np

from ....cases.scene.forces.muscle import Contracting, LinearMuscle, Muscle
from ...laws.muscle import hill, linear
from ..kinematics.coordinates import Coordinates, Point

Numbers = Sequence[Any]


def pulled(
    force: Contracting, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    a, b, length = _line(force, where, t, q)
    beside = force.parallel_stiffness * (length - force.rest_length)
    size = (_series(force, where, q, length) + beside) / length
    x, y = size * (b.r[0] - a.r[0]), size * (b.r[1] - a.r[1])
    yield (x, y), a
    yield (-x, -y), b


def stretched(force: Contracting, where: Coordinates, t: Any, q: Numbers) -> Any:
    """(2.45) ½ c_s (λ − u)² + ½ c_p (λ − λ₀)² [J]."""
    *_, length = _line(force, where, t, q)
    series = length - q[where.inner[f"{force.name}.{force.inner}"]]
    beside = length - force.rest_length
    energy = force.series_stiffness * series * series + force.parallel_stiffness * beside * beside
    return 0.5 * energy


def contracted(force: Contracting, where: Coordinates, t: Any, q: Numbers) -> Any:
    """u̇ [m/s], by the force in series."""
    F = _series(force, where, q, _line(force, where, t, q)[2])
    return -RATES[type(force)](force, F)


RATES: dict[type[Contracting], Any] = {
    Muscle: lambda force, F: hill(force.isometric, force.hill_a, force.hill_b, F),
    LinearMuscle: lambda force, F: linear(force.isometric, force.damping, F),
}
"""How fast what contracts shortens [m/s]."""


def _line(force: Contracting, where: Coordinates, t: Any, q: Numbers) -> tuple[Point, Point, Any]:
    a, b = (where.point(at, t, q, q) for at in (force.a, force.b))
    x, y = b.r[0] - a.r[0], b.r[1] - a.r[1]
    return a, b, np.sqrt(x * x + y * y)


def _series(force: Contracting, where: Coordinates, q: Numbers, length: Any) -> Any:
    """c_s (λ − u) [N]."""
    return force.series_stiffness * (length - q[where.inner[f"{force.name}.{force.inner}"]])
