"""Which digits are told: of a certificate a power of ten above it, of a row what is no metric."""

from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from given.report_folders import CERTIFICATE

from textmech.cases.case import Case
from textmech.reference.certificate.agreement import Check
from textmech.reports.batch import suite
from textmech.reports.batch.suite import Report
from textmech.reports.compare.judge import metric
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import FAILS
from textmech.reports.output import motion_files, write

ERRORS = 10.0 ** np.random.default_rng(5).uniform(-16, 2, 50)


def known(error: float, module: Any = write) -> float:
    """What is written of a certified error."""
    (frame,) = [
        frame
        for name, frame in module.tables(
            Report(certificates=[replace(CERTIFICATE, certified=error)]), []
        ).items()
        if name == "reference.csv"
    ]
    return float(frame["certified"].iloc[0])


@pytest.mark.slow
@pytest.mark.mutant("a certificate that is told smaller than it is")
def test_a_certified_error_is_told_larger_and_by_less_than_ten_times() -> None:
    for error in ERRORS.tolist():
        assert error <= known(error) < 10 * error
    down = otherwise(write, "10.0 ** math.ceil(math.log10", "10.0 ** math.floor(math.log10")
    assert known(3e-9, down) == pytest.approx(1e-9)


@pytest.mark.mutant("digits of rounding are told")
def test_what_rounding_makes_of_a_motion_is_no_digit(trial: Callable[..., Trial]) -> None:
    """A random walk of 1000 steps, each off by the last bit of 1 m, stays below the floor."""
    made = trial()
    floor = metric.floor(made, "ball.x", 1e-3)
    chance = np.random.default_rng(1)
    walks = np.cumsum(chance.choice([-1, 1], (200, 1000)), axis=1) * metric.EPSILON
    assert np.max(np.abs(walks)) < floor < 100 * np.max(np.abs(walks))
    assert metric.round_to_floor(1 / 3, floor) == pytest.approx(1 / 3, abs=10 * floor)
    assert metric.round_to_floor(floor / 3, floor) == 0.0
    bare = otherwise(metric, "MARGIN * EPSILON * made", "EPSILON * made / MARGIN")
    assert bare.floor(made, "ball.x", 1e-3) < np.max(np.abs(walks))


@pytest.mark.mutant("a certificate that fails alone fails no run")
def test_a_certificate_that_fails_fails_the_run() -> None:
    assert not Report(certificates=[CERTIFICATE]).fails
    assert Report(certificates=[CERTIFICATE, replace(CERTIFICATE, verdict=FAILS)]).fails


def times(case: Case, own: Case, module: Any = motion_files) -> list[float]:
    """When a run's poses are told to be."""
    ball = np.zeros((own.samples, 3))
    pair = SimpleNamespace(
        case=case, sampled=own, engine=SimpleNamespace(name="mujoco", setting="shipped")
    )
    run = SimpleNamespace(
        pair=pair, realised="native", outcome=SimpleNamespace(samples={"ball": ball})
    )
    trajectory = SimpleNamespace(states={"ball": np.zeros((case.samples, 6))})
    report = SimpleNamespace(
        tried=[run], solutions={case.name: SimpleNamespace(trajectory=trajectory)}
    )
    frame = module.poses(report, case)
    assert frame.index.tolist() == [*range(len(frame))]  # else Parquet has a column more
    told = frame[(frame["engine"] == "mujoco") & (frame["field"] == "x")]
    return told["t [s]"].tolist()


@pytest.mark.mutant("poses at the case's samples, whatever the engine's own step")
def test_poses_are_told_at_the_engines_own_samples(moving: Case) -> None:
    own = replace(moving, duration=0.9, samples=moving.samples)
    assert times(moving, own) == pytest.approx(own.times.tolist())
    other = otherwise(
        motion_files, "one.pair.sampled.times, one.outcome", "case.times, one.outcome"
    )
    assert times(moving, own, other) == pytest.approx(moving.times.tolist())


@pytest.mark.mutant("a momentum that stays zero is known to all its digits")
def test_a_sum_that_cancels_is_known_as_its_parts_are(trial: Callable[..., Trial]) -> None:
    """The ball moves from the origin along x: r × m v is zero, of two numbers that are rounded.

    A difference of 2.11e-12 there was 2.1e-12 on another processor.
    """
    floor = metric.floor(trial(), "momentum.angular", 1e-3)
    ball: Any = trial().case.scene.bodies["ball"]
    made = ball.mass * trial().case.duration * 1.0  # kg m²/s: m r v at the end
    assert floor == pytest.approx(metric.MARGIN * metric.EPSILON * made * 1000)
    summed = otherwise(metric, 'if quantity.part == "momentum":', "if False:")
    assert summed.floor(trial(), "momentum.angular", 1e-3) == 0.0


def check(difference: float, bound: float, *, measured: bool = True, module: Any = suite) -> Any:
    """The difference and the bound of a check as its certificate has them."""
    solution: Any = SimpleNamespace(system="generated", checks=[
        Check("joints hold", difference, bound, measured=measured)])  # fmt: skip
    case: Any = SimpleNamespace(name="swing", origin="")
    (found,) = module._certificates(case, solution)
    return found.difference, pytest.approx(found.bound)


@pytest.mark.mutant("a bound that rounding makes is told to a power of ten")
def test_a_bound_that_rounding_makes_is_told_to_a_power_of_a_thousand() -> None:
    """But not where the check fails, nor of a bound that a law sets."""
    for bound in (1e-12, 1e-11, 1e-10, 1e-9):
        assert check(0.4e-12, bound) == (0.0, 1e-9)
    assert check(0.0, 1e-8) == check(0.0, 1e-6) == (0.0, 1e-6)
    assert check(1.2e-12, 1e-12) == (pytest.approx(1.2e-12), 1e-12)
    assert check(1e-13, 1e-12, measured=False) == (0.0, 1e-12)
    tens = otherwise(suite, "1000.0 ** ceil(log10(check.bound) / 3 - EDGE)", "check.bound")
    assert check(0.0, 1e-8, module=tens) == (0.0, 1e-8)


@pytest.mark.mutant("a share of a bound is told to a digit that is rounding's")
def test_a_share_of_a_bound_is_a_power_of_ten() -> None:
    """Of one processor it is 0.002, of another 0.004."""

    def share(of: float, module: Any = write) -> float:
        row = replace(CERTIFICATE, difference=of, certified=1e-9)
        return module._as_known([row], [])[0].difference

    assert [share(of) for of in (0.0, 0.001, 0.002, 0.004)] == pytest.approx([0, 1e-3, 1e-2, 1e-2])
    digits = otherwise(write, "difference=_known(row.difference, 0.0)", "difference=row.difference")
    assert share(0.002, digits) == 0.002
