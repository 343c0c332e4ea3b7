"""What acts about a joint, in every engine: against the reference, and where it is refused."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes, torsion
from given.planning import TUNED, moved, planned, refused, ways

from textmech.engines.engine import Start
from textmech.engines.mujoco.model import tree
from textmech.reference.solve import solve

END = scenes.tail(1.0, 6)
# Measured: 1e-9 rad by MuJoCo's RK4; pymunk's law is of second order, 2.8e-6 rad at this step, and
# its own damper, which acts after the kick, of the first, 5.0e-4 rad.
REACHED = {("mujoco", "native"): 1e-8, ("pymunk", "law"): 1e-5, ("pymunk", "native"): 1.5e-3}
STEP = {"mujoco": 1e-3, "pymunk": 2e-4}


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "realised"), REACHED, ids=".".join)
def test_engines_turn_as_the_reference(engine: str, realised: str, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, torsion.ARM, tail=END)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    wanted = ("hinge.fx", "hinge.fy", "elbow.fx", "elbow.fy") if engine == "mujoco" else ()
    found = moved(
        TUNED[engine], case.scene, start, case.times, STEP[engine],
        realised=realised, reactions=wanted,  # type: ignore[arg-type]
    )  # fmt: skip
    for body, rows in known.states.items():
        assert np.max(np.abs(found.states[body][:, :3] - rows[:, :3])) < REACHED[engine, realised]
    for name in wanted:
        assert np.max(np.abs(found.reactions[name] - known.reactions[name])) < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("engine", STEP)
def test_what_an_engine_holds_is_the_scene_s(engine: str, tmp_path: Path) -> None:
    """A sign or a unit that is lost on the way shows in the audit."""
    case = scenes.typed(tmp_path, torsion.ARM)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    held = TUNED[engine].measure(case.scene, start)
    assert held["wire.stiffness"] == pytest.approx(9.0, rel=1e-14)
    assert held["wire.rest_angle"] == pytest.approx(np.radians(-30.0), rel=1e-14)
    assert held["knee.rest_angle"] == pytest.approx(np.radians(20.0), rel=1e-14)
    assert held["oil.damping"] == pytest.approx(0.12, rel=1e-14)
    plan = planned(TUNED[engine], case.scene, start)
    script = TUNED[engine].script(case.scene, start, 1e-3, plan)
    assert "DampedRotarySpring" in script or "springref" in script
    assert ("native", "law")[: 2 if engine == "pymunk" else 1] == ways(
        TUNED[engine], case.scene, start
    )


def test_mujoco_refuses_what_its_joints_have_no_place_for(tmp_path: Path) -> None:
    twice = torsion.ARM.replace(
        "    oil:", "    again: {torsion: hinge, stiffness: 1, rest_angle: 0}\n    oil:"
    )
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, twice).scene)
    assert said == "adapter: again is not the only torsion of hinge"
    each = ", ".join(f"{pin}0: {{torsion: {pin}, stiffness: 1, rest_angle: 0}}" for pin in "ABC")
    said = refused(
        TUNED["mujoco"],
        scenes.typed(tmp_path, torsion.LOOP.replace("{wire", f"{{{each}, wire")).scene,
    )
    assert said is not None
    assert said.endswith("which closes a loop and has no hinge")


@pytest.mark.slow
def test_mujoco_closes_a_loop_by_a_pin_about_which_nothing_acts(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, torsion.LOOP, tail=END)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    found = moved(TUNED["mujoco"], case.scene, start, case.times, 1e-4)
    for body, rows in known.states.items():
        off = np.max(np.abs(found.states[body][:, :3] - rows[:, :3]))
        assert off < 5e-7, body  # measured 1.6e-7 of the rocker: the pin is soft


@pytest.mark.mutant("a pin with a spring taken to close a loop")
def test_a_pin_with_a_spring_is_seen_to_close_no_loop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = scenes.typed(tmp_path, torsion.LOOP).scene
    assert [joint.name for joint in tree.spanning_tree(scene).loops] == ["C"]
    monkeypatch.setattr(tree, "_closes", lambda scene, joint: joint.swings)
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, torsion.LOOP).scene)
    assert said == "adapter: wire acts about D, which closes a loop and has no hinge"
