"""Samples, rest, and what ends a march: it is told where."""

from itertools import pairwise
from math import cos, sin

import numpy as np
import pytest
from given.problems import (
    BOTH,
    kepler,
    kepler_solution,
    oscillator,
    oscillator_solution,
    pendulum,
)

from textmech.reference.integrators.explicit import DormandPrince, dormand_prince_step
from textmech.reference.integrators.march import IntegrationError, Vector, march


def test_steps_land_on_the_samples():
    times = np.array([0.1, 0.1 + 1e-9, 0.7, 1.0 / 3.0 + 1.0, 9.9])
    method = DormandPrince(oscillator, 2, 1e-12)
    steps = list(march(method, times, oscillator_solution(0.1)))
    assert set(times[1:]) <= {step.t_next for step in steps}
    assert all(one.t_next == two.t for one, two in pairwise(steps))
    again = dormand_prince_step(oscillator, steps[-1].t, steps[-1].y, steps[-1].h)
    assert np.abs(again - steps[-1].y_next).max() < 1e-15


def test_a_step_cut_short_does_not_shorten_those_behind_it():
    """By two samples that are next to each other: from 1e-9 s a step has to grow twelvefold."""

    def steps(times: list[float]) -> int:
        method = DormandPrince(oscillator, 2, 1e-12)
        return sum(step.t >= 5.0 for step in march(method, np.array(times), [1.0, 0.0]))

    assert steps([0.0, 5.0, 5.0 + 1e-9, 10.0]) <= steps([0.0, 5.0, 10.0]) + 1


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


@pytest.mark.slow
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
