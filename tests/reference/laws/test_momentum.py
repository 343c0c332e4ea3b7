"""Angular momentum: the laws (2.24)–(2.28), (2.33) against sums over moving masses."""

import numpy as np

from textmech.reference.laws.inertia import tensor
from textmech.reference.laws.momentum import angular_momentum, moment_change, spin_rate

RANDOM = np.random.default_rng(4)
MASSES = RANDOM.uniform(0.1, 1.0, 12)
X = RANDOM.normal(size=(12, 3))
X -= MASSES @ X / MASSES.sum()  # from the centre of mass
M = float(MASSES.sum())
J = tensor(MASSES, X)
R, V, A, OMEGA, SPIN = RANDOM.normal(size=(5, 3))  # of the centre: r, ṙ, r̈; ω, ω̇


def test_angular_momentum_about_the_origin_is_the_sum():
    velocities = V + np.cross(OMEGA, X)
    total = (MASSES[:, None] * np.cross(R + X, velocities)).sum(axis=0)
    np.testing.assert_allclose(angular_momentum(M, J, R, V, OMEGA), total, rtol=1e-13)


def test_eulers_equations_are_the_moment_of_the_accelerations():
    accelerations = np.cross(SPIN, X) + np.cross(OMEGA, np.cross(OMEGA, X))
    M_c = (MASSES[:, None] * np.cross(X, accelerations)).sum(axis=0)
    np.testing.assert_allclose(spin_rate(J, OMEGA, M_c), SPIN, rtol=1e-12)


def test_free_body_keeps_its_energy_but_not_as_printed():
    """Erratum 1: as printed, the second component has the wrong sign before J₁ⱼ ωⱼ ω₃."""
    D = J @ OMEGA
    assert abs(D @ spin_rate(J, OMEGA, np.zeros(3))) < 1e-13
    gyro = np.cross(OMEGA, D)
    gyro[1] -= 2 * D[0] * OMEGA[2]
    gain = D @ np.linalg.solve(J, -gyro)
    np.testing.assert_allclose(gain, 2 * D[0] * OMEGA[1] * OMEGA[2], rtol=1e-12)


def test_moving_point_needs_velocities_relative_to_it():
    """(2.28) with D_A from relative velocities; from absolute ones the law is another one.

    D_A (absolute) = D_A (relative) + m a × v_A, and a × v_A changes by −v_A × v_C more.
    """
    r_A, v_A, a_A = np.random.default_rng(5).normal(size=(3, 3))
    accelerations = A + np.cross(SPIN, X) + np.cross(OMEGA, np.cross(OMEGA, X))
    arm = R + X - r_A
    M_A = (MASSES[:, None] * np.cross(arm, accelerations)).sum(axis=0)
    relative = (MASSES[:, None] * np.cross(arm, accelerations - a_A)).sum(axis=0)
    np.testing.assert_allclose(moment_change(M_A, M, a_A, R - r_A), relative, rtol=1e-12)
    velocities = V + np.cross(OMEGA, X)
    absolute = M_A + (MASSES[:, None] * np.cross(velocities - v_A, velocities)).sum(axis=0)
    np.testing.assert_allclose(M_A - M * np.cross(v_A, V), absolute, rtol=1e-12)
