"""What the formalisms refuse, and that their derivatives are exact."""

import numpy as np
import pytest
from given.examples import only
from given.states import states

from textmech.reference.formalisms import lagrange, newton_euler
from textmech.reference.formalisms.derivative import along


@pytest.mark.parametrize("name", ["rolling_wheel", "four_bar"])
def test_constrained_coordinates_are_refused_by_the_unconstrained_equations(name: str):
    t, q, v = next(states(name, "moving"))
    with pytest.raises(ValueError, match=r"multipliers \(2\.60\)"):
        lagrange.accelerations(only(name), t, q, v)


def test_a_function_that_drops_the_complex_step_is_not_taken_for_a_constant():
    with pytest.raises(TypeError, match="lost its complex step"):
        lagrange.derivative(lambda q: abs(q[0]), (np.array([0.3]),), (np.array([1.0]),))
    assert lagrange.derivative(lambda q: 7.0, (np.array([0.3]),), (np.array([1.0]),)) == 0.0


def test_reactions_of_a_flat_rhombus_are_refused():
    with pytest.raises(ValueError, match="undetermined"):
        newton_euler.accelerations(only("rhombus"), 0.0, np.array([0.0, np.pi]), np.zeros(2))


def test_complex_step_is_exact_for_the_momentum():
    """p is linear in v: its slope is the mass matrix, whatever the size of v."""
    mode = only("double_pendulum")
    t, q, v = next(states("double_pendulum", "moving"))
    M = lagrange.mass_matrix(mode, t, q)
    np.testing.assert_allclose(M, M.T, rtol=1e-14)
    p = along(lambda q: lagrange.momentum(mode, t, q, v), (q,), (np.zeros(2),))
    np.testing.assert_allclose(p, 0.0)
    np.testing.assert_allclose(lagrange.momentum(mode, t, q, v), M @ v, rtol=1e-13)
