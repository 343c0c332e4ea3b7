"""What acts about turns in space: MuJoCo beside the reference, its audit, and what it refuses."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes, torsion
from given.engine_space import STILL
from given.planning import TUNED, moved, refused

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import UPRIGHT
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Start
from textmech.engines.mujoco.read import reaction
from textmech.reference.solve import solve

MUJOCO = TUNED["mujoco"]
END = scenes.tail(1.0, 6)
REACHED = 1e-8  # measured at 1 ms: 4e-10 rad and 2e-9 N m, of 1 rad and 15 N m
DRIVEN = (
    torsion.SPATIAL.replace(
        "initial:\n  hinge: {angle: 20 deg, omega: 1.0}",
        "  drive: {wrist.phi_dot: {sine: {amplitude: 2.0, angular_frequency: 3.0}}}\n"
        "initial:\n  hinge: {angle: 20 deg, omega: 1.0}",
    )
    .replace(", phi_dot: -1.0", "")
    .replace("  hinge.mx: 1.0,", "  wrist.phi_torque: 1.0, hinge.mx: 1.0,")
)


def both(case: Case) -> tuple[Trajectory, Trajectory]:
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    forces = [name for name in case.allow if table(case.scene)[name].part in case.scene.joints]
    kinds = [name for name in forces if table(case.scene)[name].kind == "force"]
    return known, moved(
        MUJOCO, case.scene, start, case.times, 1e-3, realised="native", reactions=tuple(kinds)
    )


def apart(case: Case) -> dict[str, float]:
    """Of each quantity the largest difference to the reference's."""
    known, found = both(case)
    pairs = {name: [observe(case.scene, of, name) for of in (known, found)] for name in case.allow}
    return {name: float(np.max(np.abs(a - b))) for name, (a, b) in pairs.items()}


@pytest.mark.slow
@pytest.mark.parametrize("scene", [torsion.SPATIAL, DRIVEN], ids=["free", "driven"])
def test_mujoco_turns_as_the_reference(scene: str, tmp_path: Path) -> None:
    """Of a driven turn the drive's torque is told apart from those of spring, damper and motor."""
    off = apart(scenes.typed(tmp_path, scene, tail=END))
    assert max(off.values()) < REACHED, off
    assert ("wrist.phi_torque" in off) == (scene is DRIVEN)


@pytest.mark.mutant("torque of a spring counted as the drive's")
@pytest.mark.slow
def test_a_drive_s_torque_with_the_spring_s_in_it_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "_beside", lambda *_: ())
    off = apart(scenes.typed(tmp_path, DRIVEN, tail=END))
    assert off.pop("wrist.phi_torque") > 0.1
    assert max(off.values()) < REACHED


def test_the_audit_reads_back_each_turn(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, torsion.SPATIAL)
    held = MUJOCO.measure(case.scene, start_of(case))
    for force in case.scene.forces.values():
        for name, number in force.numbers().items():
            assert held[f"{force.name}.{name}"] == pytest.approx(number, rel=1e-14)


def start_of(case: Case) -> Start:
    q, v = scenes.mechanism(case).base.start()
    poses = scenes.mechanism(case).base.poses(0.0, q, v)
    return {name: tuple(map(float, pose)) for name, pose in poses.items()}  # type: ignore[misc]


def test_one_spring_for_each_turn(tmp_path: Path) -> None:
    """Two turns of one joint have one each; a second spring of one turn has no place."""
    twice = torsion.SPATIAL.replace("two: {torsion: wrist.phi", "two: {torsion: wrist.theta")
    said = refused(MUJOCO, scenes.typed(tmp_path, twice).scene)
    assert said == "adapter: two is not the only torsion of wrist.theta"


def test_a_turn_that_closes_a_loop_has_no_hinge(tmp_path: Path) -> None:
    """Of two joints about which something acts, only one can be in the tree."""
    closed = torsion.FLAT.replace("{O: [0, 0, 0]}", "{O: [0, 0, 0], Q: [0.7, 0, 0]}")
    closed = closed.replace(
        "elbow: {hinge", "tip: {hinge: [ground.Q, arm.end], axis: [0, 0, 1]}\n    elbow: {hinge"
    )
    scene = scenes.typed(tmp_path, closed).scene
    begun: Start = dict.fromkeys(scene.bodies, (*STILL, *UPRIGHT, *STILL, *STILL))  # type: ignore[arg-type]
    assert refused(MUJOCO, scene, begun) is None  # what nothing acts about closes it
    everywhere = closed.replace("pull: {motor: hinge", "pull: {motor: tip")
    said = refused(MUJOCO, scenes.typed(tmp_path, everywhere).scene)
    assert said == "adapter: knee acts about elbow, which closes a loop and has no hinge"
