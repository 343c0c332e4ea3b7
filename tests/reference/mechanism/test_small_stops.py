"""A stop's gap is an angle: what is none of it does not hang on the scene's size."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.scenes import tail, typed

from textmech.reference.solve import solve

STRUCK = """\
scene:
  gravity: 9.8
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1.0e-9, length: LENGTH}}}
  joints: {h: {pin: [ground.O, b.start]}}
  forces: {s: {stops: h, low: -60 deg, restitution: 0.5}}
initial: {b: {angle: 10 deg}}
allow: {b.angle: 0.01}
"""
STRIKES = (1.295699095659, 2.974169859625)  # √(l/g), found for 0.6 m


@pytest.mark.slow
@pytest.mark.mutant("the gap of a stop is small against a length")
@pytest.mark.parametrize("length", [6.0e-7, 6.0e-5, 0.6, 600.0])
def test_a_bar_of_any_length_bounces_on_its_stop(length: float, tmp_path: Path) -> None:
    unit = math.sqrt(length / 9.8)
    case = typed(tmp_path, STRUCK.replace("LENGTH", repr(length)), tail=tail(4.8 * unit, 11))
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    first = found.trajectory.switches[:2] / unit
    assert np.max(np.abs(first - STRIKES)) < 1e-9
