"""Quaternion kinematics of bodies in space: rotation matrices, angular velocity, cross products.

Quaternions are q = (w, x, y, z), from body to ground axes; ∘ is their product, q̄ the conjugate.
All functions take real entries, or complex ones while a derivative is taken by the complex step.

A quaternion's length plays no part: R is that of q/|q|.  So nothing has to be normalised on the
way, and normalising changes neither a place nor an energy.

A bilinear function is computed as all products a_i b_j at once, times a constant table: on a few
vectors numpy's calls cost far more than what they compute, and these are the fewest.
"""

from typing import Any

import numpy as np


def _levi_civita() -> Any:
    """(9, 3): the table that makes a × b of the products a_i b_j."""
    table = np.zeros((3, 3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        table[i, j, k], table[j, i, k] = 1.0, -1.0
    return table.reshape(9, 3)


def _quadratic() -> Any:
    """(16, 10): the table that makes the entries of |q|² R, row by row, and |q|² of the q_i q_j."""
    # Column i of the identity picks one product; q_i q_j and q_j q_i are the same, and one is used.
    ww, wx, wy, wz, _, xx, xy, xz, _, _, yy, yz, _, _, _, zz = np.eye(16)
    entries = [
        ww + xx - yy - zz, 2 * (xy - wz), 2 * (xz + wy),
        2 * (xy + wz), ww - xx + yy - zz, 2 * (yz - wx),
        2 * (xz - wy), 2 * (yz + wx), ww - xx - yy + zz,
        ww + xx + yy + zz,
    ]  # fmt: skip
    return np.stack(entries, axis=1)


def _halved() -> Any:
    """(12, 4): the table that makes ½ q ∘ (0, ω) of the products q_i ω_j; ω = (a, b, c)."""
    wa, wb, wc, xa, xb, xc, ya, yb, yc, za, zb, zc = np.eye(12)
    return np.stack([-xa - yb - zc, wa + yc - zb, wb + za - xc, wc + xb - ya], axis=1) / 2


LEVI_CIVITA, QUADRATIC, HALVED = _levi_civita(), _quadratic(), _halved()


def matrices(q: Any) -> Any:
    """(K, 3, 3): R = Eᵀ of (2.1), whose columns are the body axes in ground axes; q (K, 4)."""
    entries = _products(q, q) @ QUADRATIC
    return (entries[:, :9] / entries[:, 9:]).reshape(-1, 3, 3)


def rates(q: Any, omega: Any) -> Any:
    """(K, 4): q̇ = ½ q ∘ (0, ω), ω (K, 3) in body axes: (2.5) with the quaternion for E."""
    return _products(q, omega) @ HALVED


def spin(q: Any, q_dot: Any) -> Any:
    """(3, …): ω in body axes of one quaternion q (4,) and its rates (4, …): 2 q̄ ∘ q̇/|q|²."""
    w, x, y, z = q
    a, b, c, d = q_dot
    omega = [
        w * b - x * a - y * d + z * c,
        w * c - y * a - z * b + x * d,
        w * d - z * a - x * c + y * b,
    ]
    return 2 * np.stack(omega) / (w * w + x * x + y * y + z * z)


def skew(x: Any) -> Any:
    """(…, 3, 3): [x]× with [x]× y = x × y; x (…, 3)."""
    return (x @ SKEW).reshape(*x.shape, 3)


def _products(a: Any, b: Any) -> Any:
    """(…, n m): all products a_i b_j of a (…, n) and b (…, m), in the order of i, then j."""
    products = a[..., :, None] * b[..., None, :]
    return products.reshape(*products.shape[:-2], -1)


SKEW = -LEVI_CIVITA.reshape(3, 9)  # makes [x]×, row by row, of x
