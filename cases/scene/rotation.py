"""Quaternion algebra of attitudes: q = (w, x, y, z) takes body components to ground components.

For derived quantities and for engines. The reference has its own (reference/laws/rotation.py), so
that a mistake here is not made twice. Functions of arrays take any number of rows: (…, 4), (…, 3).
"""

import math
from typing import Any

import numpy as np

from ..trajectory import Array

Vector3 = tuple[float, float, float]
Quaternion = tuple[float, float, float, float]

UPRIGHT: Quaternion = (1.0, 0.0, 0.0, 0.0)  # the identity: body axes along ground axes


def matrix(q: Array) -> Array:
    """(…, 3, 3) the rotation matrix of q: its columns are the body axes in ground axes.

    Any length of q but zero will do, for it is normalised here.
    """
    q = np.asarray(q, dtype=float)
    q = q / np.linalg.norm(q, axis=-1, keepdims=True)
    w, x, y, z = (q[..., i] for i in range(4))  # views: moving an axis costs more than all the rest
    rotation = np.empty((*q.shape[:-1], 3, 3))
    rotation[..., 0, 0], rotation[..., 1, 1] = 1 - 2 * (y * y + z * z), 1 - 2 * (x * x + z * z)
    rotation[..., 2, 2] = 1 - 2 * (x * x + y * y)
    rotation[..., 0, 1], rotation[..., 1, 0] = 2 * (x * y - w * z), 2 * (x * y + w * z)
    rotation[..., 0, 2], rotation[..., 2, 0] = 2 * (x * z + w * y), 2 * (x * z - w * y)
    rotation[..., 1, 2], rotation[..., 2, 1] = 2 * (y * z - w * x), 2 * (y * z + w * x)
    return rotation


def turned(q: Array, vector: Any) -> Array:
    """(…, 3) the components in ground axes of a vector (3,) or (…, 3) given in body axes."""
    return np.einsum("...ij,...j->...i", matrix(q), np.asarray(vector, dtype=float))


def product(a: Array, b: Array) -> Array:
    """(…, 4) the quaternion product a ∘ b: the attitude that is turned by b first, then by a."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    aw, ax, ay, az = (a[..., i] for i in range(4))
    bw, bx, by, bz = (b[..., i] for i in range(4))
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def inverse(q: Array) -> Array:
    """(…, 4) the inverse attitude: the conjugate, so q must be of unit length."""
    return np.asarray(q, dtype=float) * np.array([1.0, -1.0, -1.0, -1.0])


def about(axis: Vector3, angle: float) -> Quaternion:
    """Returns the attitude turned by an angle [rad] about an axis, of any length but zero."""
    size = math.sqrt(sum(x * x for x in axis))
    sin = math.sin(angle / 2) / size
    return math.cos(angle / 2), axis[0] * sin, axis[1] * sin, axis[2] * sin


def angle_between(a: Array, b: Array) -> Array:
    """(…,) the angle [rad], from 0 to π, of the turn that leads from one attitude to the other."""
    d = product(inverse(a), b)
    # |w|: q and −q are one attitude. The tangent keeps small angles, which a cosine loses.
    return 2 * np.arctan2(np.linalg.norm(d[..., 1:], axis=-1), np.abs(d[..., 0]))
