"""Spokes and their tips: where they are, what they may do, and how a start stands on one."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.shape import spokes
from textmech.cases.trajectory import Trajectory
from textmech.reference.start.assembly import start_poses

L, J = 0.3, 0.09
SCENE = """\
scene:
  bodies: {{wheel: {{spokes: {{number: 6, length: 0.3, mass: 2, inertia: 0.09}}{points}}}}}
  contacts: {{feet: {{between: [{at}, ground.floor], friction: 1{ideal}}}}}
initial: {{wheel: {{{start}}}}}
allow: {{wheel.x: 1.0e-3}}
"""
SOUND = {
    "points": "",
    "at": "wheel",
    "ideal": ", ideal: pivot",
    "start": "x: 0, angle: 0, on: tip1, omega: -2",
}


def test_tips_stand_on_a_circle_counter_clockwise() -> None:
    body = spokes(name="wheel", number=6, length=L, mass=2.0, inertia=J, points={"P": (0.1, 0.0)})
    tips = np.array([body.points[tip] for tip in body.tips])
    assert np.hypot(*tips.T) == pytest.approx(L)
    turns = np.unwrap(np.arctan2(tips[:, 1], tips[:, 0]))
    assert np.diff(turns) == pytest.approx(math.tau / 6)
    assert tips[0] == pytest.approx((-L / 2, -L * math.cos(math.pi / 6)))
    assert tips[1] == pytest.approx((L / 2, -L * math.cos(math.pi / 6)))
    assert (body.moment, body.points["P"]) == (J, (0.1, 0.0))


def test_a_start_stands_on_a_tip_that_does_not_move(tmp_path: Path) -> None:
    """y = l cos α, and v = ω × r from the tip at (l sin α, 0)."""
    case = typed(tmp_path, SCENE.format(**SOUND))
    height = L * math.cos(math.pi / 6)
    wanted = (0.0, height, 0.0, 2 * height, 2 * L / 2, -2.0)
    assert start_poses(case)["wheel"] == pytest.approx(wanted, abs=1e-15)


def test_gap_and_slip_are_of_the_lowest_tips(tmp_path: Path) -> None:
    """Turned by 10° about tip1 the next one is l sin 10° − … above the floor; and slip of tip1."""
    scene = typed(tmp_path, SCENE.format(**SOUND)).scene
    turn, half = math.radians(10), math.pi / 6
    x, y = L * math.sin(half) - L * math.sin(half - turn), L * math.cos(half - turn)
    states = {"wheel": np.array([[x, y, -turn, 0.5, 0.0, -2.0], [x, y, 0.0, 0.5, 0.0, 0.0]])}
    motion = Trajectory(np.array([0.0, 1.0]), states, {})
    gap, slip = (observe(scene, motion, f"feet.{field}") for field in ("gap", "slip"))
    assert gap[0] == pytest.approx(y - L * math.cos(half + turn), rel=1e-12)
    assert slip == pytest.approx([0.5 - 2.0 * y, 0.5])
    assert not any(name.startswith("feet.") and "drift" in name for name in table(scene))


@pytest.mark.parametrize(
    ("changed", "words"),
    [
        ({"ideal": ""}, "'wheel' has spokes, which only pivot here: write `ideal: pivot`"),
        ({"at": "wheel.tip1"}, "'wheel' touches with its tips: write 'wheel'"),
        ({"points": ", points: {tip5: [0, 0]}"}, "the name 'tip5' is taken"),
        ({"start": "x: 0, on: tip6, omega: -2"}, "body 'wheel' has no point 'tip6'"),
    ],
)
def test_what_spokes_cannot_is_said(tmp_path: Path, changed: dict[str, str], words: str) -> None:
    with pytest.raises(CaseError) as caught:
        typed(tmp_path, SCENE.format(**{**SOUND, **changed}))
    assert words in str(caught.value)


@pytest.mark.parametrize(
    ("start", "words"),
    [
        ("x: 0, angle: 0, on: tip1, vx: 1, omega: -2", "`on` says that"),
        ("x: 0, angle: 0, y: 1, on: tip1", "stays open by"),
        ("angle: 0, on: tip1", "wheel.x is not determined"),
    ],
)
def test_a_start_that_cannot_be_is_said(tmp_path: Path, start: str, words: str) -> None:
    case = typed(tmp_path, SCENE.format(**{**SOUND, "start": start}))
    with pytest.raises(CaseError, match=words):
        start_poses(case)


def test_spokes_are_a_whole_number(tmp_path: Path) -> None:
    path = tmp_path / "case.yaml"
    scene = SCENE.format(**SOUND).replace("number: 6", "number: n")
    path.write_text(f"title: x\nparameters: {{n: 8.4}}\n{scene}duration: 1\nsamples: 3\n")
    with pytest.raises(CaseError, match=r"from 3 to 100, is 8.4 \(n\)"):
        load(path)


FEET = """\
scene:
  bodies: {{a: {{bar: {{mass: 1, length: 1}}}}, b: {{bar: {{mass: 1, length: 1}}}}}}
  joints: {{hip: {{pin: [a.end, b.end]}}}}
  contacts:
    one: {{between: [a.start, ground.floor], friction: 1, ideal: pivot, ahead_of: {one}}}
    two: {{between: [b.start, ground.floor], friction: 1, ideal: pivot{two}}}
initial: {{a: {{start: [0, 0], on: start, angle: 100 deg}}, b: {{angle: 80 deg}}}}
allow: {{a.angle: 1.0e-3}}
"""


@pytest.mark.parametrize(
    ("one", "two", "words"),
    [
        ("b.start", "", "'b.start' should be the other foot, with a contact ahead of this one"),
        ("b.end", ", ahead_of: a.start", "'b.end' should be the other foot"),
        ("b.stop", ", ahead_of: a.start", "body 'b' has no point 'stop'"),
        ("c.start", ", ahead_of: a.start", "unknown body 'c'"),
    ],
)
def test_feet_are_two(tmp_path: Path, one: str, two: str, words: str) -> None:
    with pytest.raises(CaseError) as caught:
        typed(tmp_path, FEET.format(one=one, two=two))
    assert words in str(caught.value)
    typed(tmp_path, FEET.format(one="b.start", two=", ahead_of: a.start"))
