"""Massless rods in every engine: MuJoCo's light bars in a tree, pymunk's own joint in loops too."""

from pathlib import Path

import numpy as np
import pytest
from given import rods, scenes
from given.planning import TUNED, moved, planned, refused

from textmech.engines.mujoco import rods as bars
from textmech.reference.solve import solve
from textmech.reports.trial.start import first

# Measured at 1 ms: MuJoCo 8e-10 m and of its forces, pymunk 9e-5 m, in the loop 9e-7 m.
REACHED = {"mujoco": 1e-8, "pymunk": 5e-4}
FORCES = ("left.fx", "left.fy", "chain.fx", "chain.fy")


def off(engine: str, scene: str, folder: Path) -> float:
    case = scenes.typed(folder, scene, tail=scenes.tail(1.0, 11))
    known = solve(case).trajectory
    wanted = FORCES if engine == "mujoco" else ()
    found = moved(TUNED[engine], case.scene, first(known), case.times, 1e-3, reactions=wanted)
    assert found.states.keys() == known.states.keys()
    apart = [np.max(np.abs(found.states[b][:, :3] - known.states[b][:, :3])) for b in known.states]
    apart += [np.max(np.abs(found.reactions[n] - known.reactions[n])) / 20.0 for n in wanted]
    return float(max(apart))


@pytest.mark.parametrize("engine", REACHED)
def test_a_chain(engine: str, tmp_path: Path) -> None:
    assert off(engine, rods.CHAIN, tmp_path) < REACHED[engine]


def test_a_heavy_rod_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bars, "LIGHT", 1e-3)
    assert off("mujoco", rods.CHAIN, tmp_path) > 1e-5


def test_loops(tmp_path: Path) -> None:
    assert off("pymunk", rods.SWING, tmp_path) < REACHED["pymunk"]
    case = scenes.typed(tmp_path, rods.SWING)
    said = refused(TUNED["mujoco"], case.scene, first(solve(case).trajectory))
    assert said == "adapter: right is a massless rod that closes a loop, and is not built"


def test_pymunk_knows_no_sign_of_a_rod_s_force(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, rods.CHAIN)
    plan = planned(TUNED["pymunk"], case.scene, first(solve(case).trajectory))
    assert {"left.force", "chain.force"} <= plan.withheld.keys()
