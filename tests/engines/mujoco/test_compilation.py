"""One compilation for all steps: the model that is written into is the one its script gives."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from dataclasses import replace
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np
import pytest
from given import engine_scenes as given
from given import scenes
from given.models import differing
from given.planning import CASES, NATIVE, begun, planned

from textmech.cases.scene import Scene
from textmech.engines.engine import Plan, Realised, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.adapter import compilation
from textmech.engines.mujoco.model.rods import with_rods
from textmech.engines.mujoco.model.tree import called
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.trial.start import assembled, first
from textmech.reports.compare.trial.trial import Trial

TUNED = MuJoCo("tuned")


@pytest.mark.slow
@pytest.mark.parametrize("name", dict(NATIVE))
def test_it_equals_the_compiled_script_field_by_field(name: str) -> None:
    scene, start = begun(name)
    for setting in ("shipped", "tuned"):
        engine = MuJoCo(setting)
        plan = planned(engine, scene, start)
        for step in (1.25e-4, compilation.NOMINAL, 8e-3):
            for used in (plan, plan.held_at(2e-3)):
                model, data = placed(engine, scene, start, step, used)
                text = unseen(engine.script(scene, start, step, used))
                wanted = mujoco.MjModel.from_xml_string(text)
                assert not differing(model, wanted)
                began = mujoco.MjData(wanted)
                mujoco.mj_resetDataKeyframe(wanted, began, 0)
                assert np.array_equal(data.qpos, began.qpos)


def unseen(text: str) -> str:
    """The file without what is only there to be seen."""
    root = ET.fromstring(text)
    for body in root.iter("body"):
        for geom in body.findall("geom[@mass='0']"):
            body.remove(geom)
    return ET.tostring(root, encoding="unicode")


@pytest.mark.slow
@pytest.mark.parametrize("name", dict(NATIVE))
def test_what_is_seen_weighs_and_touches_nothing(name: str) -> None:
    """Every body has a shape; with them the model has the same masses, inertias and contacts."""
    scene, start = begun(name)
    text = TUNED.script(scene, start, 1e-3, planned(TUNED, scene, start))
    seen, bare = (mujoco.MjModel.from_xml_string(t) for t in (text, unseen(text)))
    assert all(seen.body(called(body)).geomnum[0] for body in scene.bodies)
    for field in ("body_mass", "body_inertia", "body_ipos", "body_iquat", "npair", "nq"):
        assert np.array_equal(getattr(seen, field), getattr(bare, field)), field
    shapes = [i for i in range(seen.ngeom) if seen.geom_group[i] == 1]
    assert not seen.geom_contype[shapes].any()
    assert not seen.geom_conaffinity[shapes].any()
    assert np.all(seen.geom_size[shapes, 0] > 0)


def placed(
    engine: MuJoCo, scene: Any, start: Start, step: float, plan: Plan
) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """What a run is given."""
    scene, start = with_rods(scene, start)
    model, data, _ = compilation.placed(scene, start, step, plan, settles=engine.setting == "tuned")
    return model, data


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


SHORT = np.array([0.0, 2e-3, 4e-3])
SLIPPING = given.incline(given.BLOCK, given.touching("block", 0.2, static=0.5), slope=0.1)
PARTS = ("qpos", "qvel", "qacc_warmstart", "qfrc_applied", "ctrl", "act", "time", "ncon", "nefc")
RUNS: dict[str, tuple[Scene, Start, Realised]] = {
    "by law": (*begun("anisotropic_drift"), "law"),
    "by driver": (*begun("compass_walker"), "driver"),
    "by the smooth law": (*begun("dynamometer_smooth"), "law"),
    "by a contact's law": (SLIPPING, given.thrown(1.0), "law"),
    "settled": (*begun("rolling_wheel.pushed"), "native"),
    "with a signal": (*begun("towed_pendulum"), "native"),
}


def left_over(scene: Scene, start: Start, realised: Realised) -> list[str]:
    """What of the model and the data that the next run is lent is not as if made anew."""
    plan = planned(TUNED, scene, start, realised)
    TUNED.run(scene, start, SHORT, 1e-3, plan, reactions=(), record=True)
    assert len(compilation._SHELF) == 1
    shelved = compilation._SHELF[0].model
    fresh, began, _ = compilation.placed(scene, start, 5e-4, plan, settles=True)
    with compilation.lent(scene, start, 5e-4, plan, settles=True) as (model, data):
        assert model is shelved
        wrong = [p for p in PARTS if not np.array_equal(getattr(data, p), getattr(began, p))]
        return differing(model, fresh) + wrong


@pytest.mark.parametrize("what", RUNS)
def test_a_run_leaves_nothing_to_the_next(what: str) -> None:
    assert left_over(*RUNS[what]) == []


@pytest.mark.mutant("a model lent on with the dry friction of the run before")
def test_what_a_run_leaves_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    lost = [name for name in compilation._WRITTEN if name != "dof_frictionloss"]
    monkeypatch.setattr(compilation, "_WRITTEN", lost)
    compilation._SHELF.clear()
    assert left_over(*RUNS["by the smooth law"]) == ["dof_frictionloss"]
    compilation._SHELF.clear()


def test_another_scene_is_lent_its_own() -> None:
    scene, start = begun("bar_pendulum")
    plan = planned(TUNED, scene, start)
    first, second = (compilation.lent(scene, start, 1e-3, plan, settles=True) for _ in range(2))
    with first as (one, _), second as (two, _):
        assert two is not one  # which is taken
    lighter = replace(scene, gravity=(0.0, -1.6))
    with compilation.lent(lighter, start, 1e-3, plan, settles=True) as (model, _):
        assert model.opt.gravity[1] == -1.6


def test_what_a_failing_run_leaves_is_not_used_again() -> None:
    scene, start = begun("bar_pendulum")
    plan = planned(TUNED, scene, start)
    with pytest.raises(ValueError, match="no whole multiple"):
        TUNED.run(scene, start, np.array([0.0, 1.5e-3]), 1e-3, plan, reactions=())
    assert compilation._SHELF == []


@pytest.mark.slow
@pytest.mark.parametrize("name", ["four_bar", "rolling_wheel.pushed"])
def test_a_trial_compiles_once(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    made: list[int] = []
    start = compilation.started
    monkeypatch.setattr(compilation, "started", lambda model: made.append(1) or start(model))
    case = CASES[name]
    reference = scenes.solved(name).trajectory
    compilation._model.cache_clear()
    trial = Trial(case, reference, TUNED, planned(TUNED, case.scene, first(reference)))
    assert len({row.ladder for row in compare(trial).rungs}) == 2
    assert compilation._model.cache_info().misses == 1
    assert len(made) < 8  # the audit, the protocol of every step, one for all rungs
