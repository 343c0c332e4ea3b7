"""Inner states in engines: orders, what they begin with, and planted mistakes."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import replace
from typing import Any

import mujoco
import numpy as np
import pytest
from given import scenes
from given.planning import CASES, TUNED, begun, moved

from textmech.cases.scene.observe import observe
from textmech.engines import point_forces as told
from textmech.engines.engine import Diverged
from textmech.engines.point_forces import Living

NAME, U = "muscle_load", "muscle.contractile_length"
STEPS = {"mujoco": 1e-3, "pymunk": 2e-4}


def apart(engine: str, h: float) -> float:
    """Of the load and of what contracts, the largest [m]."""
    scene, start = begun(NAME)
    case, known = CASES[NAME], scenes.solved(NAME).trajectory
    found = moved(TUNED[engine], scene, start, case.times, h, realised="law", reactions=(U,))
    return max(
        float(np.max(np.abs(observe(scene, found, name) - observe(scene, known, name))))
        for name in ("load.y", U)
    )


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "order"), [("mujoco", 4), ("pymunk", 2)])
def test_the_state_is_of_the_engine_s_order(engine: str, order: int) -> None:
    h = STEPS[engine]
    assert math.log2(apart(engine, 2 * h) / apart(engine, h)) == pytest.approx(order, abs=0.1)


@pytest.mark.mutant("muscle in {engine}: {planted} of its inner state")
@pytest.mark.parametrize("engine", STEPS)
@pytest.mark.parametrize("planted", ["a rate of the other sign", "no rate", "another start"])
def test_a_planted_mistake_is_seen(
    engine: str, planted: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind = type(CASES[NAME].scene.forces["muscle"])
    sound = told.LIVING[kind]
    way = {"a rate of the other sign": -0.1, "no rate": 0.0}.get(planted, 1.0)

    def wrong(scene: Any, force: Any) -> Living:
        law = sound(scene, force)
        return replace(law, rate=lambda points, u: way * law.rate(points, u))

    monkeypatch.setitem(told.LIVING, kind, wrong)
    if planted == "another start":
        monkeypatch.setattr(kind, "begins", property(lambda self: 0.299))
    try:
        off = apart(engine, STEPS[engine])
    except Diverged:  # onto the other branch of Hill's hyperbola
        off = math.inf
    assert off > 1e-4


def test_the_users_callback_comes_back() -> None:
    def mine(model: mujoco.MjModel, data: mujoco.MjData, actuator: int) -> float:
        return 0.0

    mujoco.set_mjcb_act_dyn(mine)
    try:
        apart("mujoco", 2e-3)
        assert mujoco.get_mjcb_act_dyn() is mine
    finally:
        mujoco.set_mjcb_act_dyn(None)
    apart("mujoco", 2e-3)
    assert mujoco.get_mjcb_act_dyn() is None


@pytest.mark.slow
def test_a_joint_bears_what_a_muscle_leaves() -> None:
    name = "muscle_isometric.rise"
    scene, start = begun(name)
    known = scenes.solved(name).trajectory.reactions["glue.fy"]
    found = moved(
        TUNED["mujoco"], scene, start, CASES[name].times, 5e-4,
        realised="law", reactions=("glue.fy", U),
    )  # fmt: skip
    assert np.max(np.abs(found.reactions["glue.fy"] - known)) < 1e-5
