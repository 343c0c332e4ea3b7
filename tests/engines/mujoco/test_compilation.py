"""One compilation for all steps: the model that is written into is the one its script gives."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import replace
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import mujoco
import numpy as np
import pytest
from bench.adapters import LOOPS
from given import scenes
from given.adapters import engine_scenes as given
from given.adapters.engine_scenes import ODD_NAMES, ROD, machine, pin, shaken, with_forces
from given.adapters.models import differing
from given.adapters.planning import CASES, NATIVE, SHIPPED, begun, moved, planned
from given.adapters.planning import TUNED as ENGINES
from given.machines.random_machines import chain, loops, tree

from textmech.cases.scene import Scene, Spring
from textmech.cases.trajectory import Array
from textmech.engines.engine import Diverged, Engine, Plan, Realised, Start
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.adapter import compilation
from textmech.engines.mujoco.callbacks import signal as control
from textmech.engines.mujoco.model import scene as builder
from textmech.engines.mujoco.model import tree as built
from textmech.engines.mujoco.model.rods import with_rods
from textmech.engines.mujoco.model.tree import called, spanning_tree
from textmech.engines.mujoco.read.record import all_steps
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


# MuJoCo's tree of joints, which loops close, and the times of its steps.


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(12))
def test_a_tree_has_no_loop_and_a_chain_has_one(seed: int) -> None:
    for build in (tree(seed), tree(seed, driven=True), chain(seed)):
        assert len(spanning_tree(build.scene).loops) == loops(build.scene)


@pytest.mark.parametrize("name", ODD_NAMES)
def test_a_name_like_the_grounds_closes_nothing(name: str) -> None:
    hung = machine([replace(ROD, name=name)], [pin("A", "ground.O", f"{name}.start")])
    assert not spanning_tree(hung).loops


def test_times_are_products() -> None:
    assert all_steps(np.array([0.0, 0.3]), 0.1).tolist() == [0.0, 0.1, 0.2, 0.1 * 3]


ALONG = (0.6, 0.8)
BEGUN: dict[str, Start] = {
    "pin": {"rod": (0.3, -0.4, np.arctan2(-0.4, 0.3), 0.4, 0.3, 1.0)},
    "slide": {"rod": (0.5 + 0.06, 0.08, 0.0, 0.3, 0.4, 0.0)},
}
"""The rod's start is held: by a pin in O, or 0.1 m along a line through it."""


def named(kind: str, *, backward: bool) -> dict[str, Array]:
    """States and reactions of a rod that the ground holds, or that holds the ground."""
    ends = ("ground.O", "rod.start")
    joint = pin("A", *(ends[::-1] if backward else ends), kind=kind, along=ALONG)
    told = ("A.fx", "A.fy")
    scene, times = machine([ROD], [joint]), np.linspace(0.0, 0.1, 6)
    motion = moved(ENGINES["mujoco"], scene, BEGUN[kind], times, 1e-3, reactions=told)
    sign = -1.0 if backward else 1.0
    return {**motion.states, **{name: sign * motion.reactions[name] for name in told}}


@pytest.mark.parametrize("kind", BEGUN)
def test_a_joint_that_is_named_backward_moves_alike(kind: str) -> None:
    """To the last bit: its axis is the opposite, and so is what it counts."""
    forward, backward = named(kind, backward=False), named(kind, backward=True)
    assert np.any(forward["rod"][-1] != forward["rod"][0])
    for name, rows in forward.items():
        assert np.array_equal(rows, backward[name]), name


@pytest.mark.mutant("axis of a {kind} not turned round where its body is named first")
@pytest.mark.parametrize("kind", BEGUN)
def test_an_axis_that_is_not_turned_round_is_seen(
    kind: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(built, "_axis", lambda scene, branch, freedom: freedom.axis)
    forward, backward = (named(kind, backward=way)["rod"] for way in (False, True))
    assert np.max(np.abs(forward - backward)) > 0.1


# What MuJoCo has one of for all users: its callbacks, its warnings, its log file.


TIMES = np.linspace(0.0, 0.8, 11)
BOTH = [SHIPPED["mujoco"], ENGINES["mujoco"]]


def loaded(text: str) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """A script as its user loads it."""
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    return model, data


@pytest.mark.mutant("a sine's control held during each step")
def test_a_sine_between_steps_is_of_first_order() -> None:
    """The mutant of the callback: the same control, set before each step and held during it."""
    scene, begin = shaken()
    engine = ENGINES["mujoco"]

    def held(h: float) -> list[float]:
        model, data = loaded(engine.script(scene, begin, h, planned(engine, scene, begin)))
        found = [data.qpos[0]]
        for _ in range(len(TIMES) - 1):
            for _ in range(round(TIMES[1] / h)):
                data.ctrl[0] = math.sin(12.0 * data.time + 0.4)
                mujoco.mj_step(model, data)
            found.append(data.qpos[0])
        return found

    a, b, c = (np.array(held(h)) for h in (8e-3, 4e-3, 2e-3))
    ratio = np.abs(a - b).max() / np.abs(b - c).max()
    assert math.log2(ratio) == pytest.approx(1, abs=0.1)


def test_the_callback_is_removed_and_the_users_comes_back() -> None:
    moved(ENGINES["mujoco"], *shaken(), TIMES, 2e-3)
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mju_user_warning() is None
    seen: list[float] = []

    def mine(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        seen.append(data.time)

    listening: list[str] = []
    mujoco.set_mjcb_control(mine)
    mujoco.set_mju_user_warning(listening.append)
    try:
        moved(ENGINES["mujoco"], *begun("bar_pendulum"), TIMES, 2e-3)
        assert mujoco.get_mjcb_control() is mine
        assert not seen
        assert mujoco.get_mju_user_warning() is not None
    finally:
        mujoco.set_mjcb_control(None)
        mujoco.set_mju_user_warning(None)


def test_the_callback_is_removed_when_the_run_raises(monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(angle: float) -> float:
        raise ArithmeticError("sine")

    monkeypatch.setattr(control.math, "sin", fails)
    with pytest.raises(ArithmeticError):
        moved(ENGINES["mujoco"], *shaken(), TIMES, 2e-3)
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mju_user_warning() is None


@pytest.mark.parametrize("engine", BOTH, ids=lambda e: e.setting)
def test_a_script_does_not_reset_what_blows_up(
    engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    scene, begin = shaken()
    stiff = with_forces(scene, Spring, lambda f: Spring(f.name, f.a, f.b, 1e9, f.rest_length))
    with pytest.raises(Diverged, match=r"MuJoCo warns: .*unstable"):
        moved(engine, stiff, begin, np.linspace(0, 100.0, 11), 0.1)
    plan = planned(engine, stiff, begin)
    LOOPS["mujoco"](engine, stiff, begin, 0.1, plan)()(1000)
    model, _ = loaded(engine.script(stiff, begin, 0.1, plan))
    assert model.opt.disableflags & mujoco.mjtDisableBit.mjDSBL_AUTORESET
    assert not list(tmp_path.iterdir())


def test_other_warnings_are_diverged_too(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    built = builder.mjcf

    def mixed(*given: Any) -> str:  # MuJoCo says so in the first step, and takes another pair
        return built(*given).replace('solref="0.02 1.0"', 'solref="0.02 -1.0"')

    monkeypatch.setattr("textmech.engines.mujoco.adapter.compilation.mjcf", mixed)
    scene, begin = begun("four_bar")
    with pytest.raises(Diverged, match=r"MuJoCo warns: .*solref"):
        moved(SHIPPED["mujoco"], scene, begin, np.array([0.0, 0.04, 0.08]), 2e-3)
    assert not list(tmp_path.iterdir())
