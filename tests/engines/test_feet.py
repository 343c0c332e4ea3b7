"""Two feet of which one stands: a driver tells engines' floors which foot they meet."""

import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from given.planning import SETTINGS, TUNED, begun, moved, planned, words
from given.scenes import SHIPPED, solved

from textmech.cases.scene import Anchor, Contact
from textmech.cases.trajectory import ANGLE, X
from textmech.engines.engine import Engine, Refusal
from textmech.engines.mujoco.refuse import unbuildable
from textmech.engines.stride import Stride, stride

CASE = SHIPPED["compass_walker"]
STEPS = (1e-3, 1e-4)  # s
LEFT = Contact("left", Anchor("l", "end"), 1, 1, ideal="pivot", ahead_of=Anchor("r", "end"))
RIGHT = Contact("right", Anchor("r", "end"), 1, 1, ideal="pivot", ahead_of=Anchor("l", "end"))

# rad and m after two steps; what strikes is found at the end of a step: an error of h.
NEAR = {
    "mujoco": ((3.2e-2, 1.3e-2), (3.6e-3, 7e-4)),  # 1.0e-2, 4.3e-3; 1.2e-3, 2.1e-4
    "pymunk": ((1.3e-2, 1.4e-2), (9e-4, 1e-3)),  # 4.2e-3, 4.8e-3; 2.8e-4, 3.3e-4
}


def off(engine: Engine, step: float) -> tuple[float, float]:
    """How far [rad] its legs and [m] its hip are from the reference."""
    exact = solved(CASE.name).trajectory.states
    run = moved(engine, *begun(CASE.name), CASE.times, step, realised="driver").states

    def apart(body: str, column: int) -> float:
        return float(np.abs(run[body][:, column] - exact[body][:, column]).max())

    return max(apart(leg, ANGLE) for leg in ("left", "right")), apart("hip", X)


@pytest.mark.parametrize("name", TUNED)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_walker_takes_two_steps(k: int, name: str) -> None:
    found = off(TUNED[name], STEPS[k])
    assert found[0] < NEAR[name][k][0]
    assert found[1] < NEAR[name][k][1]


@pytest.mark.parametrize("name", TUNED)
def test_a_floor_that_meets_every_foot_is_seen(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Midway the swinging foot would be stopped."""

    def look(self: Stride, place: object) -> None:
        self.meets = dict.fromkeys(self.meets, True)

    monkeypatch.setattr(Stride, "look", look)
    assert max(off(TUNED[name], 1e-3)) > 0.1


@pytest.mark.parametrize("name", TUNED)
def test_a_run_leaves_nothing_to_the_next(name: str) -> None:
    """Which feet the floor meets is part of the model that MuJoCo's runs are lent in turn."""
    assert off(TUNED[name], 1e-3) == off(TUNED[name], 1e-3)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_no_floor_lets_a_foot_pass_by_itself(engine: Engine) -> None:
    first, *others = engine.plans(*begun(CASE.name))
    assert isinstance(first, Refusal)
    assert first.because.startswith("engine: its floor meets a foot wherever it is low")
    assert [plan.realised for plan in others] == (["driver"] if engine.setting == "tuned" else [])


def test_pymunks_script_steers_the_feet_too() -> None:
    engine = TUNED["pymunk"]
    scene, start = begun(CASE.name)
    text = engine.script(scene, start, 1e-3, planned(engine, scene, start, "driver"))
    run = subprocess.run([sys.executable, "-c", text], capture_output=True, text=True, check=True)
    rows = {line.split()[0]: line.split()[1:] for line in run.stdout.splitlines()}
    ends = moved(engine, scene, start, np.array([0.0, 1.0]), 1e-3, realised="driver").states
    for name, states in ends.items():
        assert [float(x) for x in rows[name]] == pytest.approx(states[-1].tolist(), abs=1e-12)


def walked(*places: tuple[tuple[float, float], tuple[float, float]]) -> list[dict[str, bool]]:
    """Which feet meet the floor as the left and the right one are at these places."""
    feet = Stride({"left": LEFT, "right": RIGHT}, 0.01, {"left": True, "right": False})
    found = []
    for left, right in places:
        feet.look(lambda at, left=left, right=right: left if at.body == "l" else right)
        found.append(dict(feet.meets))
    return found


def test_a_foot_meets_the_floor_ahead_and_above_and_lets_the_other_go() -> None:
    stands, both = {"left": True, "right": False}, {"left": True, "right": True}
    assert walked(
        ((0, 0), (-0.4, 0.0)),  # it has just left
        ((0, 0), (-0.2, -0.01)),  # it passes through the floor
        ((0, 0), (0.005, 0.01)),  # beside the other
        ((0, 0), (0.2, -1e-9)),  # ahead, but it has not come out yet
        ((0, 0), (0.2, 0.01)),
        ((0, 1e-9), (0.4, -1e-9)),  # it strikes
        ((-1e-9, 1e-9), (0.4, -1e-9)),
        ((0.6, 0.01), (0.4, -1e-9)),
    ) == [stands] * 4 + [both] + [{"left": False, "right": True}] * 2 + [both]


def test_only_feet_need_a_driver() -> None:
    scene, _ = begun("rimless_wheel")
    assert stride(scene, []) is None
    walker, _ = begun(CASE.name)
    found = stride(walker, ["left_foot"])
    assert found is not None
    assert found.meets == {"left_foot": True, "right_foot": False}
    assert found.stands(lambda at: (0.0, 0.0)) == "left_foot"
    assert unbuildable(replace(walker, joints={})) is None
