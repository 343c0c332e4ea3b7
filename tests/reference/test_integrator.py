"""The integrators: order, tables, accuracy, stiffness, samples and failures."""

import dataclasses
from collections.abc import Callable
from itertools import pairwise
from math import asin, cos, sin
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from textmech.reference.integrators.dop853 import DOP853, STAGES
from textmech.reference.integrators.explicit import (
    DormandPrince,
    dormand_prince,
    dormand_prince_step,
)
from textmech.reference.integrators.implicit import radau, radau_step
from textmech.reference.integrators.march import IntegrationError, Slope, Vector, march
from textmech.reference.integrators.radau import Collocation, radau_table

Solution = Callable[[float], Vector]
BOTH = pytest.mark.parametrize("method", [dormand_prince, radau])


def linear(t: float, y: Vector) -> Vector:
    """y' = -2 t y + 2 t + cos t exp(-t^2): it depends on time, and the solution is known."""
    return -2.0 * t * y + 2.0 * t + cos(t) * np.exp(-t * t)


def linear_solution(t: float) -> Vector:
    return np.array([1.0 + sin(t) * np.exp(-t * t)])


def oscillator(t: float, y: Vector) -> Vector:
    return np.array([y[1], -y[0]])


def oscillator_solution(t: float) -> Vector:
    return np.array([cos(t), -sin(t)])


ECCENTRICITY = 0.3


def kepler(t: float, y: Vector) -> Vector:
    cube = (y[0] * y[0] + y[1] * y[1]) ** 1.5
    return np.array([y[2], y[3], -y[0] / cube, -y[1] / cube])


def kepler_solution(t: float) -> Vector:
    e, b = ECCENTRICITY, np.sqrt(1.0 - ECCENTRICITY**2)
    angle = t
    for _ in range(20):  # Newton on Kepler's equation, far more often than needed
        angle -= (angle - e * sin(angle) - t) / (1.0 - e * cos(angle))
    rate = 1.0 / (1.0 - e * cos(angle))
    return np.array([cos(angle) - e, b * sin(angle), -sin(angle) * rate, b * cos(angle) * rate])


def pendulum(t: float, y: Vector) -> Vector:
    return np.array([y[1], -sin(y[0])])


def pendulum_solution(t: float) -> Vector:
    """Released at rest from 2 rad."""
    k = sin(1.0)
    sn, cn, *_ = ellipj(float(ellipk(k * k)) - t, k * k)
    return np.array([2.0 * asin(k * float(sn)), -2.0 * k * float(cn)])


def double_pendulum(t: float, y: Vector) -> Vector:
    """Unit masses and lengths, angles from the vertical."""
    a, b, u, v = y.tolist()
    s, c, g = sin(a - b), cos(a - b), 9.81
    d = 2.0 - c * c
    return np.array(
        [
            u,
            v,
            (-2.0 * g * sin(a) + g * sin(b) * c - s * (v * v + u * u * c)) / d,
            (2.0 * s * u * u + 2.0 * g * sin(a) * c - 2.0 * g * sin(b) + s * c * v * v) / d,
        ]
    )


def prothero_robinson(t: float, y: Vector) -> Vector:
    """Draws every solution to cos t within a microsecond."""
    return np.array([-1e6 * (y[0] - cos(t)) - sin(t)])


def van_der_pol(t: float, y: Vector) -> Vector:
    return np.array([y[1], 1e3 * (1.0 - y[0] * y[0]) * y[1] - y[0]])


# With the time over which the order is measured; for Kepler it ends before the errors of the two
# halves of the orbit begin to cancel.
PROBLEMS = {
    "linear": (linear, linear_solution, 2.0),
    "oscillator": (oscillator, oscillator_solution, 6.0),
    "kepler": (kepler, kepler_solution, 1.5),
    "pendulum": (pendulum, pendulum_solution, 6.0),
}


def observed_order(
    step: Callable[..., Vector], problem: tuple[Slope, Solution, float], counts: list[int], table
) -> float:
    """Slope of log error over log step, the error being the largest of the run."""
    f, solution, end = problem
    errors = []
    for count in counts:
        h, y, worst = end / count, solution(0.0), 0.0
        for i in range(count):
            y = step(f, i * h, y, h, table=table)
            worst = max(worst, float(np.abs(y - solution((i + 1) * h)).max()))
        errors.append(worst)
    assert min(errors) > 1e-13, "rounding, not the method, would be measured"
    return float(-np.polyfit(np.log(counts), np.log(errors), 1)[0])


# Steps short enough for the leading term of the error to rule and long enough for it to stand
# clear of rounding.
EXPLICIT_COUNTS = {
    "linear": [14, 16, 18, 20],
    "oscillator": [10, 14, 18, 24],
    "kepler": [14, 16, 18, 20],
    "pendulum": [30, 36, 42, 48],
}
IMPLICIT_COUNTS = {
    ("linear", 3): [20, 40, 60, 80],
    ("oscillator", 3): [20, 40, 60, 80],
    ("kepler", 3): [25, 35, 45, 55],
    ("pendulum", 3): [60, 80, 100, 140],
    ("linear", 5): [8, 10, 12, 14],
    ("oscillator", 5): [6, 8, 10, 12],
    ("kepler", 5): [8, 10, 12, 14],
    ("pendulum", 5): [20, 24, 28, 32],
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_explicit_order(name: str):
    order = observed_order(dormand_prince_step, PROBLEMS[name], EXPLICIT_COUNTS[name], DOP853)
    assert 7.7 <= order <= 8.5


@pytest.mark.parametrize(("name", "stages"), IMPLICIT_COUNTS)
def test_implicit_order(name: str, stages: int):
    table = radau_table(stages)
    order = observed_order(radau_step, PROBLEMS[name], IMPLICIT_COUNTS[name, stages], table)
    assert abs(order - (2 * stages - 1)) < 0.2


@pytest.mark.parametrize("entry", [("a", (6, 4)), ("a", (11, 10)), ("c", 7), ("b", 8)])
def test_a_wrong_figure_in_the_explicit_table_costs_orders(entry):
    order = observed_order(
        dormand_prince_step, PROBLEMS["linear"], EXPLICIT_COUNTS["linear"], broken(DOP853, *entry)
    )
    assert order < 2.0


@pytest.mark.parametrize("entry", [("a", (0, 1)), ("a", (4, 2)), ("c", 2)])
def test_a_wrong_figure_in_the_implicit_table_costs_orders(entry):
    order = observed_order(
        radau_step, PROBLEMS["linear"], IMPLICIT_COUNTS["linear", 5], broken(radau_table(5), *entry)
    )
    assert order < 2.0


def broken(table, field: str, index):
    values = getattr(table, field).copy()
    values[index] += 1e-3
    return dataclasses.replace(table, **{field: values})


def test_explicit_table_conditions():
    a, b, c = DOP853.a, DOP853.b, DOP853.c
    assert np.abs(a.sum(axis=1) - c).max() < 1e-14
    for k in range(8):
        assert b @ c**k == pytest.approx(1.0 / (k + 1), abs=1e-14)
    for k in range(1, 7):  # two conditions of trees that are not bushes, for each order up to 8
        assert b @ a @ c**k == pytest.approx(1.0 / ((k + 1) * (k + 2)), abs=1e-14)
        assert (b * c) @ a @ c ** (k - 1) == pytest.approx(1.0 / (k * (k + 2)), abs=1e-14)
    assert np.array_equal(a, np.tril(a, -1))
    assert len(b) == STAGES


@pytest.mark.parametrize(("row", "order"), [("e5", 5), ("e3", 3)])
def test_error_rows_vanish_up_to_their_order(row: str, order: int):
    weights = getattr(DOP853, row)
    moments = [abs(weights @ DOP853.c**k) for k in range(order + 1)]
    assert max(moments[:order]) < 1e-14
    assert moments[order] > 1e-5


@pytest.mark.parametrize("stages", range(1, 10))
def test_radau_conditions(stages: int):
    table: Collocation = radau_table(stages)
    a, c, b = table.a, table.c, table.a[-1]
    assert c[-1] == 1.0
    for k in range(1, 2 * stages):  # B(2s - 1)
        assert b @ c ** (k - 1) == pytest.approx(1.0 / k, abs=2e-15)
    assert abs(b @ c ** (2 * stages - 1) - 0.5 / stages) > 1e-12  # and not B(2s)
    for k in range(1, stages + 1):  # C(s)
        assert np.abs(a @ c ** (k - 1) - c**k / k).max() < 2e-15
    weights = b + table.error @ a  # of the embedded formula, with gamma at the start
    assert weights.sum() + table.gamma == pytest.approx(1.0, abs=1e-13)
    for k in range(2, stages + 1):
        assert weights @ c ** (k - 1) == pytest.approx(1.0 / k, abs=1e-13)


def test_radau_with_three_stages_is_the_published_one():
    r = np.sqrt(6.0)
    table = radau_table(3)
    assert np.abs(table.c - [(4 - r) / 10, (4 + r) / 10, 1.0]).max() < 1e-15
    assert np.abs(table.a[2] - [(16 - r) / 36, (16 + r) / 36, 1 / 9]).max() < 1e-15
    published = table.gamma / 3.0 * np.array([-13.0 - 7.0 * r, -13.0 + 7.0 * r, -1.0])
    assert np.abs(table.error - published).max() < 1e-13
    assert 1.0 / table.gamma == pytest.approx(3.0 + 3.0 ** (2 / 3) - 3.0 ** (1 / 3), abs=1e-13)


@BOTH
@pytest.mark.parametrize("name", PROBLEMS)
def test_reference_accuracy(method, name: str):
    f, solution, _ = PROBLEMS[name]
    times = np.linspace(0.0, 10.0, 21)
    exact = np.array([solution(t) for t in times])
    result = method(f, times, exact[0], tolerance=1e-14)
    assert np.abs(result.y - exact).max() < 1e-12


@BOTH
def test_the_error_follows_the_tolerance(method):
    times = np.array([0.0, 10.0])
    exact = kepler_solution(10.0)
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-12):
        y = method(kepler, times, kepler_solution(0.0), tolerance=tolerance).y
        assert np.abs(y[-1] - exact).max() < 100.0 * tolerance


def test_double_pendulum_against_each_other_and_scipy():
    times, start = np.linspace(0.0, 5.0, 26), [1.0, 0.5, 0.0, 0.0]
    explicit = dormand_prince(double_pendulum, times, start, tolerance=1e-14)
    implicit = radau(double_pendulum, times, start, tolerance=1e-14)
    assert np.abs(explicit.y - implicit.y).max() < 1e-12
    theirs = by_scipy(double_pendulum, times, start, method="DOP853", rtol=1e-12, atol=1e-12)
    assert np.abs(explicit.y - theirs).max() < 1e-9
    theirs = by_scipy(double_pendulum, times, start, method="Radau", rtol=1e-8, atol=1e-8)
    assert np.abs(explicit.y - theirs).max() < 1e-5


def by_scipy(f: Slope, times: Vector, start: list[float], **options: Any) -> Vector:
    return solve_ivp(f, (times[0], times[-1]), start, t_eval=times, **options).y.T


@BOTH
def test_long_double_pendulum_keeps_its_energy(method):
    y = method(double_pendulum, [0.0, 10.0, 20.0], [1.0, 0.5, 0.0, 0.0], tolerance=1e-14).y
    a, b, u, v = y.T
    motion = u * u + 0.5 * v * v + u * v * np.cos(a - b)
    energy = motion - 9.81 * (2.0 * np.cos(a) + np.cos(b))
    assert np.abs(energy - energy[0]).max() < 1e-12 * abs(energy[0])


@pytest.mark.parametrize("start", [1.0, 2.0])
def test_prothero_robinson(start: float):
    """Also with a start far off the smooth solution, whose approach must be followed."""
    times = np.linspace(0.0, 10.0, 6)
    result = radau(prothero_robinson, times, [start])
    assert np.abs(result.y[1:, 0] - np.cos(times[1:])).max() < 1e-12
    assert result.steps < 200


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


def test_steps_land_on_the_samples():
    times = np.array([0.1, 0.1 + 1e-9, 0.7, 1.0 / 3.0 + 1.0, 9.9])
    method = DormandPrince(oscillator, 2, 1e-12)
    steps = list(march(method, times, oscillator_solution(0.1)))
    assert set(times[1:]) <= {step.t_next for step in steps}
    assert all(one.t_next == two.t for one, two in pairwise(steps))
    again = dormand_prince_step(oscillator, steps[-1].t, steps[-1].y, steps[-1].h)
    assert np.abs(again - steps[-1].y_next).max() < 1e-15


@BOTH
def test_a_sample_shared_by_two_grids_has_the_same_state(method):
    coarse = method(pendulum, [0.0, 5.0, 10.0], [2.0, 0.0], tolerance=1e-14)
    fine = method(pendulum, np.linspace(0.0, 10.0, 101), [2.0, 0.0], tolerance=1e-14)
    assert np.abs(coarse.y - fine.y[::50]).max() < 1e-12


@BOTH
def test_rest_at_the_origin(method):
    """No component has a size there; one drawn out of rest by a force must still be followed."""
    assert not method(pendulum, [0.0, 10.0], [0.0, 0.0]).y.any()
    pushed = method(lambda t, y: np.array([y[1], sin(t)]), [0.0, 3.0], [0.0, 0.0])
    assert np.abs(pushed.y[1] - [3.0 - sin(3.0), 1.0 - cos(3.0)]).max() < 1e-12


@BOTH
def test_one_sample_is_the_start(method):
    result = method(pendulum, [3.0], [2.0, 0.0])
    assert result.steps == 0
    assert result.y.tolist() == [[2.0, 0.0]]


@BOTH
def test_blow_up_is_reported_where_it_happens(method):
    with pytest.raises(IntegrationError, match="at t = ") as caught:
        method(lambda t, y: y * y, [0.0, 2.0], [1.0])
    assert caught.value.time == pytest.approx(1.0, abs=1e-10)


@BOTH
def test_values_that_are_not_finite(method):
    with pytest.raises(IntegrationError, match="not finite") as caught:
        method(lambda t, y: np.array([np.nan if t > 0.5 else 1.0]), [0.0, 2.0], [0.0])
    assert caught.value.time == pytest.approx(0.5, abs=1e-10)
    with pytest.raises(IntegrationError, match=r"not finite at t = 0\.0"):
        method(lambda t, y: y * np.nan, [0.0, 2.0], [1.0])


@BOTH
def test_exceptions_of_the_slope_count_as_not_finite(method):
    def wall(t: float, y: Vector) -> Vector:
        return np.array([1.0 if t < 1.0 else 1.0 / 0.0])

    with pytest.raises(IntegrationError) as caught:
        method(wall, [0.0, 2.0], [1.0])
    assert isinstance(caught.value.__cause__, ZeroDivisionError)


@BOTH
def test_too_many_steps(method):
    with pytest.raises(IntegrationError, match="more than 10 steps"):
        method(kepler, [0.0, 100.0], kepler_solution(0.0), most=10)


@BOTH
@pytest.mark.parametrize("times", [[0.0, 1.0, 1.0], [1.0, 0.0], [0.0, np.inf], []])
def test_times_must_increase(method, times):
    with pytest.raises(ValueError, match="increasing"):
        method(oscillator, times, [1.0, 0.0])
