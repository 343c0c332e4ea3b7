"""Points that move by a law: a pivot that accelerates is a pendulum in another gravity."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.reference.mechanism.kinematics import signal
from textmech.reference.solve import solve

HUNG = """\
scene:
  GRAVITY
  points: {O: PIVOT}
  bodies: {bar: {bar: {mass: 1.2, length: 0.8}}, bob: {particle: {mass: 0.4}}}
  joints: {JOINT}
  forces: {coil: {spring: [bob.center, bar.end], stiffness: 30.0, rest_length: 0.1}}
initial: START
allow: {bar.angle: 1.0e-2}
"""
A = 3.0
RESTS = "bob: {x: 0.9, y: -0.5, vx: 0, vy: 0}"
HANGS = {
    "pin": ("hinge: {pin: [ground.O, bar.start]}", "bar: {angle: -40 deg, omega: 0}"),
    "distance": (
        "rod: {distance: [ground.O, bar.start]}",
        "bar: {x: 0.5, y: -0.4, angle: -40 deg, vx: 0, vy: 0, omega: 0}",
    ),
    "slot": (
        "guide: {slot: [bar.start, ground.O], along: [1, 0]}",
        "bar: {angle: -40 deg, x: 0.25, vx: 0, omega: 0}",
    ),
}


def apart(kind: str, folder: Path) -> float:
    """How far [rad] the two turn differently."""
    joint, begins = HANGS[kind]
    law = f"polynomial: {{along: [1, 0], coefficients: [0, 0, {A / 2}]}}"
    angles = []
    for gravity, pivot in (
        ("", f"{{at: [0, 0], moves: {{{law}}}}}"),
        (f"gravity: [{-A}, -9.80665]", "[0, 0]"),
    ):
        text = HUNG.replace("JOINT", joint).replace("START", f"{{{begins}, {RESTS}}}")
        text = text.replace("  GRAVITY\n", f"  {gravity}\n" if gravity else "")
        motion = solve(scenes.typed(folder, text.replace("PIVOT", pivot))).trajectory
        angles.append(motion.states["bar"][:, 2])
    return float(np.max(np.abs(angles[0] - angles[1])))


@pytest.mark.slow
@pytest.mark.parametrize("kind", HANGS)
def test_an_accelerated_pivot_is_another_gravity(kind: str, tmp_path: Path) -> None:
    assert apart(kind, tmp_path) < 1e-12


@pytest.mark.slow
@pytest.mark.mutant("acceleration of a moving point left out of a {kind}")
@pytest.mark.parametrize("kind", HANGS)
def test_a_lost_acceleration_is_seen(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(signal, "BENDS", dict.fromkeys(signal.BENDS, lambda law, t: 0.0))
    assert apart(kind, tmp_path) > 1e-3
