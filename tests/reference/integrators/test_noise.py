"""The rounding of the slopes: measured where errors do not fall with the step, and no further."""

import numpy as np
import pytest
from given.problems import BOTH

from textmech.reference.integrators import march
from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.integrators.slope import Vector, noise

ONSET = 0.3 * 9.80665  # no number that stages hit without rounding
TIMES = [ONSET, 4.0, 8.0]
PEAK = np.array([1.0, 1.0])


def breaks_loose(t: float, y: Vector) -> Vector:
    """A force t against a friction of 2.9: from rest, v = τ²/2 and x = τ³/6."""
    return np.array([y[1], t - ONSET])


@BOTH
def test_a_block_at_the_origin_breaks_loose(method):
    """Nothing has a size there, and the slope is known to the rounding of t only."""
    found = method(breaks_loose, TIMES, [0.0, 0.0])
    tau = np.array(TIMES) - ONSET
    np.testing.assert_allclose(found.y, np.array([tau**3 / 6, tau**2 / 2]).T, rtol=1e-13)


@BOTH
@pytest.mark.parametrize("unit", [1e-9, 1e-3, 1e6])
def test_in_any_unit(method, unit: float):
    """No length is built into the measure: nanometres and megametres move alike."""
    found = method(lambda t, y: np.array([y[1], unit * (t - ONSET)]), TIMES, [0.0, 0.0])
    one = method(breaks_loose, TIMES, [0.0, 0.0])
    np.testing.assert_allclose(found.y, unit * one.y, rtol=1e-13)


@pytest.mark.parametrize("size", [1e-14, 1e-10])
def test_noise_is_measured(size: float):
    random = np.random.default_rng(seed=1)

    def f(t: float, y: Vector) -> Vector:
        return np.array([np.sin(t) + size * random.standard_normal(), np.cos(t)])

    found = noise(f, 0.7, np.array([0.0, 1.0]), 0.5, PEAK)
    assert found is not None
    assert found[0] == pytest.approx(size, rel=0.9)
    assert found[1] < 1e-15


def test_a_smooth_slope_has_none_beyond_its_rounding():
    found = noise(lambda t, y: np.exp(5.0 * y), 0.0, np.array([1.0, 2.0]), 1e-4, PEAK)
    assert found is not None
    assert (found < 5e-15 * np.exp([5.0, 10.0])).all()


def test_noise_as_loud_as_the_slope_is_no_rounding():
    """So near a singular pose the step still shrinks, and the motion is given up."""
    random = np.random.default_rng(seed=1)
    assert noise(lambda t, y: random.standard_normal(2), 0.0, PEAK, 0.1, PEAK) is None


@pytest.mark.mutant("error of a step relative to a state that is exactly zero")
def test_without_it_the_block_is_stuck(monkeypatch: pytest.MonkeyPatch):
    """The mistake this is for: an error relative to a state that is exactly zero."""
    monkeypatch.setattr(march, "noise", lambda *_: None)
    with pytest.raises(march.IntegrationError, match="underflows"):
        dormand_prince(breaks_loose, TIMES, [0.0, 0.0])
