"""Muscles on what lands, lifts off, is caught or struck: a jump of velocities, no muscle jumps."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes import mode_selection as choosing
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Array

F_0, B, C, MASS, G = 600.0, 2000.0, 20000.0, 10.0, 9.80665
END = scenes.tail(0.6, 31)

LIFTED = f"""\
scene:
  points: {{S: [0, 1.0], O: [0, -0.5]}}
  bodies: {{load: {{particle: {{mass: {MASS}}}}}}}
  joints: {{rail: {{slide: [ground.S, load.center], along: [0, 1]}}}}
  contacts: {{touch: {{between: [load, ground.floor], friction: 0}}}}
  forces:
    m:
      linear_muscle: [ground.S, load.center]
      isometric: {F_0}
      damping: {B}
      series_stiffness: {C}
      parallel_stiffness: 0
      rest_length: 1.0
      contractile_length: 1.0
    cord: {{rope: [ground.O, load.center], length: 0.6}}
initial: {{load: {{x: 0, y: 0}}}}
allow: {{load.y: 1.0e-3, m.force: 1.0}}
"""

STRUCK = """\
scene:
  points: {O: [0, 0], S: [0, 0.3]}
  bodies: {arm: {bar: {mass: 1.5, length: 0.35}, points: {I: [-0.125, 0]}}}
  joints: {elbow: {pin: [ground.O, arm.start]}}
  forces:
    m:
      muscle: [ground.S, arm.I]
      isometric: 600
      hill_a: 150
      hill_b: 0.05
      series_stiffness: 20000
      parallel_stiffness: 0
      rest_length: 0.3
      contractile_length: 0.3
    ends: {stops: elbow, low: -80 deg, high: 60 deg, restitution: 0.5}
initial: {elbow: {angle: -10 deg, omega: 0}}
allow: {arm.angle: 1.0e-2, m.force: 1.0}
"""


@pytest.mark.slow
def test_a_load_is_lifted_and_caught_by_a_rope(tmp_path: Path) -> None:
    """At rest F₀ − F falls as exp(−c t/b): on the floor until F = m g, and from F₁ on the rope."""
    case = scenes.typed(tmp_path, LIFTED, tail=END)
    found = solve(case)
    assert found.holds
    lifts, _, taut = found.trajectory.switches  # once it falls back before it hangs
    assert lifts == pytest.approx(-B / C * math.log(1 - MASS * G / F_0), abs=1e-12)
    force, times = observe(case.scene, found.trajectory, "m.force"), case.times
    on_floor = F_0 * (1 - np.exp(-C / B * times))
    np.testing.assert_allclose(force[times < lifts], on_floor[times < lifts], rtol=1e-11)
    held = np.flatnonzero(times > taut)
    dies = np.exp(-C / B * (times[held] - times[held[0]]))
    np.testing.assert_allclose(F_0 - force[held], (F_0 - force[held[0]]) * dies, rtol=1e-9)
    np.testing.assert_allclose(found.trajectory.states["load"][held, 1], 0.1, rtol=1e-12)


@pytest.mark.slow
def test_a_stop_turns_the_arm_and_not_the_muscle(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, STRUCK, tail=END)
    assert solve(case).holds
    first, *_, last = follow(scenes.mechanism(case), case.times).events
    assert first.name == last.name == "ends.high strikes"
    np.testing.assert_allclose(first.after[:4], first.before[:4], rtol=0, atol=1e-12)
    np.testing.assert_allclose(first.after[4:], -0.5 * first.before[4:], rtol=1e-12)
    assert last.mode_after == "ends.low open, ends.high acts"
    np.testing.assert_allclose(last.after[:4], last.before[:4], rtol=0, atol=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("a muscle whose inner state is moved by an impact")
def test_a_muscle_that_is_struck_too_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    sound = choosing.placed

    def wrong(M: Array, f: Array, gaps: Array, q: Array) -> Array:
        return np.append(sound(M, f, gaps, q)[:-1], q[-1] + 1e-4)

    monkeypatch.setattr(choosing, "placed", wrong)
    case = scenes.typed(tmp_path, STRUCK, tail=END)
    change = follow(scenes.mechanism(case), case.times).events[-1]
    assert abs(change.after[3] - change.before[3]) > 1e-5
