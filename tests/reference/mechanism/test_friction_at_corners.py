"""Friction at the very instant at which a push jumps: what it is just after, at any samples."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.scene.observe import observe
from textmech.reference.solve import solve

PULSED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {box: {particle: {mass: 1.0}}}
  joints:
    rail:
      slide: [ground.O, box.center]
      along: [1, 0]
      dry_friction: {static: 6.0 N, kinetic: 4.0 N}
  forces:
    hand: {push: box.center, pulse: {amplitude: [PUSH, 0], from: 0.2, until: 0.5}}
    tow: {push: box.center, constant: [1.0, 0]}
initial: {rail: {shift: 0, speed: 0}}
allow: {rail.friction: 1.0, rail.shift: 1.0}
"""
# N at the start, from 0.2 s on and from 0.5 s on, where it slips still at 8 N
TOLD = {3.0: (-1.0, -4.0, -1.0), 8.0: (-1.0, -4.0, -4.0)}


@pytest.mark.slow
@pytest.mark.parametrize("push", TOLD)
@pytest.mark.parametrize("samples", [11, 31, 77, 101])
def test_friction_at_a_corner_is_that_after_it(push: float, samples: int, tmp_path: Path) -> None:
    """It holds against the new push, or slips under it; both corners are samples in all of these
    but in 77, of which none is 0.2 s."""
    text = PULSED.replace("PUSH", repr(push)) + ("stays: [rail.shift]\n" if push < 5 else "")
    case = scenes.typed(tmp_path, text, tail=scenes.tail(1.0, samples))
    motion = solve(case)
    friction = observe(case.scene, motion.trajectory, "rail.friction")
    moves = push > 5
    at = np.searchsorted([0.2, 0.5], case.times, side="right")
    # 8 N: 5 m/s² for 0.3 s, and −3 m/s² for as long as there is a speed, 0.5 s
    known = np.where(moves & (case.times >= 1.0), -1.0, np.array(TOLD[push])[at])
    told = slice(-1 if moves else None)  # at the last it comes to rest, by rounding before or after
    np.testing.assert_allclose(friction[told], known[told], rtol=0, atol=1e-12)
    known_way = 5 * 0.3**2 / 2 + 1.5 * 0.5 - 3 * 0.5**2 / 2 if moves else 0.0
    shift = observe(case.scene, motion.trajectory, "rail.shift")[-1]
    assert shift == pytest.approx(known_way, abs=1e-12)
    assert [check.name for check in motion.checks if not check.holds] == []
