"""One compilation for all steps: the model that is written into is the one its script gives."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Iterator
from typing import Any

import mujoco
import numpy as np
import pytest
from given import scenes
from given.planning import CASES, planned

from textmech.cases.case import Case
from textmech.engines.mujoco import MuJoCo, compilation
from textmech.reports.judge.compare import compare
from textmech.reports.trial.start import assembled, first
from textmech.reports.trial.trial import Trial

TUNED = MuJoCo("tuned")


def fields(thing: Any, prefix: str = "") -> Iterator[tuple[str, Any]]:
    """Every number and array of a compiled model, its options and statistics too."""
    for name in dir(thing):
        if name.startswith("_"):
            continue
        value = getattr(thing, name)
        if isinstance(value, np.ndarray | int | float | bytes):
            yield prefix + name, value
        elif type(value).__name__.startswith("Mj") and prefix == "":
            yield from fields(value, f"{name}.")


def differing(a: mujoco.MjModel, b: mujoco.MjModel) -> list[str]:
    both = list(zip(fields(a), fields(b), strict=True))
    assert len(both) > 300
    return [name for (name, x), (_, y) in both if not np.array_equal(x, y)]


@pytest.mark.whole
@pytest.mark.parametrize("case", CASES.values(), ids=list(CASES))
def test_it_equals_the_compiled_script_field_by_field(case: Case) -> None:
    start = assembled(case)
    for setting in ("shipped", "tuned"):
        engine = MuJoCo(setting)
        plan = planned(engine, case.scene, start)
        for step in (1.25e-4, compilation.NOMINAL, 8e-3):
            for used in (plan, plan.held_at(2e-3)):
                model, data, _ = engine._placed(case.scene, start, step, used)
                text = engine.script(case.scene, start, step, used)
                wanted = mujoco.MjModel.from_xml_string(text)
                assert not differing(model, wanted)
                began = mujoco.MjData(wanted)
                mujoco.mj_resetDataKeyframe(wanted, began, 0)
                assert np.array_equal(data.qpos, began.qpos)


def test_a_step_that_is_not_written_is_seen() -> None:
    case = CASES["four_bar"]
    start = assembled(case)
    plan = planned(TUNED, case.scene, start)
    a, b, c = (
        compilation.compiled(case.scene, start, step, used)[0]
        for step, used in ((1e-3, plan), (1e-4, plan), (1e-4, plan.held_at(1e-3)))
    )
    assert differing(a, b) == ["eq_solref", "opt.timestep"]
    assert differing(a, c) == ["opt.timestep"]


@pytest.mark.whole
@pytest.mark.parametrize("name", ["four_bar", "rolling_wheel.pushed"])
def test_a_trial_compiles_once(name: str) -> None:
    case = CASES[name]
    reference = scenes.solved(name).trajectory
    compilation._model.cache_clear()
    trial = Trial(case, reference, TUNED, planned(TUNED, case.scene, first(reference)))
    assert len({row.ladder for row in compare(trial).rungs}) == 2
    found = compilation._model.cache_info()
    assert found.misses == 1
    assert found.hits > 10  # the audit, the protocol, and every rung of both ladders
