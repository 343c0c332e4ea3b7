"""How far two samples of one quantity are apart: a number, or the angle of two attitudes."""

import numpy as np

from ..trajectory import Array
from .rotation import angle_between, inverse, product


def deviation(a: Array, b: Array) -> Array:
    """(N,) |a − b| of numbers (N,); of attitudes (N, 4) the angle [rad] between them."""
    return np.abs(a - b) if a.ndim == 1 else angle_between(a, b)


def from_reference(samples: Array, reference: Array) -> Array:
    """(N,) as they are; of attitudes (N, 3) the turn [rad] from the reference, about each axis.

    Turns that are small can be added and extrapolated as numbers are; quaternions cannot.
    """
    if samples.ndim == 1:
        return samples
    d = product(inverse(reference), samples)
    d = np.where(d[:, :1] < 0, -d, d)  # a quaternion and its opposite are the same attitude
    half = np.linalg.norm(d[:, 1:], axis=1, keepdims=True)
    angle = 2 * np.arctan2(half, d[:, :1])
    return d[:, 1:] * np.where(half > 0, angle / np.where(half > 0, half, 1.0), 2.0)
