"""Force laws in the book's letters: weight, spring, viscous damper."""

import math

import numpy as np
from numpy.typing import ArrayLike

from ..system import Array


def weight(m: float, g: ArrayLike) -> Array:
    """(2.81) F = m g [N]: g (2,) the acceleration of gravity as a vector."""
    return m * np.asarray(g, dtype=np.float64)


def spring(c: float, l0: float, d: ArrayLike) -> Array:
    """(2.82) F = −c (λ − λ₀) along the spring, (2,) [N]: the force on the first end.

    d (2,) runs from the first end to the second and λ = |d|: stretched, it pulls along d. λ > 0
    unless λ₀ = 0, where F = c d needs no direction.
    """
    x, y = np.asarray(d, dtype=np.float64).tolist()
    if l0 == 0.0:
        return np.array([c * x, c * y])
    l = math.sqrt(x * x + y * y)
    return np.array([x, y]) * (c * (l - l0) / l)


def damper(d: float, r: ArrayLike, r_dot: ArrayLike) -> Array:
    """(2.47) F = −d λ̇ along the damper, (2,) [N]: the force on the first end.

    r (2,) runs from the first end to the second, λ = |r| > 0, λ̇ = r·ṙ/λ.
    """
    x, y = np.asarray(r, dtype=np.float64).tolist()
    vx, vy = np.asarray(r_dot, dtype=np.float64).tolist()
    return np.array([x, y]) * (d * (x * vx + y * vy) / (x * x + y * y))
