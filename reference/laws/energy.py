"""Kinetic energy of a rigid body (2.53), (2.54)."""

import numpy as np

from ..system import Array


def of_general_point(m: float, J: Array, v: Array, omega: Array, x_c: Array) -> float:
    """(2.53) T = ½ m ṙ_Ω² + m ṙ_Ω · (ω × x_c) + ½ J_ik ω_i ω_k [J]: J (3, 3) about Ω.

    ṙ_Ω, ω and x_c = ΩC (3,), all in the axes of J.
    """
    return float(m * v @ v / 2 + m * v @ np.cross(omega, x_c) + omega @ J @ omega / 2)


def of_center(m: float, J: Array, v: Array, omega: Array) -> float:
    """(2.54) T = ½ m ṙ_c² + ½ J_ik ω_i ω_k [J] (König): J (3, 3) about C, in the axes of ω."""
    return float(m * v @ v / 2 + omega @ J @ omega / 2)
