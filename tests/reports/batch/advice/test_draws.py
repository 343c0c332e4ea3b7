"""Draws of a case's parameters: the same mechanism with other numbers, or none."""

from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech import engines
from textmech.reference.certificate.agreement import Check
from textmech.reports.batch.advice import parameter_draws as draws
from textmech.reports.batch.advice.parameter_draws import APART, DRAWS, drawn, tried_in_draws
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import Store
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.task_results import Results
from textmech.reports.batch.tasks import Pair
from textmech.reports.system import pool


def test_a_draw_is_the_case_with_each_parameter_a_little_off() -> None:
    case = scenes.SHIPPED["rolling_wheel.downhill"]
    found = drawn(case, 1)
    assert found is not None
    assert found.parameters != case.parameters
    for name, value in found.parameters.items():
        assert abs(value - case.parameters[name]) <= APART * abs(case.parameters[name])
    assert (found.name, found.samples, found.allow) == (case.name, case.samples, case.allow)
    same, other = drawn(case, 1), drawn(case, 2)
    assert same is not None
    assert other is not None
    assert same.parameters == found.parameters != other.parameters


def test_some_draws_are_no_case() -> None:
    """Of a block that is to stay: its friction may fall below what its slope asks for, or its
    coefficient of rest below the other."""
    case = scenes.SHIPPED["sliding_block.below"]
    assert any(drawn(case, seed) is None for seed in range(DRAWS))


@pytest.mark.slow
def test_a_recipe_holds_in_some_and_one_that_does_not_help_in_none(tmp_path: Path) -> None:
    case, store, keys = scenes.SHIPPED["bar_pendulum"], Store(tmp_path), Keys.now(None)
    pair = Pair(case, engines.make("mujoco", "shipped"), store, keys.solution(case))
    store.put(pair.key, scenes.solved(case.name))
    with pool.local(2) as working:
        results = Results(working, lambda *_: None, store, keys)
        good = tried_in_draws(pair, Candidate.of({"integrator": "RK4"}, 4e-3), {}, results)
        bad = tried_in_draws(pair, Candidate.of({}, 4e-3), {}, results)
    assert (good.held, bad.held) == (good.tried, 0)
    assert good.tried == bad.tried >= DRAWS - 1
    assert str(good) == f"holds in {good.tried} of {good.tried} draws of its parameters ± 10%"


@pytest.mark.slow
@pytest.mark.mutant("a draw that goes through other phases counts")
def test_a_draw_that_goes_through_other_phases_is_another_case(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Two of six references switch once more, and two are not certified: none of them counts."""
    case, store = scenes.SHIPPED["bar_pendulum"], Store(tmp_path)
    keys = Keys.now(store)
    sound = scenes.solved(case.name)
    other = replace(sound, trajectory=replace(sound.trajectory, switches=np.array([0.1])))
    unsure = replace(sound, checks=(Check("drift", 1.0, 0.5),))
    pair = Pair(case, engines.make("mujoco", "shipped"), store, keys.solution(case))
    store.put(pair.key, sound)
    results: Any = SimpleNamespace(keys=keys)
    results.of = lambda what, function, tasks: {
        key: (sound, other, unsure)[k % 3] for k, key in enumerate(tasks)
    }
    results.anew = lambda what, function, tasks: {key: {"x": (0.5, 0.5)} for key in tasks}
    found = tried_in_draws(pair, Candidate.of({}, 4e-3), {}, results)
    assert (found.held, found.tried) == (DRAWS // 3, DRAWS // 3)
    assert str(found).endswith(
        "; 2 had no reference (as a loop that does not close)"
        "; 2 passed other phases (more or fewer impacts, stops or slips)"
    )
    monkeypatch.setattr(draws, "_phases", lambda reference: 0)
    assert tried_in_draws(pair, Candidate.of({}, 4e-3), {}, results).tried == 2 * DRAWS // 3
