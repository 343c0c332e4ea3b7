"""Moments of inertia and how they change with the point and with the axes (2.29)–(2.36)."""

import numpy as np

from ..coverage import equation
from ..system import Array


@equation
def tensor(m: Array, x: Array) -> Array:
    """(2.30), (2.31) J_ik = Σ m (x_j x_j δ_ik − x_i x_k), (3, 3) [kg m²]: masses m (N,), x (N, 3).

    The products of inertia carry the minus sign, also in the matrix (2.32).
    """
    return np.einsum("n,nj,nj->", m, x, x) * np.eye(3) - np.einsum("n,ni,nk->ik", m, x, x)


@equation
def disk(m: float, R: float) -> Array:
    """(2.32) J = diag(m R²/4, m R²/4, m R²/2), (3, 3): thin disk about C, axis 3 (Exercise 2.2)."""
    return np.diag([m * R**2 / 4, m * R**2 / 4, m * R**2 / 2])


@equation
def bar(m: float, l: float) -> Array:
    """(2.32) J = diag(0, m l²/12, m l²/12), (3, 3): slender bar about C, axis 1 (Exercise 2.3)."""
    return np.diag([0.0, m * l**2 / 12, m * l**2 / 12])


@equation
def steiner(J: Array, m: float, a: Array) -> Array:
    """(2.35) J_{i'k'} = J_ik + m (a_j a_j δ_ik − a_i a_k), (3, 3): J about C, a (3,) = CA."""
    return J + m * (a @ a * np.eye(3) - np.outer(a, a))


@equation
def rotated(J: Array, E: Array) -> Array:
    """(2.36) J_{i'k'} = E_{i'i} E_{k'k} J_ik = E J Eᵀ, (3, 3): E has the new axes as its rows."""
    return E @ J @ E.T
