"""Made-up motions of bodies in space: place and attitude as functions of time, and states."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.spatial.transform import Rotation

Array = Any
Moving = Callable[[float], Array]

T = np.linspace(0.0, 1.2, 13)


def turn(axis: Array, angle: float) -> Array:
    """(3, 3) by Rodrigues' formula."""
    u = np.asarray(axis, dtype=float) / np.linalg.norm(axis)
    K = np.array([[0.0, -u[2], u[1]], [u[2], 0.0, -u[0]], [-u[1], u[0], 0.0]])
    return np.eye(3) + np.sin(angle) * K + (1 - np.cos(angle)) * K @ K


def rate(f: Moving, t: float) -> Array:
    """A central difference of fourth order: off by 1e-11 at these rates."""
    h = 1e-3
    d = [np.asarray(f(t + k * h)) for k in (-2, -1, 1, 2)]
    return (d[0] - 8 * d[1] + 8 * d[2] - d[3]) / (12 * h)


def states(place: Moving, attitude: Moving) -> Array:
    """(N, 13) at the times T: the columns of `SPACE`."""
    rows = []
    for t in T:
        R = attitude(t)
        x, y, z, w = Rotation.from_matrix(R).as_quat()
        spin = R.T @ rate(attitude, t)
        omega = (spin[2, 1], spin[0, 2], spin[1, 0])
        rows.append([*place(t), w, x, y, z, *rate(place, t), *omega])
    return np.array(rows)
