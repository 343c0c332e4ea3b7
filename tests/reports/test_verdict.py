"""Verdicts asked by themselves: no number, one end of an interval, a limit nobody is sure of."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.case import Case, Deviation
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.reports.compare.judge import metric
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.judge.convergence import Convergence
from textmech.reports.compare.judge.verdict import verdict
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import ANOTHER, BEYOND, DEVIATES, DIVERGED, FAILS, TEXTBOOK

Make = Callable[..., Trial]
SHIPPED = {"setting": "shipped", "own_step": 1e-3}
SETTLED = Convergence(TEXTBOOK, {1e-3: 1.0}, None)


@pytest.mark.parametrize(("setting", "word"), [({}, FAILS), (SHIPPED, BEYOND)])
@pytest.mark.parametrize("bars", [{}, {"reach": {"mujoco": {"ball.x": 1e-3}}}])
def test_what_is_no_number_never_agrees(
    trial: Make, moving: Case, setting: dict[str, Any], word: str, bars: dict[str, Any]
) -> None:
    made = trial(case=replace(moving, **bars), **setting)
    assert verdict(made, "ball.x", math.nan, SETTLED, "")[0] == word


def test_a_declared_interval_does_not_hold_what_is_no_number(trial: Make, moving: Case) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("other law", by=(2e-2, 4e-2))}}
    made = trial(case=replace(moving, deviates=declared), **SHIPPED)
    assert verdict(made, "ball.x", math.nan, SETTLED, "")[0] == FAILS


@pytest.mark.parametrize(("setting", "word"), [({}, FAILS), (SHIPPED, DIVERGED)])
def test_an_engine_that_answers_with_no_number_has_diverged(
    trial: Make, setting: dict[str, Any], word: str
) -> None:
    rows = compare(trial(model=math.nan, **setting)).rows
    assert next(row for row in rows if row.quantity == "ball.x").verdict == word


@pytest.mark.parametrize("name", ["ball.x", "ball.speed", "energy.total", "momentum.angular"])
def test_what_is_observed_of_no_number_is_none(moving: Case, name: str) -> None:
    ball = np.full((3, 6), np.nan)
    found = observe(moving.scene, Trajectory(np.arange(3.0), {"ball": ball}, {}), name)
    assert np.all(np.isnan(found))


@pytest.mark.parametrize(
    ("largest", "word"), [(1e-2, FAILS), (2e-2, DEVIATES), (4e-2, DEVIATES), (5e-2, FAILS)]
)
def test_an_interval_has_two_ends(trial: Make, moving: Case, largest: float, word: str) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("other law", by=(2e-2, 4e-2))}}
    made = trial(case=replace(moving, deviates=declared), **SHIPPED)
    assert verdict(made, "ball.x", largest, SETTLED, "")[0] == word


@pytest.mark.parametrize(
    ("uncertainty", "word"), [(1e-4, DEVIATES), (1.9e-3, DEVIATES), (2.1e-3, FAILS), (None, FAILS)]
)
def test_a_declared_limit_must_be_certain(
    trial: Make, moving: Case, uncertainty: float | None, word: str
) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2e-2)}}
    made = trial(case=replace(moving, deviates=declared), **SHIPPED)
    found = replace(SETTLED, verdict=ANOTHER, limit=2e-2, uncertainty=uncertainty)
    assert verdict(made, "ball.x", 2e-2, found, "")[0] == word


def test_a_declared_limit_on_a_ladder_that_did_not_settle_is_gone(
    trial: Make, moving: Case
) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2e-2)}}
    made = trial(case=replace(moving, deviates=declared), **SHIPPED)
    found = replace(SETTLED, limit=2e-2, uncertainty=1e-6)
    assert verdict(made, "ball.x", 2e-2, found, "")[0] == FAILS


def test_the_size_of_an_error_typed() -> None:
    found = metric.error(np.array([1.0, 5.0, 2.0, 2.0]), np.array([1.0, 2.0, -2.0, 3.0]))
    assert found.largest == 4.0
    assert found.rms == pytest.approx(math.sqrt((9 + 16 + 1) / 4))
    assert found.final == 1.0
    assert found.at == 2


@pytest.mark.parametrize(
    ("number", "floor", "told"),
    [
        (3.47e-10, 2e-12, 3.5e-10),
        (3.47e-10, 1e-12, 3.47e-10),
        (4.9e-12, 2e-12, 0.0),
        (0.123456, 1e-12, 0.123456),
        (math.inf, 1e-12, math.inf),
        (0.3, 0.0, 0.3),
    ],
)
def test_digits_below_the_floor_are_not_told(number: float, floor: float, told: float) -> None:
    assert metric.round_to_floor(number, floor) == pytest.approx(told, rel=1e-9)


def test_an_uncertainty_is_never_told_as_none() -> None:
    assert metric.round_up_to_floor(1e-15, 2e-12) == pytest.approx(1e-11)
