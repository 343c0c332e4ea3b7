"""When an error is largest, and that an instant is named as one and is no model's."""

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.case import Case
from textmech.cases.trajectory import Trajectory
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.judge.metric import error
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import BEYOND

Make = Callable[..., Trial]
SHIPPED = {"setting": "shipped", "own_step": 1e-3}


@dataclass(frozen=True)
class Off:
    """An engine that is off by so much at these samples, at any step."""

    engine: Any
    by: dict[int, float] = field(default_factory=dict)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.engine, name)

    def run(self, *given: Any, **more: Any) -> Trajectory:
        found = self.engine.run(*given, **more)
        for sample, by in self.by.items():
            found.states["ball"][sample, 0] += by
        return found


def judged(made: Trial, by: dict[int, float]) -> Any:
    trial = replace(made, engine=Off(made.engine, by))
    return next(row for row in compare(trial).rows if row.quantity == "ball.x")


def test_a_row_tells_when_the_error_is_largest(trial: Make) -> None:
    found = judged(trial(rate=0.0, **SHIPPED), {10: 0.3})
    assert (found.verdict, found.when) == (BEYOND, pytest.approx(0.4))
    assert judged(trial(rate=15.0, **SHIPPED), {}).when == 1.0  # it grows to the end
    assert judged(trial(rate=0.0, **SHIPPED), {}).when is None  # there is none


def test_the_first_of_equal_errors_is_told() -> None:
    """Which of them is the largest by its last bit, another machine would say otherwise."""
    wanted = np.zeros(6)
    assert error(np.array([0.1, 1.0, 1.0 + 1e-15, 0.9995, 1.0, 0.2]), wanted).at == 1


def test_the_first_sample_is_named_and_no_model(trial: Make) -> None:
    found = judged(trial(rate=1.0, **SHIPPED), {0: 98.1})
    assert (found.verdict, found.when) == (BEYOND, 0.0)
    assert found.because == "the first sample; elsewhere at most 0.001"


def test_an_error_that_lasts_is_not_the_first_samples(trial: Make) -> None:
    found = judged(trial(rate=0.0, **SHIPPED), dict.fromkeys(range(26), 0.5))
    assert found.when == 0.0
    assert found.because == "does not vanish with the step: 0.5 m stay"


def test_the_first_steps_are_the_start_too(trial: Make) -> None:
    """With steps as large as the samples a contact that has to close takes several of them."""
    coarse = {"setting": "shipped", "own_step": 0.04}
    found = judged(trial(rate=0.0, **coarse), {0: 98.1, 1: 98.1, 2: 60.0})
    assert found.because == "the first sample; elsewhere at most 0"
    found = judged(trial(rate=0.0, **coarse), {1: 98.1, 2: 60.0})
    assert found.because == "beside the start; elsewhere at most 0"
    found = judged(trial(rate=0.0, **coarse), {1: 98.1, 4: 60.0})
    assert found.because.startswith("does not vanish with the step")


def test_what_is_beside_an_event_is_named_after_it(trial: Make, stopping: Case) -> None:
    made = trial(case=stopping, stops=(0.3, 0.7), rate=0.0, **SHIPPED)
    at = replace(made, reference=replace(made.reference, switches=np.array([0.401])))
    found = judged(at, {10: 0.3})  # 0.4 s: one step before
    assert found.because == "beside a switch at 0.401 s; elsewhere at most 0"
    named = replace(made, reference=replace(made.reference, switches=np.array([0.3, 0.5, 0.7])))
    far = judged(named, {10: 0.3})  # 100 steps away from all
    assert far.because.startswith("does not vanish with the step")


def test_the_name_is_the_events(trial: Make, stopping: Case) -> None:
    case = replace(stopping, samples=11)  # every 0.1 s: one of them on the stop at 0.3
    found = judged(trial(case=case, stops=(0.3, 0.7), rate=0.0, **SHIPPED), {3: 0.3})
    assert found.because == "beside stops at 0.3 s; elsewhere at most 0"


def test_an_error_elsewhere_has_its_own_cause(trial: Make) -> None:
    found = judged(trial(rate=20.0, **SHIPPED), {0: 98.1})
    words = "the first sample; elsewhere at most 0.02: the step: it falls with order 1.0"
    assert found.because.startswith(words)


def test_elsewhere_too_a_held_limit_beyond_the_error_is_no_cause(trial: Make) -> None:
    found = judged(trial(follows=True, model=1.2e-2), {0: 98.1})
    words = "the first sample; elsewhere at most 0.013: the step: it falls with order 1.0"
    assert words in found.because
