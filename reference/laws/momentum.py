"""Momentum and angular momentum of a rigid body and what changes them (2.21)–(2.28), (2.33)."""

from typing import Any

import numpy as np

from ..system import Array


def angular_momentum(m: float, J: Array, r: Array, v: Array, omega: Array) -> Array:
    """(2.24) D₀ = ∫ r × ṙ dm = r_c × m ṙ_c + J ω, (3,) [kg m²/s]: J (3, 3) about C."""
    return np.cross(r, m * v) + J @ omega


def moment_change(M_A: Array, m: float, a_A: Array, a: Array) -> Array:
    """(2.28) Ḋ_A = M_A + m r̈_A × a, (3,) [N m]: a = AC, D_A from velocities relative to A."""
    return M_A + m * np.cross(a_A, a)


def spin_rate(J: Array, omega: Array, M_c: Array) -> Array:
    """(2.33) J ω̇ + ω × (J ω) = M_c: ω̇ (3,) [rad/s²] in body axes, for a general J (3, 3)."""
    omega_dot: Any = np.linalg.solve(J, M_c - np.cross(omega, J @ omega))
    return omega_dot
