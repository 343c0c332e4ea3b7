"""Massless rods in every engine: MuJoCo's light bars in a tree, pymunk's own joint in loops too."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

from pathlib import Path

import mujoco
import numpy as np
import pytest
from given import scenes
from given.adapters.planning import TUNED, apart, moved, planned
from given.scenes import rods

from textmech.cases.scene import Anchor
from textmech.engines.mujoco.model import loops
from textmech.engines.mujoco.model import rods as bars
from textmech.engines.mujoco.model.tree import place
from textmech.engines.mujoco.read import readout
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

# Measured at 1 ms: MuJoCo 8e-10 m and of its forces, pymunk 9e-5 m, in the loop 9e-7 m.
REACHED = {"mujoco": 1e-8, "pymunk": 5e-4}
FORCES = ("left.fx", "left.fy", "chain.fx", "chain.fy")


def off(engine: str, scene: str, folder: Path) -> float:
    case = scenes.typed(folder, scene, tail=scenes.tail(1.0, 11))
    known = solve(case).trajectory
    wanted = FORCES if engine == "mujoco" else ()
    found = moved(TUNED[engine], case.scene, first(known), case.times, 1e-3, reactions=wanted)
    assert found.states.keys() == known.states.keys()
    pulls = [np.max(np.abs(found.reactions[n] - known.reactions[n])) / 20.0 for n in wanted]
    return float(max(*apart(known, found)[:3], *pulls))


@pytest.mark.slow
@pytest.mark.parametrize("engine", REACHED)
def test_a_chain(engine: str, tmp_path: Path) -> None:
    assert off(engine, rods.CHAIN, tmp_path) < REACHED[engine]


@pytest.mark.slow
@pytest.mark.mutant("a massless rod with 1e-3 of the lightest body's mass")
def test_a_heavy_rod_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(bars, "LIGHT", 1e-3)
    assert off("mujoco", rods.CHAIN, tmp_path) > 1e-5


# rad or m, N of 20 at 1e-4 s; measured: 4e-5 and 3e-3 in a linkage, of second order in the step.
LOOPS = {"swing": rods.SWING, "linked": rods.LINKED, "both": rods.BOTH}


def in_a_loop(name: str, folder: Path, step: float) -> tuple[float, float]:
    """How far MuJoCo's places and its joints' forces are."""
    case = scenes.typed(folder, LOOPS[name], tail=scenes.tail(0.8, 11))
    known = solve(case).trajectory
    wanted = tuple(f"{joint}.{axis}" for joint in case.scene.joints for axis in ("fx", "fy"))
    found = moved(TUNED["mujoco"], case.scene, first(known), case.times, step, reactions=wanted)
    pulls = [np.max(np.abs(found.reactions[n] - known.reactions[n])) for n in wanted]
    return float(apart(known, found)[:3].max()), float(max(pulls))


@pytest.mark.slow
@pytest.mark.parametrize("name", LOOPS)
def test_mujoco_s_loops(name: str, tmp_path: Path) -> None:
    places, forces = in_a_loop(name, tmp_path, 1e-4)
    assert places < 2e-4
    assert forces < 2e-2


@pytest.mark.slow
def test_a_rod_in_a_loop_is_of_second_order(tmp_path: Path) -> None:
    coarse, fine = (in_a_loop("linked", tmp_path, step)[0] for step in (4e-4, 2e-4))
    assert 3.0 < coarse / fine < 5.0


@pytest.mark.slow
@pytest.mark.mutant("a rod of another length")
def test_a_rod_of_another_length_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """MuJoCo counts from the file's own pose: what stands there is not the rod's length."""
    monkeypatch.setattr(loops, "_at", lambda root, site: (0.0, 0.0))
    assert in_a_loop("linked", tmp_path, 1e-3)[0] > 0.1


@pytest.mark.slow
@pytest.mark.mutant("rows of pins and rods taken for each other's")
def test_the_rows_of_pins_and_rods_are_told_apart(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    own = readout._equalities  # pyright: ignore[reportPrivateUsage]
    monkeypatch.setattr(readout, "_equalities", lambda *given: np.roll(own(*given), 1, axis=0))
    assert in_a_loop("both", tmp_path, 1e-3)[1] > 0.5


@pytest.mark.slow
def test_a_script_holds_the_rod(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, rods.LINKED, tail=scenes.tail(1.0, 11))
    start = first(solve(case).trajectory)
    plan = planned(TUNED["mujoco"], case.scene, start)
    model = mujoco.MjModel.from_xml_string(TUNED["mujoco"].script(case.scene, start, 1e-3, plan))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_step(model, data, 1000)
    found = moved(TUNED["mujoco"], case.scene, start, case.times, 1e-3)
    for body, rows in found.states.items():
        assert data.body(body).xipos[:2] == pytest.approx(rows[-1, :2], abs=1e-9)


@pytest.mark.slow
def test_pymunk_s_loops(tmp_path: Path) -> None:
    assert off("pymunk", rods.SWING, tmp_path) < REACHED["pymunk"]


@pytest.mark.slow
def test_pymunk_knows_no_sign_of_a_rod_s_force(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, rods.CHAIN)
    plan = planned(TUNED["pymunk"], case.scene, first(solve(case).trajectory))
    assert {"left.force", "chain.force"} <= plan.withheld.keys()


@pytest.mark.mutant("a massless rod begins at half of its speed")
def test_a_rods_bar_begins_where_its_ends_are_and_as_fast(tmp_path: Path) -> None:
    """Each end's place and velocity are those of the point that it holds."""
    case = scenes.typed(tmp_path, rods.CHAIN, tail=scenes.tail(1.0, 11))
    start = {name: (0.3 * k, -0.2 * k * k, 0.1 * k, 0.7, -0.4 * k, 0.5 + k)
             for k, name in enumerate(case.scene.bodies, start=1)}  # fmt: skip
    scene, begun = bars.with_rods(case.scene, start)
    held = bars.in_tree(case.scene)
    assert held
    for rod in held:
        bar = bars.called(rod.name)
        for end, point in (("start", rod.a), ("end", rod.b)):
            at = place(scene, Anchor(bar, end), begun)
            wanted = place(case.scene, point, start)
            along = np.subtract(place(scene, Anchor(bar, "end"), begun),
                                place(scene, Anchor(bar, "start"), begun))[:2]  # fmt: skip
            assert at[:2] == pytest.approx(wanted[:2], abs=1e-12)
            mean = np.add(place(case.scene, rod.a, start), place(case.scene, rod.b, start)) / 2
            assert begun[bar][3:5] == pytest.approx(mean[2:], abs=1e-12)
            across = np.subtract(at, wanted)[2:] @ [-along[1], along[0]]
            assert across == pytest.approx(0.0, abs=1e-12)  # along it its ends are one length apart
