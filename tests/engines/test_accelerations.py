"""Accelerations of bodies: the reference's, and what engines know of them."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.planning import TUNED, moved, planned

from textmech.cases.case import Case
from textmech.engines.mujoco.read import readout as read
from textmech.reference.motion import bodies
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first

FIELDS = ("arm.ax", "arm.ay", "arm.alpha", "rod.alpha", "bob.ax", "bob.ay")
SCENE = """\
scene:
  points: {O: [0, 0], hook: {at: [0, 0.5], velocity: [0.3, 0]}}
  bodies:
    rod: {bar: {mass: 1.2, length: 0.8}}
    arm: {bar: {mass: 0.7, length: 0.5}}
    bob: {particle: {mass: 0.3}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [rod.end, arm.start]}}
  forces: {coil: {spring: [bob.center, ground.hook], stiffness: 20.0, rest_length: 0.2}}
initial: {hinge: {angle: -20 deg, omega: 1}, elbow: {angle: 30 deg, omega: 2}, bob: {x: 0.4, y: 0}}
allow: {arm.ax: 1.0, arm.ay: 1.0, arm.alpha: 1.0, rod.alpha: 1.0, bob.ax: 1.0, bob.ay: 1.0}
"""


def case(folder: Path) -> Case:
    return scenes.typed(folder, SCENE, tail=scenes.tail(0.5, 501))


def off(folder: Path) -> float:
    """How far the reference's are from differences of its velocities, of their size."""
    motion = solve(case(folder)).trajectory
    worst = 0.0
    for name in FIELDS:
        body, _, field = name.partition(".")
        v = motion.states[body][:, {"ax": 3, "ay": 4, "alpha": 5}[field]]
        rate = (8 * (v[3:-1] - v[1:-3]) - (v[4:] - v[:-4])) / 12e-3
        a = motion.reactions[name]
        worst = max(worst, float(np.max(np.abs(rate - a[2:-2])) / np.max(np.abs(a))))
    return worst


@pytest.mark.slow
def test_the_reference_s_are_the_rates_of_its_velocities(tmp_path: Path) -> None:
    assert off(tmp_path) < 1e-7  # measured 2.4e-8: the h⁴ of the differences


@pytest.mark.slow
@pytest.mark.mutant("accelerations 1 % too small")
def test_a_lost_term_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    sound = bodies.accelerations

    def lost(*given: object) -> dict[str, float]:
        return {k: 0.99 * a for k, a in sound(*given).items()}  # type: ignore[arg-type]

    monkeypatch.setattr(bodies, "accelerations", lost)
    assert off(tmp_path) > 1e-3


def apart(folder: Path) -> float:
    """MuJoCo's from the reference's [m/s², rad/s²]."""
    one = scenes.typed(folder, SCENE, tail=scenes.tail(0.5, 26))
    known = solve(one).trajectory
    found = moved(TUNED["mujoco"], one.scene, first(known), one.times, 1e-3, reactions=FIELDS)
    return max(
        float(np.max(np.abs(found.reactions[name] - known.reactions[name]))) for name in FIELDS
    )


@pytest.mark.slow
def test_mujoco_s_are_the_reference_s(tmp_path: Path) -> None:
    assert apart(tmp_path) < 1e-5  # measured 2e-7, of 40 m/s²


@pytest.mark.slow
@pytest.mark.mutant("ax read for ay")
def test_mujoco_s_weight_is_no_acceleration(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its world falls upward: with the other field for `ay`, or without gravity, it is seen."""
    monkeypatch.setattr(read, "FIELDS", ("ay", "ax", "alpha"))
    assert apart(tmp_path) > 1.0


@pytest.mark.slow
def test_pymunk_knows_none(tmp_path: Path) -> None:
    one = case(tmp_path)
    start = first(solve(one).trajectory)
    said = planned(TUNED["pymunk"], one.scene, start).withheld
    assert {said[name] for name in FIELDS} == {
        "engine: pymunk knows velocities and impulses, and no accelerations"
    }
