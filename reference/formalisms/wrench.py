"""Force and moment on a free-cut body, as the rows of its equations.

In the plane these are F_x, F_y and the moment; in space F in ground axes and the moments in the
body's own axes, where J is constant. A particle has no moments.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from ...cases.scene.frame import PLANE, SPACE
from ..coverage import equation
from ..laws.rotation import axes
from ..system import Array, Mass, Mode, Pose


@equation
def wrench(
    at: tuple[float, ...], pose: Pose, force: tuple[float, ...], moment: float | tuple[float, ...]
) -> Array:
    """(2.26) F, and M_c = x × F + M: (3,) in the plane, (6,) in space. C stands first in `pose`."""
    if not spatial(pose):
        x, y = at[0] - pose[0], at[1] - pose[1]
        return np.array([force[0], force[1], x * force[1] - y * force[0] + moment])
    M_c = np.cross(np.subtract(at, pose[SPACE.place]), force) + moment
    return np.concatenate([force, axes(pose[SPACE.attitude]) @ M_c])


@equation
def inertial(mass: Mass, rate: Array) -> Array:
    """(2.23) m r̈_c and (2.27) J ω̇ of the accelerations (3,) or (6,) of a body."""
    d = PLANE.dimension if len(rate) == PLANE.spin.stop - PLANE.velocity.start else SPACE.dimension
    if mass.J is None:
        return mass.m * rate[:d]
    return np.concatenate([mass.m * rate[:d], np.dot(rate[d:], mass.J)])


@equation
def gyroscopic(mass: Mass, pose: Pose) -> Array:
    """(2.33) ω × (J ω), the moment that turns J ω with the body; none in the plane."""
    rows = none(pose)
    if spatial(pose) and mass.J is not None:
        omega = np.array(pose[SPACE.spin])
        rows[SPACE.dimension :] = np.cross(omega, mass.J @ omega)
    return rows


def none(pose: Pose) -> Array:
    """No force and no moment."""
    return np.zeros(2 * SPACE.dimension if spatial(pose) else PLANE.dimension + 1)


def spatial(pose: Pose) -> bool:
    """Whether it is a pose in space."""
    return len(pose) == SPACE.width


def velocity(pose: Pose) -> tuple[Any, ...]:
    """v and ω of a pose."""
    return pose[SPACE.velocity.start :] if spatial(pose) else pose[PLANE.velocity.start :]


def rows(system: Mode, wrenches: Mapping[str, Array]) -> Array:
    """The rows of all bodies below each other: a particle has none of moments."""
    parts = []
    for name, mass in system.masses.items():
        d = (len(wrenches[name]) + 1) // 2
        parts.append(wrenches[name][:d] if mass.J is None else wrenches[name])
    return np.concatenate(parts)
