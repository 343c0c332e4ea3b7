"""A torque between two bodies: where a pin joins them it is the motor of the pin, everywhere."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.adapters.engine_space import STILL
from given.adapters.planning import TUNED, apart, moved, planned, refused, ways
from given.scenes import torsion

from textmech.cases.case import Case
from textmech.cases.scene.forces.force import Couple
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import UPRIGHT
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Start
from textmech.engines.mujoco.model import force as mujoco_force
from textmech.engines.mujoco.model import force as of_mujoco
from textmech.engines.mujoco.model import tree
from textmech.engines.mujoco.read import reaction
from textmech.engines.pymunk.callbacks import force as of_pymunk
from textmech.engines.pymunk.callbacks import force as pymunk_force
from textmech.reference.solve import solve

# The pin `elbow` has arm as its first part.
COUPLED = torsion.ARM.replace("drive: {motor: elbow,", "drive: {couple: [arm, rod],")
END = scenes.tail(0.4, 3)
STEP = {"mujoco": 1e-3, "pymunk": 5e-4}
SAME = 1e-12  # rad: one torque, entered at other places
LAWS = {
    "constant": "constant: 0.7",
    "ramp": "ramp: 0.7",
    "sine": "sine: {amplitude: 1.3, angular_frequency: 4.0}",
    "pulse": "pulse: {amplitude: 0.7, from: 0.11, until: 0.23}",
}


def cases(tmp_path: Path, law: str) -> tuple[Case, Case]:
    """The couple, and the motor."""
    texts = (text.replace(LAWS["sine"], LAWS[law]) for text in (COUPLED, torsion.ARM))
    coupled, motor = (scenes.typed(tmp_path, text, tail=END) for text in texts)
    assert isinstance(coupled.scene.forces["drive"], Couple)
    return coupled, motor


def angles(engine: str, case: Case) -> Any:
    start: Start = {"rod": _at(0.0, 20.0, 0.8, 1.0), "arm": _at(1.0, -50.0, 0.5, 0.0)}
    run = moved(TUNED[engine], case.scene, start, case.times, STEP[engine])
    return np.array([run.states[body][:, 2] for body in ("rod", "arm")])


def _at(ends: float, degrees: float, length: float, omega: float) -> Any:
    """A bar's centre by its angle: the rod from the origin on, the arm from the rod's end."""
    root = ends * 0.8 * np.array([np.cos(np.radians(20.0)), np.sin(np.radians(20.0))])
    along = np.array([np.cos(np.radians(degrees)), np.sin(np.radians(degrees))])
    x, y = root + length / 2 * along
    vx, vy = np.array([-root[1], root[0]]) + omega * length / 2 * np.array([-along[1], along[0]])
    return tuple(map(float, (x, y, np.radians(degrees), vx, vy, omega)))


@pytest.mark.parametrize("law", LAWS)
@pytest.mark.parametrize("engine", STEP)
def test_an_engine_turns_as_with_the_motor(engine: str, law: str, tmp_path: Path) -> None:
    coupled, motor = cases(tmp_path, law)
    assert np.max(np.abs(angles(engine, coupled) - angles(engine, motor))) < SAME


@pytest.mark.slow
def test_the_reference_moves_as_with_the_motor(tmp_path: Path) -> None:
    coupled, motor = (solve(case) for case in cases(tmp_path, "sine"))
    assert coupled.holds
    for body, rows in motor.trajectory.states.items():
        assert np.max(np.abs(coupled.trajectory.states[body] - rows)) < SAME
    hinge = [s.trajectory.reactions["hinge.fx"] for s in (coupled, motor)]
    assert np.max(np.abs(hinge[0] - hinge[1])) < 1e-10  # N


def alone(write: Callable[..., Any]) -> Callable[..., Any]:
    """MuJoCo's actuator without the body that takes the opposite."""

    def written(sections: Any, force: Couple) -> None:
        write(sections, force)
        del sections["actuator"][-1].attrib["refsite"]

    return written


def backward(tell: Callable[..., Any]) -> Callable[..., Any]:
    """pymunk's torque on the wrong body."""

    def told(world: Any, force: Couple, step: float, drift: float) -> Any:
        return tell(world, replace(force, first=force.second, second=force.first), step, drift)

    return told


@pytest.mark.mutant(
    "a couple without its opposite in mujoco", "a couple on the wrong bodies in pymunk"
)
@pytest.mark.parametrize("engine", STEP)
def test_a_lost_or_turned_opposite_is_seen(
    engine: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    elements = {"mujoco": mujoco_force, "pymunk": pymunk_force}[engine].ELEMENTS
    wrong = {
        "mujoco": {"write": alone(of_mujoco.write_couple)},
        "pymunk": {"tell": backward(of_pymunk.couple)},
    }[engine]
    monkeypatch.setitem(elements, Couple, replace(elements[Couple], **wrong))  # type: ignore[arg-type]
    coupled, motor = cases(tmp_path, "sine")
    assert np.max(np.abs(angles(engine, coupled) - angles(engine, motor))) > 1e-3


# What acts about a joint, in every engine: against the reference, and where it is refused.


SHORT = scenes.tail(1.0, 6)
# Measured: 1e-9 rad by MuJoCo's RK4; pymunk's law is of second order, 2.8e-6 rad at this step, and
# its own damper, which acts after the kick, of the first, 5.0e-4 rad.
REACHED = {("mujoco", "native"): 1e-8, ("pymunk", "law"): 1e-5, ("pymunk", "native"): 1.5e-3}
FINE = {"mujoco": 1e-3, "pymunk": 2e-4}


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "realised"), REACHED, ids=".".join)
def test_engines_turn_as_the_reference(engine: str, realised: str, tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, torsion.ARM, tail=SHORT)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    wanted = ("hinge.fx", "hinge.fy", "elbow.fx", "elbow.fy") if engine == "mujoco" else ()
    found = moved(
        TUNED[engine], case.scene, start, case.times, FINE[engine],
        realised=realised, reactions=wanted,  # type: ignore[arg-type]
    )  # fmt: skip
    assert apart(known, found)[:3].max() < REACHED[engine, realised]
    for name in wanted:
        assert np.max(np.abs(found.reactions[name] - known.reactions[name])) < 1e-5


@pytest.mark.slow
@pytest.mark.parametrize("engine", FINE)
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
    case = scenes.typed(tmp_path, torsion.LOOP, tail=SHORT)
    known = solve(case).trajectory
    start: Start = {body: tuple(rows[0].tolist()) for body, rows in known.states.items()}  # type: ignore[misc]
    found = moved(TUNED["mujoco"], case.scene, start, case.times, 1e-4)
    assert apart(known, found)[:3].max() < 5e-7  # measured 1.6e-7 of the rocker: the pin is soft


@pytest.mark.mutant("a pin with a spring taken to close a loop")
def test_a_pin_with_a_spring_is_seen_to_close_no_loop(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    scene = scenes.typed(tmp_path, torsion.LOOP).scene
    assert [joint.name for joint in tree.spanning_tree(scene).loops] == ["C"]
    monkeypatch.setattr(tree, "_closes", lambda scene, joint: joint.swings)
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, torsion.LOOP).scene)
    assert said == "adapter: wire acts about D, which closes a loop and has no hinge"


# What acts about turns in space: MuJoCo beside the reference, its audit, and what it refuses.


MUJOCO = TUNED["mujoco"]
IN_SPACE = scenes.tail(1.0, 6)
SPATIAL = 1e-8  # measured at 1 ms: 4e-10 rad and 2e-9 N m, of 1 rad and 15 N m
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


def joint_off(case: Case) -> dict[str, float]:
    """Of each quantity the largest difference to the reference's."""
    known, found = both(case)
    pairs = {name: [observe(case.scene, of, name) for of in (known, found)] for name in case.allow}
    return {name: float(np.max(np.abs(a - b))) for name, (a, b) in pairs.items()}


@pytest.mark.slow
@pytest.mark.parametrize("scene", [torsion.SPATIAL, DRIVEN], ids=["free", "driven"])
def test_mujoco_turns_as_the_reference(scene: str, tmp_path: Path) -> None:
    """Of a driven turn the drive's torque is told apart from those of spring, damper and motor."""
    off = joint_off(scenes.typed(tmp_path, scene, tail=IN_SPACE))
    assert max(off.values()) < SPATIAL, off
    assert ("wrist.phi_torque" in off) == (scene is DRIVEN)


@pytest.mark.mutant("torque of a spring counted as the drive's")
@pytest.mark.slow
def test_a_drive_s_torque_with_the_spring_s_in_it_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "_beside", lambda *_: ())
    off = joint_off(scenes.typed(tmp_path, DRIVEN, tail=IN_SPACE))
    assert off.pop("wrist.phi_torque") > 0.1
    assert max(off.values()) < SPATIAL


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
