"""The axes of a body and how they turn, against differences and against cases.space.rotation."""

from typing import Any

import numpy as np
import pytest

from textmech.cases.scene import rotation as words
from textmech.reference.formalisms.derivative import along
from textmech.reference.laws.rotation import (
    acceleration,
    angular_velocity,
    axes,
    axis_rates,
    point,
    quaternion_rates,
    spin,
    turning,
    velocity,
)

RANDOM = np.random.default_rng(7)
Q = RANDOM.normal(size=4)
Q /= np.sqrt(Q @ Q)
OMEGA, OMEGA_DOT, X, R, V, A = RANDOM.normal(size=(6, 3))
E = axes(Q)
E_DOT = along(axes, (Q,), (quaternion_rates(Q, OMEGA),))
EXACT = 1e-14  # of numbers about 1


def close(a: Any, b: Any) -> bool:
    return bool(np.max(np.abs(np.subtract(a, b))) < EXACT)


def test_axes_are_rows() -> None:
    """Erratum 5: turned by 90° about z, body axis 1 is y of the ground."""
    quarter = np.array([np.sqrt(0.5), 0.0, 0.0, np.sqrt(0.5)])
    assert close(axes(quarter), [[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    assert close(E, words.matrix(Q).T)
    assert not close(E, words.matrix(Q))


def test_axes_are_orthonormal_whatever_the_length_of_the_quaternion() -> None:
    assert close(axes(3.0 * Q) @ axes(Q).T, np.eye(3))
    assert np.linalg.det(E) == pytest.approx(1.0, abs=EXACT)


def test_a_point_has_constant_body_coordinates() -> None:
    """(2.1) x_i = (r − r_Ω) · E_i."""
    assert close((point(R, E, X) - R) @ E.T, X)
    assert close(point(R, E, X), R + words.turned(Q, X))


def test_turning_is_skew_and_holds_the_spin() -> None:
    """(2.3), (2.4)."""
    assert close(turning(E, E_DOT) + turning(E, E_DOT).T, 0.0)
    assert close(turning(E, E_DOT) @ E, E_DOT)
    assert close(angular_velocity(E, E_DOT), OMEGA)


def test_the_printed_order_needs_axes_as_rows() -> None:
    """Erratum 5: with E transposed (2.4) gives ground components with the other sign."""
    assert close(angular_velocity(E.T, E_DOT.T), -OMEGA @ E)
    assert not close(angular_velocity(E.T, E_DOT.T), OMEGA)


def test_axes_turn_about_the_spin() -> None:
    """(2.5), against the derivative of the axes."""
    assert close(axis_rates(E, OMEGA), E_DOT)
    assert not close(axis_rates(E, OMEGA @ E), E_DOT)  # ω of ground axes taken for body axes


def test_velocity_is_the_rate_of_the_point() -> None:
    """(2.6), in ground axes and in body axes."""
    moved = along(lambda r, q: point(r, axes(q), X), (R, Q), (V, quaternion_rates(Q, OMEGA)))
    assert close(velocity(V, OMEGA @ E, X @ E), moved)
    assert close(velocity(E @ V, OMEGA, X) @ E, moved)


def test_acceleration_is_the_rate_of_the_velocity() -> None:
    """(2.7), ω and ω̇ in body axes: E turns with them."""

    def moving(v: Any, q: Any, omega: Any) -> Any:
        return velocity(v, omega @ axes(q), X @ axes(q))

    directions = (A, quaternion_rates(Q, OMEGA), OMEGA_DOT)
    moved = along(moving, (V, Q, OMEGA), directions)
    assert close(acceleration(A, OMEGA_DOT @ E, OMEGA @ E, X @ E), moved)


def test_spin_of_the_rates_of_a_quaternion() -> None:
    assert close(spin(Q, quaternion_rates(Q, OMEGA)), OMEGA)
    assert close(spin(Q, np.stack([quaternion_rates(Q, OMEGA), Q], axis=1)).T, [OMEGA, 0.0 * X])


def test_spins_add_up_along_a_chain() -> None:
    """ω_k = ω_{k,k−1} + ω_{k−1,0} (Exercise 2.1), all in ground axes."""
    other = words.product(Q, np.array([0.6, 0.0, 0.8, 0.0]))
    relative = spin(np.array([0.6, 0.0, 0.8, 0.0]), quaternion_rates([0.6, 0.0, 0.8, 0.0], X))
    rates = words.product(quaternion_rates(Q, OMEGA), np.array([0.6, 0.0, 0.8, 0.0]))
    rates = rates + words.product(Q, quaternion_rates([0.6, 0.0, 0.8, 0.0], X))
    assert close(spin(other, rates) @ axes(other), relative @ axes(other) + OMEGA @ E)
