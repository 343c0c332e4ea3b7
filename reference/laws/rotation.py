"""The axes of a body and how they turn (2.1)–(2.7).

E (3, 3) has the body axes E_i as its rows, in ground axes: E = Rᵀ of the matrix R that turns body
into ground axes.  All of it takes complex arguments, for derivatives by the complex step.
"""

from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Vector


@equation
def point(r_Omega: Vector, E: Vector, x: Vector) -> Vector:
    """(2.1), (2.2) r = r_Ω + x_i E_i, (3,) [m]: x (3,) in body axes, all else in ground axes."""
    return r_Omega + x @ E


@equation
def turning(E: Vector, E_dot: Vector) -> Vector:
    """(2.3) Ė_i = ω_ij E_j with ω_ij = Ė_ik E_jk, (3, 3) [rad/s], skew since E⁻¹ = Eᵀ."""
    return E_dot @ E.T


@equation
def angular_velocity(E: Vector, E_dot: Vector) -> Vector:
    """(2.4) ω = ω₂₃ E₁ + ω₃₁ E₂ + ω₁₂ E₃, (3,) [rad/s]: its components in body axes."""
    omega = turning(E, E_dot)
    return np.array([omega[1, 2], omega[2, 0], omega[0, 1]])


@equation
def axis_rates(E: Vector, omega: Vector) -> Vector:
    """(2.5) Ė_i = ω × E_i, (3, 3) [rad/s], a row each: ω (3,) in body axes."""
    return np.cross(omega @ E, E)


@equation
def velocity(v_Omega: Vector, omega: Vector, x: Vector) -> Vector:
    """(2.6) v = ṙ_Ω + ω × x, (3,) [m/s]: all three in the same axes."""
    return v_Omega + np.cross(omega, x)


@equation
def acceleration(a_Omega: Vector, omega_dot: Vector, omega: Vector, x: Vector) -> Vector:
    """(2.7) a = r̈_Ω + ω̇ × x + ω × (ω × x), (3,) [m/s²]: all in the same axes."""
    return a_Omega + np.cross(omega_dot, x) + np.cross(omega, np.cross(omega, x))


def axes(q: Any) -> Vector:
    """E (3, 3) of a quaternion (w, x, y, z) that turns body into ground axes, of any length."""
    w, x, y, z = q
    s = 2 / (w * w + x * x + y * y + z * z)
    return np.array(
        [
            [1 - s * (y * y + z * z), s * (x * y + w * z), s * (x * z - w * y)],
            [s * (x * y - w * z), 1 - s * (x * x + z * z), s * (y * z + w * x)],
            [s * (x * z + w * y), s * (y * z - w * x), 1 - s * (x * x + y * y)],
        ]
    )


def quaternion_rates(q: Any, omega: Any) -> Vector:
    """q̇ = ½ q ∘ (0, ω), (4,) [1/s]: ω (3,) in body axes."""
    w, x, y, z = q
    a, b, c = np.asarray(omega) / 2
    return np.array(
        [
            -x * a - y * b - z * c,
            w * a + y * c - z * b,
            w * b + z * a - x * c,
            w * c + x * b - y * a,
        ]
    )


def spin(q: Any, q_dot: Any) -> Vector:
    """ω = 2 q̄ ∘ q̇, (3,) or (3, K) [rad/s] in body axes, of a unit quaternion and q̇ (4,), (4, K)."""
    w, x, y, z = q
    a, b, c, d = q_dot
    return 2 * np.array(
        [
            w * b - x * a - y * d + z * c,
            w * c - y * a - z * b + x * d,
            w * d - z * a - x * c + y * b,
        ]
    )
