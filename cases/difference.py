"""How far two samples of one quantity are apart: a number, or the angle of two attitudes."""

import numpy as np

from .space.rotation import angle_between
from .trajectory import Array


def apart(one: Array, other: Array) -> Array:
    """(N,) |a − b| of numbers (N,); of attitudes (N, 4) the angle [rad] between them."""
    return np.abs(one - other) if one.ndim == 1 else angle_between(one, other)
