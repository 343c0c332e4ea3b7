"""Steps of MuJoCo's driver: each part ends just over what happens in it, at the first instant."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from collections.abc import Mapping
from typing import Any

import mujoco
import numpy as np
import pytest
from given.engine_scenes import guided, thrown
from given.planning import TUNED, moved

from textmech.cases.scene import Anchor, Bounds, Push, Signal
from textmech.cases.trajectory import VX, X
from textmech.engines.mujoco.callbacks.cut import Cut, Height
from textmech.engines.mujoco.callbacks.driver import Rubbing

POINT = """
<mujoco>
  <option gravity="0 0 0" integrator="RK4"/>
  <worldbody><body><joint name="x" type="slide" axis="1 0 0"/><geom size="1" mass="1"/></body>
  </worldbody>
</mujoco>
"""
H, SPEED = 0.01, 3.0  # s, m/s
CLOSE = 2e-15  # s: two of brentq's tolerances, and the rounding of a sum of parts


class Marks(Cut[int]):
    """A point that goes along x and passes marks [m]; `passed` notes when, and where it was."""

    def __init__(self, *marks: float) -> None:
        model = mujoco.MjModel.from_xml_string(POINT)
        super().__init__(model, mujoco.MjData(model))
        self.data.qvel[0] = SPEED
        self.marks, self.passed = marks, dict[int, tuple[float, float]]()

    def _height(self, key: int) -> float:
        return self.data.qpos.item(0) - self.marks[key]

    def _happens(self) -> Mapping[int, Height]:
        left = [key for key in range(len(self.marks)) if key not in self.passed]
        return {k: lambda k=k: self._height(k) for k in left if self._height(k) >= 0.0}

    def _change(self, key: int) -> None:
        self.passed[key] = self.data.time, self._height(key)


@pytest.mark.parametrize("part", [1e-9, 0.2, 0.7, 1 - 1e-9])
def test_a_part_ends_just_over_its_event(part: float) -> None:
    point = Marks(part * SPEED * H)
    point.step(H)
    time, height = point.passed[0]
    assert time == pytest.approx(part * H, abs=CLOSE)
    assert 0.0 < height < SPEED * CLOSE
    assert point.data.qpos[0] == pytest.approx(SPEED * H, rel=1e-15)


def test_the_first_of_several_comes_first() -> None:
    point = Marks(0.02, 0.01, 0.02, 0.015)
    point.step(H)
    assert list(point.passed) in ([1, 3, 0, 2], [1, 3, 2, 0])
    for key, (time, _) in point.passed.items():
        assert time == pytest.approx(point.marks[key] / SPEED, abs=2 * CLOSE)


def test_what_happens_with_the_step_s_end_is_not_lost() -> None:
    point = Marks(SPEED * H)
    point.step(H)
    assert point.passed[0] == (H, 0.0)


def came_back(v: float, a: float) -> float:
    """When [s] a point is over a mark again that it starts on, backwards with v and driven by a."""
    point = Marks(0.0)
    point.data.qvel[0], point.data.qfrc_applied[0] = -v, a
    point.step(H)
    return point.passed[0][0]


@pytest.mark.mutant("a step of MuJoCo's driver cut where its event has only begun")
def test_its_own_begin_is_no_event(monkeypatch: pytest.MonkeyPatch) -> None:
    """The height is zero there, and below zero until 2 v/a."""
    for v in (1e-6, 1e-3, 0.04):
        assert came_back(v, 10.0) == pytest.approx(v / 5, abs=CLOSE)
    monkeypatch.setattr("scipy.optimize.brentq", lambda height, low, high, xtol: low)
    assert abs(came_back(0.01, 10.0) - 0.002) > 1e-5


BRAKES = 3.0  # N on 1 kg
BOUNDS = Bounds(BRAKES, BRAKES)


def pushed_back(force: float, v: float, step: float) -> tuple[float, float]:
    """x [m] and v [m/s] after a step, of a block that is thrown against a force [N]."""
    push = Push("pull", Anchor("block", "center"), Signal("constant", (-force, 0.0)))
    scene, times = guided(push, BOUNDS, BOUNDS), np.array([0.0, step, 2 * step])
    run = moved(TUNED["mujoco"], scene, thrown(v), times, step, realised="driver")
    return run.states["block"][1, X], run.states["block"][1, VX]


@pytest.mark.parametrize("v", [1e-9, 1e-3, 0.05])
def test_a_block_that_turns_within_a_step_turns_where_it_stops(v: float) -> None:
    """It is braked by 8 m/s², then driven back by 2: both uniform, which RK4 has exactly."""
    stop = v / 8
    x = v * stop / 2 - (H - stop) ** 2
    assert pushed_back(5.0, v, H) == pytest.approx((x, -2 * (H - stop)), rel=1e-12)


@pytest.mark.mutant("dry friction of a driver's step cut before its event")
def test_a_part_that_ends_too_soon_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """What slides still then is stopped all the same, a little too fast."""
    sound = Cut[Any]._just_over
    early = 1e-9  # s

    def before(self: Cut[Any], height: Height, longest: float) -> float:
        return sound(self, height, longest) - early

    monkeypatch.setattr(Rubbing, "_just_over", before)
    assert abs(pushed_back(5.0, 0.05, H)[1] + 2 * (H - 0.05 / 8)) > early
