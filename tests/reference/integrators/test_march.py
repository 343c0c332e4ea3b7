"""Where a march lands and ends, stiff slopes, and what is known only up to rounding."""

from itertools import pairwise
from math import cos, sin

import numpy as np
import pytest
from given.machines.problems import (
    BOTH,
    by_scipy,
    kepler,
    kepler_solution,
    oscillator,
    oscillator_solution,
    pendulum,
)

from textmech.reference.integrators import march as marching
from textmech.reference.integrators.explicit import (
    DormandPrince,
    dormand_prince,
    dormand_prince_step,
)
from textmech.reference.integrators.implicit import ByEigenvalues, Radau, Whole, radau
from textmech.reference.integrators.march import IntegrationError, Vector, march
from textmech.reference.integrators.radau import radau_table
from textmech.reference.integrators.slope import leaps, noise

# Samples, rest, and what ends a march: it is told where.


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


# The implicit integrator where the explicit one would creep.


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


# The rounding of the slopes: measured where errors do not fall with the step, and no further.

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
    monkeypatch.setattr(marching, "leaps", lambda f, t, y, h: np.zeros_like(y))
    with pytest.raises(marching.IntegrationError, match="more than 2000 steps"):
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
    monkeypatch.setattr(marching, "noise", lambda *_: None)
    with pytest.raises(marching.IntegrationError, match="underflows"):
        dormand_prince(breaks_loose, TIMES, [0.0, 0.0])
