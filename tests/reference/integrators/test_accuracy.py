"""What both integrators reach at the tolerance that the reference uses."""

import numpy as np
import pytest
from given.problems import BOTH, PROBLEMS, kepler, kepler_solution

from textmech.reference.integrators import march
from textmech.reference.integrators.explicit import dormand_prince


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


@pytest.mark.slow
def test_what_rounding_cuts_off_a_step_is_carried_on():
    """Steps of 1e-5 s, 20000 of them: a plain sum would be off by a hundred ulp and more."""
    times = np.linspace(0.0, 0.2, 20001)
    found = dormand_prince(lambda t, y: np.full(1, 1.0 / 3.0), times, [1.0])
    assert abs(found.y[-1, 0] - (1.0 + 0.2 / 3.0)) <= 20 * np.spacing(1.0)


def summed(tolerance: float = 1e-13) -> float:
    """How far y = 1000 + t/3 is off after ten thousand steps, in its last digits."""
    times = np.linspace(0.0, 1.0, 10_001)
    y = dormand_prince(lambda t, y: np.array([1.0 / 3.0]), times, [1000.0], tolerance=tolerance).y
    return float(np.abs(y[:, 0] - (1000.0 + times / 3.0)).max() / np.spacing(1000.0))


@pytest.mark.slow
def test_what_rounding_cuts_off_a_step_is_kept():
    """A step adds 3e-5, of which 1000 has eight digits."""
    assert summed() <= 1.0


@pytest.mark.slow
@pytest.mark.mutant("what rounding cuts off a step is lost")
def test_a_sum_that_is_not_compensated_is_seen(monkeypatch: pytest.MonkeyPatch):
    accept = march._Walker._accept

    def lossy(self, *given):
        step = accept(self, *given)
        self.low = 0.0 * self.low
        return step

    monkeypatch.setattr(march._Walker, "_accept", lossy)
    assert summed() > 10.0
