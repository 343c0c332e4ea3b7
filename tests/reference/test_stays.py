"""A place that stays may be the claim itself: then it is compared, and it has to be true."""

from pathlib import Path

import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference.solve import solve

# The end of the rod runs on a straight line, though nothing guides it there.
SCOTT_RUSSELL = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {crank: {bar: {mass: 0.4, length: 0.5}}, rod: {bar: {mass: 0.8, length: 1.0}}}
  joints:
    axle: {pin: [ground.O, crank.start]}
    middle: {pin: [crank.end, rod.center]}
    foot: {slot: [ground.O, rod.start], along: [1, 0]}
initial: {crank: {angle: 50 deg, omega: 0.3}}
near: {rod: {angle: 130 deg}}
allow: {rod.end.x: 1.0e-6, rod.end.y: 1.0e-3}
"""


@pytest.mark.slow
def test_a_straight_line_that_a_linkage_keeps_is_a_claim(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"say what is claimed: `stays: \[rod.end.x\]`"):
        solve(typed(tmp_path, SCOTT_RUSSELL))
    assert solve(typed(tmp_path, f"{SCOTT_RUSSELL}stays: [rod.end.x]\n")).holds


@pytest.mark.parametrize("more", ["", "rests: true\n"])
def test_what_is_said_to_stay_and_moves_is_a_mistake(tmp_path: Path, more: str) -> None:
    with pytest.raises(CaseError) as caught:
        solve(typed(tmp_path, f"{SCOTT_RUSSELL}stays: [rod.end.x, rod.end.y]\n{more}"))
    (mistake,) = caught.value.mistakes
    assert mistake.where == "stays.1"
    assert mistake.what.startswith("moves by ")


SLIDES = """\
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [0.5, 0.4, 0.3, 0.02, 0, 0]}}}
  joints: {q: {slide: [ground.O, b.center], along: [1, 0, 0]}}
initial: {q: {shift: 0, shift_dot: 3}}
allow: {q.shift: 1.0e-3, b.omega_1: 1.0e-3}
"""


@pytest.mark.slow
def test_where_nothing_turns_a_rate_of_rounding_is_none(tmp_path: Path) -> None:
    """It has no size to be small against but 1 rad in the whole duration."""
    assert solve(typed(tmp_path, f"{SLIDES}stays: [b.omega_1]\n")).holds
    with pytest.raises(CaseError, match="never moves"):
        solve(typed(tmp_path, SLIDES))


@pytest.mark.mutant("a rate that changes by 1e-10 rad/s taken for one that stays")
def test_a_rate_that_is_none_of_rounding_moves(tmp_path: Path) -> None:
    """(2.33) ω̇₁ = (J₂ − J₃) ω₂ ω₃/J₁ = 6e-11 rad/s², where all turns are slow."""
    free = """\
scene:
  space: 3
  gravity: none
  bodies: {b: {rigid: {mass: 1, inertia: [0.5, 0.4, 0.3, 0, 0, 0]}}}
initial:
  b: {x: 0, y: 0, z: 0, vx: 3, attitude: {axis: [0, 0, 1], angle: 0}, omega: [0, 3.0e-5, 1.0e-5]}
allow: {b.x: 1.0e-3, b.omega_1: 1.0e-3}
"""
    with pytest.raises(CaseError, match="moves by"):
        solve(typed(tmp_path, f"{free}stays: [b.omega_1]\n"))
