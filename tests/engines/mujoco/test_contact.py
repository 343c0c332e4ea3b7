"""MuJoCo's floor: how it settles, what keeps blocks from creeping, and the damper of a bounce."""

import math
from dataclasses import dataclass, replace
from types import SimpleNamespace
from typing import cast

import numpy as np
import pytest
from given.engine_scenes import (
    BLOCK,
    RESTS,
    ROLLS,
    WHEEL,
    incline,
    launched,
    machine,
    touching,
)  # fmt: skip
from given.planning import SHIPPED, TUNED, every, moved, planned
from scipy.integrate import solve_ivp

from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.trajectory import VX, Array
from textmech.engines.mujoco.callbacks import settle
from textmech.engines.mujoco.callbacks.settle import Floor
from textmech.engines.mujoco.model.bounce import damping_ratio


def test_a_disk_is_started_as_deep_as_it_is_carried() -> None:
    """Where it neither falls nor rises; the audit sees it before."""
    push = Push("push", Anchor("wheel", "center"), Signal("sine", (0.0, -30.0), 5.0, math.pi / 2))
    scene = machine([replace(WHEEL, mass=1.0)], contacts=[ROLLS], forces=[push])
    begin = launched(0.0)
    assert "in the floor" in planned(TUNED["mujoco"], scene, begin).protocol(1e-4)
    assert not planned(SHIPPED["mujoco"], scene, begin).protocol(1e-4)
    assert TUNED["mujoco"].measure(scene, begin)["momentum.y"] == 0.0


def test_noslip_needs_the_way_out_of_the_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = incline(BLOCK, touching("block", 0.4), slope=math.radians(15))

    def speed() -> float:
        run = moved(TUNED["mujoco"], scene, RESTS, np.linspace(0.0, 0.2, 21), 1e-4, record=True)
        return abs(every(run).states["block"][-1, VX])

    still = speed()
    monkeypatch.setattr(
        "textmech.engines.mujoco.model.scene._leaves_plane", lambda scene, numbers: False
    )
    assert still <= 1e-15 < 1e-9 <= speed()


@pytest.mark.parametrize("bounce", [1.0, 0.9, 0.3, 0.14, 0.13, 0.02])
def test_damper_throws_back(bounce: float) -> None:
    ratio = damping_ratio(bounce)

    def leaves(t: float, y: Array) -> float:
        return y[0] + 2 * ratio * y[1] if t else 1.0

    leaves.terminal = True  # type: ignore[attr-defined]
    leaves.direction = -1  # type: ignore[attr-defined]
    solution = solve_ivp(
        lambda t, y: [y[1], -y[0] - 2 * ratio * y[1]],
        (0, 100), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert -solution.y[1, -1] == pytest.approx(bounce, abs=1e-6)


@dataclass
class _Held:
    """A start whose slip grows by −(creep − held)/h, up to a rounding of it."""

    rounding: float
    held: float = -7.5e-5
    h: float = 4e-4

    def __post_init__(self) -> None:
        self.creeps, self.depths, self.slips = np.array([self.held]), np.ones(1), np.zeros(1)
        self.model = SimpleNamespace(opt=SimpleNamespace(timestep=self.h))

    def acceleration(self, i: int) -> tuple[float, float]:
        return (self.held - float(self.creeps[i])) / self.h + self.rounding, 0.0


@pytest.mark.mutant("a start's creep let go where rounding alone is left of its slip")
@pytest.mark.parametrize("rounding", [0.0, 1e-18, -1e-18, 1e-17, -1e-17])
def test_what_friction_holds_is_held_whatever_rounding_says(rounding: float) -> None:
    """Ten steps of what is left, 1e-18 m/s², are less than the rounding of the creep."""
    held = _Held(rounding)
    settle._creep(cast("Floor", held), 0)
    assert held.creeps[0] == pytest.approx(held.held, rel=1e-12)
