"""Rows in space that hold more than there is to hold: one motion, and forces that it leaves open.

Two hinges about one line hold a bar along it twice. Which of them bears how much is for nobody to
say (`leeway`), as in the plane.
"""

import numpy as np

from ....system import Array
from ...kinematics.space.coordinates import SpatialCoordinates
from ..loose import DEPENDENT, rank, unit


def independent(rows: Array, sizes: Array) -> int:
    """How many of the rows (r, n) are independent, of velocities / sizes."""
    return rank(unit(rows * sizes)[0])


def unit_sizes(where: SpatialCoordinates) -> Array:
    """(n,) by which rates of turns are counted as speeds: the radius of gyration."""
    resists = np.array(where.masses)
    of_body = np.roll(resists, 3)  # a turn's stand behind its body's mass
    return np.where(where.turning, np.sqrt(of_body / resists), 1.0)


def solved(
    M: Array, rows: Array, gamma: Array, Q: Array, sizes: Array
) -> tuple[Array, Array, Array]:
    """v̇ (n,), the least λ (r,) that give it, and those (k, r) that together exert nothing."""
    even, each = unit(rows * sizes)
    across, s, along = np.linalg.svd(even)
    k = int(np.sum(s > DEPENDENT * s[0]))
    free = along[k:] * sizes  # (n − k, n), the ways that the rows leave
    a = sizes * (along[:k].T @ ((across.T @ (gamma / each))[:k] / s[:k]))
    if len(free):
        a = a + np.linalg.solve(free @ M @ free.T, free @ (Q - M @ a)) @ free
    multipliers = across[:, :k] @ ((along @ (sizes * (M @ a - Q)))[:k] / s[:k])
    return a, multipliers / each, across[:, k:].T / each
