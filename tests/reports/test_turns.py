"""An engine's turns in space are counted between the samples, where these are far apart."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array, Trajectory
from textmech.reports.compare.trial import run as turns

SCENE = """\
title: A body that turns evenly
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [1, 1, 1, 0, 0, 0]}}}
  joints: {q: {hinge: [ground.O, b.center], axis: [0, 0, 1]}}
initial: {q: {angle: 400 deg, omega: 20}}
duration: 3
samples: 4
step: 1.0e-2
allow: {q.angle: 1.0}
"""
RATE = 20.0  # rad/s


def run(times: Array) -> Trajectory:
    """It speeds up and slows down, so that its rate at whole seconds says nothing."""
    angle = math.radians(400) + RATE * (times - np.sin(math.tau * times) / math.tau)
    rate, still = RATE * (1 - np.cos(math.tau * times)), np.zeros((len(times), 3))
    zero = np.zeros(len(times))
    attitude = np.column_stack([np.cos(angle / 2), zero, zero, np.sin(angle / 2)])
    states = np.hstack([still, attitude, still, zero[:, None], zero[:, None], rate[:, None]])
    return Trajectory(times, {"b": states}, {"q.fx": times})


@pytest.mark.mutant("turns of an engine guessed from its samples")
def test_an_engine_is_asked_between_its_samples(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    path.write_text(SCENE)
    (case,) = scenes.load(path)
    found = turns.counted(case, run, 0.01, 2 * RATE)
    expected = math.radians(400) + RATE * case.times
    np.testing.assert_allclose(observe(case.scene, found, "q.angle"), expected, atol=1e-9)
    np.testing.assert_array_equal(found.times, case.times)
    np.testing.assert_allclose(found.reactions["q.fx"], case.times, atol=1e-12)
    guessed = observe(case.scene, run(case.times), "q.angle")
    assert np.max(np.abs(guessed - expected)) > 6.0


def test_samples_are_cut_into_whole_steps() -> None:
    assert turns.between(0.1, 0.01, 0.0) == 1
    assert turns.between(0.1, 0.01, 10.0) == 1
    assert turns.between(0.1, 0.01, 15.0) == 2
    assert turns.between(0.1, 0.01, 30.0) == 5
    assert turns.between(0.1, 0.01, 1e6) == 10
