"""Momentum and angular momentum of a rigid body and what changes them (2.21)–(2.28), (2.33)."""

from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array


@equation
def center(m: Array, r: Array) -> Array:
    """(2.21) r_c = ∫ r dm / ∫ dm, (3,) [m]: of masses m (N,) at r (N, 3)."""
    return m @ r / np.sum(m)


@equation
def momentum(m: float, v_c: Array) -> Array:
    """(2.22) p = m ṙ_c, (3,) [kg m/s]."""
    return m * v_c


@equation
def spin_momentum(J: Array, omega: Array) -> Array:
    """(2.25), (2.29) D_c = ∫ x × (ω × x) dm = J_ik ω_i E_k, (3,) [kg m²/s]: in the axes of J."""
    return J @ omega


@equation
def spin_change(J: Array, omega: Array, omega_dot: Array) -> Array:
    """(2.33) Ḋ = J ω̇ + ω × (J ω), (3,) [N m] in body axes: the moment M_c if J is about C."""
    return J @ omega_dot + np.cross(omega, J @ omega)


@equation
def axis_moment(J33: float, omega_dot: float) -> float:
    """(2.34) M_c3 = J₃₃ ω̇ [N m]: about a fixed principal axis; by (2.35) about any fixed one."""
    return J33 * omega_dot


@equation
def angular_momentum(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) D₀ = ∫ r × ṙ dm = r_c × m ṙ_c + J ω, (3,) [kg m²/s]: J (3, 3) about C."""
    return np.cross(r, m * v) + J @ omega


@equation
def moment_change(M_A: Array, m: float, a_A: Array, a: Array) -> Array:
    """(2.28) Ḋ_A = M_A + m r̈_A × a, (3,) [N m]: a = AC, D_A from velocities relative to A."""
    return M_A + m * np.cross(a_A, a)


@equation
def spin_rate(J: Array, omega: Array, M_c: Array) -> Array:
    """(2.33) J ω̇ + ω × (J ω) = M_c: ω̇ (3,) [rad/s²] in body axes, for a general J (3, 3)."""
    omega_dot: Any = np.linalg.solve(J, M_c - np.cross(omega, J @ omega))
    return omega_dot


# Kinetic energy of a rigid body (2.53), (2.54).


@equation
def of_general_point(m: float, J: Array, v: Array, omega: Array, x_c: Array) -> float:
    """(2.53) T = ½ m ṙ_Ω² + m ṙ_Ω · (ω × x_c) + ½ J_ik ω_i ω_k [J]: J (3, 3) about Ω.

    ṙ_Ω, ω and x_c = ΩC (3,), all in the axes of J.
    """
    return float(m * v @ v / 2 + m * v @ np.cross(omega, x_c) + omega @ J @ omega / 2)


@equation
def of_center(m: float, J: Array, v: Array, omega: Array) -> float:
    """(2.54) T = ½ m ṙ_c² + ½ J_ik ω_i ω_k [J] (König): J (3, 3) about C, in the axes of ω."""
    return float(m * v @ v / 2 + omega @ J @ omega / 2)
