"""The implicit integrator where the explicit one would creep."""

from math import cos, sin

import numpy as np
import pytest
from given.problems import by_scipy

from textmech.reference.integrators.implicit import ByEigenvalues, Radau, Whole, radau
from textmech.reference.integrators.march import Vector
from textmech.reference.integrators.radau import radau_table


def prothero_robinson(t: float, y: Vector) -> Vector:
    """Draws every solution to cos t within a microsecond."""
    return np.array([-1e6 * (y[0] - cos(t)) - sin(t)])


def van_der_pol(t: float, y: Vector) -> Vector:
    return np.array([y[1], 1e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]])


@pytest.mark.parametrize("start", [1.0, 2.0])
def test_prothero_robinson(start: float):
    """Also with a start far off the smooth solution, whose approach must be followed."""
    times = np.linspace(0.0, 10.0, 6)
    result = radau(prothero_robinson, times, [start])
    assert np.abs(result.y[1:, 0] - np.cos(times[1:])).max() < 1e-12
    assert result.steps < 200


@pytest.mark.slow
def test_van_der_pol_against_scipy():
    """Samples away from the jumps, where the state is as well determined as the time of a jump."""
    times = np.array([0.0, 300.0, 600.0, 1000.0, 1400.0])
    result = radau(van_der_pol, times, [2.0, 0.0])
    theirs = by_scipy(van_der_pol, times, [2.0, 0.0], method="Radau", rtol=1e-9, atol=1e-12)
    assert np.abs(result.y - theirs).max() < 1e-7
    assert result.steps < 600
    other = radau(van_der_pol, times, [2.0, 0.0], stages=7, tolerance=1e-14)
    assert np.abs(result.y - other.y).max() < 1e-10


def test_a_given_jacobian_saves_evaluations():
    def jacobian(t: float, y: Vector) -> Vector:
        return np.array([[0.0, 1.0], [-2e3 * y[0] * y[1] - 1.0, 1e3 * (1.0 - y[0] * y[0])]])

    times = [0.0, 1000.0]
    with_it = radau(van_der_pol, times, [2.0, 0.0], jacobian=jacobian)
    without = radau(van_der_pol, times, [2.0, 0.0])
    assert with_it.evaluations < without.evaluations
    assert np.abs(with_it.y - without.y).max() < 1e-10


@pytest.mark.parametrize("stages", [1, 2, 5, 7])
def test_stages_are_solved_by_eigenvalues_as_in_one_matrix(stages: int):
    """1 − h A ⊗ J solved as one matrix of s n rows, and as s of n rows."""
    table, random = radau_table(stages), np.random.default_rng(seed=1)
    scaled, right = random.standard_normal((4, 4)), random.standard_normal((stages, 4))
    whole = np.eye(4 * stages) - np.kron(table.a, scaled)
    known = np.linalg.solve(whole, right.ravel()).reshape(right.shape)
    for way in (ByEigenvalues, Whole):
        np.testing.assert_allclose(way(table, scaled).solve(right), known, atol=1e-11)


@pytest.mark.parametrize("ratio", [0.01, 0.7, 1.0, 2.9])
def test_a_polynomial_is_continued(ratio: float):
    """Of increments that are the powers of the nodes, those of the next step are powers as well."""
    table = radau_table(5)
    rounding = 1e-14 * np.abs(table.continued(ratio)).max()
    for power in range(1, 6):
        known = (1.0 + ratio * table.c) ** power - 1.0
        found = table.continued(ratio) @ table.c**power - 1.0
        np.testing.assert_allclose(found, known, rtol=0.0, atol=rounding)


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("part", [1e-9, 1e-14, 1e-17])
def test_a_step_next_to_none_is_a_step(part: float):
    """As a root-finder tries them: from the nodes of such a step the last one's end is not told."""
    method = Radau(van_der_pol, 1e-13, radau_table(5))
    y, h = np.array([2.0, 0.0]), 1e-3
    size = np.array([2.0, 1.0])
    there = y + method.attempt(0.0, y, h, size)
    method.begin(h, there)
    moved = method.attempt(h, there, part * h, size)
    np.testing.assert_allclose(moved, part * h * van_der_pol(h, there), rtol=1e-6)


@pytest.mark.mutant("a Jacobian by steps as long as another unit's")
def test_a_small_state_beside_a_large_one_has_a_jacobian_of_its_own() -> None:
    """A molecule's place [m] and turn [rad/s], both damped: x = x₀ e⁻ˢ, 22 powers of ten apart."""

    def f(t: float, y: Vector) -> Vector:
        x, w = y
        return np.array([-1e13 * x * (1 + (x / 4e-10) ** 2), -2e13 * w])

    found = radau(f, [0.0, 4e-13], [4e-10, 1e12])
    assert found.y[-1, 0] == pytest.approx(4e-10 / np.sqrt(2 * np.exp(8.0) - 1), rel=1e-8)
    assert found.evaluations < 2000
