"""A magnetic field along z, and what it does to a charge in a body's centre."""

from collections.abc import Iterator, Sequence
from typing import Any

from ....cases.scene.forces.magnetic import Magnetic
from ....cases.scene.point import CENTER, Anchor
from ...laws.force import magnetic
from ..kinematics.coordinates import Coordinates, Point

Numbers = Sequence[Any]


def deflected(
    force: Magnetic, where: Coordinates, t: float, q: Numbers, v: Numbers
) -> Iterator[tuple[Any, Point]]:
    centre = where.point(Anchor(force.body, CENTER), t, q, v)
    yield magnetic(force.charge, force.along_z, centre.r_dot).tolist(), centre


def magnetic_potential(force: Magnetic, where: Coordinates, t: Any, q: Any, v: Any) -> Any:
    """(2.49) V = ½ e B (y ẋ − x ẏ) [J]."""
    xy, _ = where.columns[force.body]
    turning = q[xy + 1] * v[xy] - q[xy] * v[xy + 1]
    return 0.5 * force.charge * force.along_z * turning
