"""A spring of rest length 0: its ends may meet, and it swings through."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

THROUGH = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {dot: {particle: {mass: 2}}}
  forces: {coil: {spring: [ground.O, dot.center], stiffness: 50, rest_length: 0}}
initial: {dot: {x: X, y: Y, vx: 3, vy: 1}}
allow: {dot.x: 1.0e-3, coil.force: 1.0e-2}
"""
TIMES = np.linspace(0.0, 1.0, 26)


@pytest.mark.parametrize("start", [(0.0, 0.0), (0.3, 0.1), (-0.2, 0.7)])
def test_it_swings_through_its_anchor(tmp_path: Path, start: tuple[float, float]):
    """r = r₀ cos ω t + (v₀/ω) sin ω t, ω² = c/m: through the anchor, or around it."""
    text = THROUGH.replace("X", str(start[0])).replace("Y", str(start[1]))
    mechanism = scenes.mechanism(scenes.typed(tmp_path, text))
    found = follow(mechanism, TIMES).y[:, :2]
    known = np.outer(np.cos(5 * TIMES), start) + np.outer(np.sin(5 * TIMES), [3, 1]) / 5
    np.testing.assert_allclose(found, known, atol=1e-13)


def test_it_is_certified(tmp_path: Path):
    text = THROUGH.replace("X", "0").replace("Y", "0")
    assert solve(scenes.typed(tmp_path, text)).holds


@pytest.mark.slow
def test_a_stiff_one_is_followed(tmp_path: Path):
    """1e8 N/m on 2 kg: fifty swings, each in a thousandth of a second."""
    text = THROUGH.replace("stiffness: 50", "stiffness: 1.0e+8").replace("Y, vx: 3, vy: 1", "0")
    mechanism = scenes.mechanism(scenes.typed(tmp_path, text.replace("X", "0.01")))
    times = TIMES / 20
    found = follow(mechanism, times).y[:, 0]
    np.testing.assert_allclose(found, 0.01 * np.cos(np.sqrt(5e7) * times), atol=1e-10)
