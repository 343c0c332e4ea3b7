"""Prescribed rates in every engine that has them: motion, what the drive exerts, refusals."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED, moved, refused

from textmech.engines.mujoco.read import reaction
from textmech.engines.pymunk.stepping import run as told
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

# The knee is named backward, from the shank to the ground, and has all that may act beside a drive.
LEG = """\
scene:
  points: {O: [0, 0]}
  bodies: {shank: {bar: {mass: 1.2, length: 0.8}}, foot: {bar: {mass: 0.4, length: 0.3}}}
  joints: {knee: {pin: [shank.start, ground.O]}, ankle: {pin: [shank.end, foot.start]}}
  forces:
    coil: {torsion: knee, stiffness: 10.0, rest_angle: 0.3}
    oil: {torsion_damper: knee, damping: 0.4}
    help: {motor: knee, sine: {amplitude: 1.5, angular_frequency: 4.0}}
    hand: {push: foot.end, constant: [2.0, 1.0]}
  drive: {knee.omega: {table: {times: [0, 0.3141, 0.8], values: [0, 2.0, -1.0]}}}
initial: {knee: {angle: 0}, ankle: {angle: 20 deg, omega: 1.0}}
allow: {knee.angle: 1.0e-2, knee.torque: 1.0, foot.angle: 1.0}
"""
# Measured: MuJoCo 1.4e-6 rad and 1e-5 N, as a corner lies inside a step; pymunk 1.2e-5 rad.
REACHED = {"mujoco": 1e-5, "pymunk": 5e-5}
FORCES = ("knee.fx", "knee.fy", "knee.torque")


def off(engine: str, folder: Path) -> tuple[float, float]:
    """Of the motion [rad, m], and of what holds and drives the knee [N, N m]."""
    case = scenes.typed(folder, LEG, tail=scenes.tail(1.0, 11))
    known = solve(case).trajectory
    wanted = FORCES if engine == "mujoco" else ()
    found = moved(TUNED[engine], case.scene, first(known), case.times, 5e-4, reactions=wanted,
                  realised="law" if engine == "pymunk" else "native")  # fmt: skip
    apart = [np.max(np.abs(found.states[b][:, :3] - known.states[b][:, :3])) for b in known.states]
    forces = [np.max(np.abs(found.reactions[n] - known.reactions[n])) for n in wanted]
    return float(max(apart)), float(max(forces, default=0.0))


@pytest.mark.slow
@pytest.mark.parametrize("engine", REACHED)
def test_engines_move_as_the_reference(engine: str, tmp_path: Path) -> None:
    motion, forces = off(engine, tmp_path)
    assert motion < REACHED[engine]
    assert forces < 1e-4


ARM = """\
scene:
  points: {O: [0, 0]}
  bodies: {arm: {bar: {mass: 1.2, length: 0.8}}}
  joints: {hinge: {pin: ENDS}}
  forces: {help: {motor: hinge, constant: 1.5}}
  drive: {hinge.omega: 2.0}
initial: {hinge: {angle: 0}}
allow: {hinge.angle: 1.0e-2, hinge.torque: 1.0}
"""


@pytest.mark.parametrize(
    ("ends", "way"), [("[ground.O, arm.start]", 1.0), ("[arm.start, ground.O]", -1.0)]
)
def test_a_motor_helps_the_drive(ends: str, way: float, tmp_path: Path) -> None:
    """At an even rate both carry the weight alone: M_drive + M_motor = m g (l/2) cos φ."""
    scene = scenes.typed(tmp_path, ARM.replace("ENDS", ends)).scene
    start = {"arm": (0.4, 0.0, 0.0, 0.0, way * 2.0 * 0.4, way * 2.0)}
    times = np.linspace(0.0, 0.1, 6)
    found = moved(TUNED["mujoco"], scene, start, times, 5e-4, reactions=("hinge.torque",))
    weight = 1.2 * 9.80665 * 0.4 * np.cos(2.0 * times)
    # measured 2e-15 N m: rounding of some 5 N m
    np.testing.assert_allclose(found.reactions["hinge.torque"], way * weight - 1.5, atol=1e-13)


@pytest.mark.slow
@pytest.mark.mutant("torques about a joint counted as the drive's")
def test_what_else_acts_about_the_joint_is_not_the_drive_s(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(reaction, "TORQUES", {})
    assert off("mujoco", tmp_path)[1] > 1.0


@pytest.mark.slow
@pytest.mark.mutant("a motor of pymunk that is told the present rate")
def test_a_motor_told_the_present_rate_is_late(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = told.turned
    monkeypatch.setattr(
        told, "turned", lambda world, step, *, midpoint: sound(world, step, midpoint=False)
    )
    assert off("pymunk", tmp_path)[0] > 1e-4


def test_refusals(tmp_path: Path) -> None:
    rail = LEG.replace(
        "ankle: {pin: [shank.end, foot.start]}",
        "ankle: {slide: [shank.end, foot.start], along: [1, 0]}",
    )
    rail = rail.replace("drive: {", "drive: {ankle.speed: 0.2, ").replace(
        "ankle: {angle: 20 deg, omega: 1.0}", "ankle: {shift: 0}"
    )
    scene = scenes.typed(tmp_path, rail).scene
    assert refused(TUNED["pymunk"], scene) == (
        "engine: pymunk has no motor along a line, as ankle.speed is driven"
    )
    loop = LEG.replace("ankle: {pin", "tip: {pin: [ground.Q, foot.end]}, ankle: {pin")
    loop = loop.replace("O: [0, 0]", "O: [0, 0], Q: [1.0, 0]").replace(
        "drive: {", "drive: {tip.omega: 1, ankle.omega: 1, "
    )
    said = refused(TUNED["mujoco"], scenes.typed(tmp_path, loop).scene)
    assert said is not None
    assert said.endswith("is driven and closes a loop, where MuJoCo has no joint")
