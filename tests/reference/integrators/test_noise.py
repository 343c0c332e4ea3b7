"""The rounding of the slopes: measured where errors do not fall with the step, and no further."""

import numpy as np
import pytest
from given.problems import BOTH

from textmech.reference.integrators import march
from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.integrators.slope import Vector, leaps, noise

ONSET = 0.3 * 9.80665  # no number that stages hit without rounding
TIMES = [ONSET, 4.0, 8.0]
TIGHT = 1e-15  # what a motion is followed with
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


def drawn(t: float, y: Vector) -> Vector:
    """A cart of 1 kg a metre from the wall that its spring hangs on, drawn ever more."""
    x, v = y
    return np.array([v, 2.0 * t - 40.0 * ((1.0 + x) - 1.0)])


@BOTH
def test_what_stands_a_metre_from_where_it_is_measured_starts_from_rest(method):
    """x = (t − sin(ω t)/ω)/20, ω² = 40: for its spring it moves by leaps of 2e-16 m at first."""
    times = np.array([0.0, 0.5, 2.0])
    found = method(drawn, times, [0.0, 0.0], tolerance=TIGHT)
    omega = np.sqrt(40.0)
    np.testing.assert_allclose(found.y[:, 0], (times - np.sin(omega * times) / omega) / 20, 1e-12)
    assert found.steps < 500  # 110 of the explicit method


# m, kg, N/m, N/s, s: some of what is drawn takes its first step before anything is heard
DRAWN = [(1.0, 2.0, 50.0, 1.0, 0.08), (1.59, 4.77, 54.1, 0.24, 0.08), (0.4, 0.9, 120.0, 1.7, 0.04)]


@BOTH
@pytest.mark.parametrize(("away", "mass", "stiffness", "rate", "apart"), DRAWN)
def test_so_it_does_whatever_its_first_step_takes(
    method, away: float, mass: float, stiffness: float, rate: float, apart: float
) -> None:
    def slope(t: float, y: Vector) -> Vector:
        x, v = y
        return np.array([v, (rate * t - stiffness * ((away + x) - away)) / mass])

    times = np.linspace(0.0, 2.0, round(2.0 / apart) + 1)
    found = method(slope, times, [0.0, 0.0], tolerance=TIGHT, most=3000)
    omega = np.sqrt(stiffness / mass)
    wanted = rate / stiffness * (times - np.sin(omega * times) / omega)
    np.testing.assert_allclose(found.y[:, 0], wanted, atol=1e-12 * wanted[-1])


BOUND = 6.0  # N, beside which a force that grows slowly moves by leaps of 9e-16 N


@BOTH
@pytest.mark.parametrize("begins", [0.0, 0.31])
@pytest.mark.parametrize("rate", [0.1, 1e-2, 1e-4, 1e-5, 1e-7])
def test_a_weak_ramp_breaks_it_loose(method, rate: float, begins: float):
    """x = rate τ³/6, to what rounding of 6 N is beside the force that moves it; in few steps.

    At these rates ten looks at even distances happen to see no rounding, or all of it at first.
    """
    times = begins + np.linspace(0.0, 1.0, 26)
    before = BOUND - rate * begins

    def f(t: float, y: Vector) -> Vector:
        return np.array([y[1], (before + rate * t) - BOUND])

    found = method(f, times, [0.0, 0.0], tolerance=TIGHT)
    tau = times - begins
    late = np.spacing(BOUND)  # N: at most by so much is the force another all the time
    assert np.max(np.abs(found.y[:, 0] - rate * tau**3 / 6)) < late
    assert found.steps < 1000


@pytest.mark.slow
@pytest.mark.mutant("of a state that is zero the leaps by which its slope feels it are not heard")
def test_without_its_leaps_it_creeps(monkeypatch: pytest.MonkeyPatch):
    """In 46,000 steps to 0.5 s, or to where they shrink to nothing."""
    monkeypatch.setattr(march, "leaps", lambda f, t, y, h: np.zeros_like(y))
    with pytest.raises(march.IntegrationError, match="more than 2000 steps"):
        dormand_prince(drawn, [0.0, 0.5], [0.0, 0.0], tolerance=TIGHT, most=2000)


def test_leaps_are_those_of_the_sum_and_not_of_what_is_felt_at_once():
    """40 ulp of 1 m; the damper, which takes the speed as it is, adds none."""
    found = leaps(lambda t, y: drawn(t, y) - [0.0, 3.0 * y[1]], 0.0, np.zeros(2), 1e-4)
    ulp = 2.0**-52
    assert found[1] == pytest.approx(40 * ulp / np.sqrt(12), rel=0.5)
    assert found[0] == 0.0
    clock = np.spacing(ONSET) / np.sqrt(12)  # a force that grows with the time leaps as that does
    np.testing.assert_allclose(leaps(breaks_loose, ONSET, np.zeros(2), 1e-4), [0.0, clock])


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
