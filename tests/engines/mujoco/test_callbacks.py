"""What MuJoCo has one of for all users: its callbacks, its warnings, its log file."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from pathlib import Path
from typing import Any

import mujoco
import numpy as np
import pytest
from bench.adapters import LOOPS
from given.engine_scenes import shaken, with_forces
from given.planning import SHIPPED, TUNED, begun, moved, planned

from textmech.cases.scene import Spring
from textmech.engines.engine import Diverged, Engine
from textmech.engines.mujoco.callbacks import signal as control
from textmech.engines.mujoco.model import scene as builder

TIMES = np.linspace(0.0, 0.8, 11)
BOTH = [SHIPPED["mujoco"], TUNED["mujoco"]]


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
    engine = TUNED["mujoco"]

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
    moved(TUNED["mujoco"], *shaken(), TIMES, 2e-3)
    assert mujoco.get_mjcb_control() is None
    assert mujoco.get_mju_user_warning() is None
    seen: list[float] = []

    def mine(model: mujoco.MjModel, data: mujoco.MjData) -> None:
        seen.append(data.time)

    listening: list[str] = []
    mujoco.set_mjcb_control(mine)
    mujoco.set_mju_user_warning(listening.append)
    try:
        moved(TUNED["mujoco"], *begun("bar_pendulum"), TIMES, 2e-3)
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
        moved(TUNED["mujoco"], *shaken(), TIMES, 2e-3)
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
