"""Starts in space that are refused: where, in which words, and that what they advise helps."""

import re
from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.start import positions
from textmech.reference.start.assembly import assemble
from textmech.reference.start.spatial_closure import SpatialClosure

BODY = (
    "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}, "
    "points: {p: [0.2, 0, 0], q: [-0.2, 0, 0]}}"
)
FREE = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}, b: {BODY}}}
  joints:
    j2: {{hinge: [a.p, b.q], axis: [0, 1, 0]}}
"""
PAIR = f"{FREE}    j1: {{hinge: [ground.O, a.q], axis: [0, 0, 1]}}\n"
SLIDER = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    a: {bar: {mass: 1.0, length: 0.3}}
    rod: {bar: {mass: 1.0, length: 0.5}}
    piston: {particle: {mass: 1.0}}
  joints:
    motor: {hinge: [ground.O, a.start], axis: [0, 0, 1]}
    big_end: {universal: [a.end, rod.start], axes: [[0, 0, 1], [0, 1, 0]]}
    rail: {slide: [ground.O, piston.center], along: [1, 0, 0]}
    small_end: {ball: [rod.end, piston.center]}
"""
FOUR_BAR = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.9, 0, 0]}
  bodies:
    a: {bar: {mass: 1.0, length: 0.3}}
    b: {bar: {mass: 1.0, length: 0.8}}
    c: {bar: {mass: 1.0, length: 0.6}}
  joints:
    A: {hinge: [ground.O, a.start], axis: [0, 0, 1]}
    B: {hinge: [a.end, b.start], axis: [0, 0, 1]}
    C: {hinge: [b.end, c.end], axis: [0, 0, 1]}
    D: {hinge: [ground.Q, c.start], axis: [0, 0, 1]}
"""
CROSS = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}}}
  joints: {{cross: {{universal: [ground.O, a.q], axes: [[0, 0, 1], [0, 1, 0]]}}}}
initial: {{a: {{p: [0.24, 0.32, 0]}}}}
"""


def started(folder: Path, scene: str) -> None:
    case = typed(folder, f"{scene}allow: {{a.x: 1.0e-3}}\n")
    assemble(case)


def refused(folder: Path, scene: str) -> Mistake:
    with pytest.raises(CaseError) as caught:
        started(folder, scene)
    (mistake,) = caught.value.mistakes
    return mistake


OPEN = "the mechanism cannot be assembled from what is given: "
MORE = "not determined by what is given and the constraints"
WRONG: dict[str, tuple[str, str]] = {
    "coordinates that contradict each other": (
        f"{PAIR}initial: {{j1: {{angle: 30 deg}}, j2: {{angle: 0}}, "
        "a: {attitude: {axis: [0, 0, 1], angle: 40 deg}}}\n",
        f"{OPEN}j1.angle stays open by 10 deg",
    ),
    "a point out of reach": (  # 0.03 m: 0.83 of 0.8, shared by four equations
        f"{SLIDER}initial: {{rail: {{shift: 0.83}}}}\nnear: {{motor: {{angle: 0}}}}\n",
        f"{OPEN}small_end stays open by 0.0075 m",
    ),
    "an open coordinate": (
        f"{PAIR}initial: {{j1: {{angle: 0}}}}\n",
        f"1 more needed: j2.angle is {MORE}",
    ),
    "rates that contradict each other": (
        f"{PAIR}initial: {{j1: {{angle: 0, omega: 1}}, j2: {{angle: 0}}, a: {{vx: 2}}}}\n",
        "the rates violate j1: no motion satisfies all that is given",
    ),
    "open rates": (
        f"{FREE}initial: {{j2: {{angle: 0, omega: 1}}, "
        "a: {x: 0, y: 0, z: 0, attitude: {axis: [0, 0, 1], angle: 0}}}\n",
        "6 more needed: a.vx, a.vy, a.vz, a.omega_1",
    ),
    "a dead centre": (
        f"{SLIDER}initial: {{rail: {{shift: 0.79999999999}}}}\nnear: {{motor: {{angle: 1 deg}}}}\n",
        "the mechanism stands at a dead centre, where what is given hardly determines motor.angle, "
        "small_end.attitude; give one of these instead",
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", WRONG)
def test_what_is_wrong_is_said(what: str, tmp_path: Path) -> None:
    text, words = WRONG[what]
    mistake = refused(tmp_path, text)
    assert mistake.where == "initial"
    assert mistake.what.startswith(words)


@pytest.mark.slow
def test_beside_a_dead_centre_it_starts(tmp_path: Path) -> None:
    near = "near: {motor: {angle: 10 deg}}\n"
    started(tmp_path, f"{SLIDER}initial: {{rail: {{shift: 0.79}}}}\n{near}")


@pytest.mark.slow
@pytest.mark.mutant("a start at a dead centre that nobody refuses")
def test_a_dead_centre_is_not_missed(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Without the question Newton's method stops where the crank is 1e-5 rad off."""
    monkeypatch.setattr(positions, "DEAD", 1e-9)
    started(tmp_path, WRONG["a dead centre"][0])


DEPENDENT: dict[str, tuple[str, str]] = {
    "joints.D": (
        f"{FOUR_BAR}initial: {{A: {{angle: 0}}}}\nnear: {{D: {{angle: 96 deg}}}}\n",
        "replace it by one that holds less (a ball, a universal joint)",
    ),
    "constraints.again": (
        f"{PAIR}  constraints: {{blade: {{edge: b.p, along: [1, 0, 0]}}, "
        "again: {edge: b.p, along: [1, 0, 0]}}\ninitial: {j1: {angle: 0}, j2: {angle: 0.2}}\n",
        "leave it out",
    ),
    "drive.rail.shift_dot": (
        f"{SLIDER}  drive: {{motor.omega: 1.0, rail.shift_dot: 0.0}}\n"
        "initial: {motor: {angle: 30 deg}}\nnear: {rail: {shift: 0.7}}\n",
        "leave it out",
    ),
}


@pytest.mark.slow
@pytest.mark.parametrize("part", DEPENDENT)
def test_what_repeats_others_is_named(part: str, tmp_path: Path) -> None:
    text, words = DEPENDENT[part]
    mistake = refused(tmp_path, text)
    assert mistake.where == f"scene.{part}"
    assert "the constraints are not independent" in mistake.what
    assert words in mistake.what


SKEW = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}}}
  joints:
    s:
      freedoms: {{p: {{hinge: [0, 0, 1]}}, q: {{hinge: [0.1, 0, 1]}}, r: {{hinge: [0, 0.1, 1]}}}}
      of: [ground.O, a.center]
"""
LYING = "initial: {a: {attitude: {axis: [1, 0, 0], angle: 90 deg}}}\n"


@pytest.mark.slow
def test_an_attitude_that_three_turns_cannot_make(tmp_path: Path) -> None:
    mistake = refused(tmp_path, f"{SKEW}{LYING}")
    assert mistake.where == "initial"
    assert "the turns 'p', 'q', 'r' of s cannot make the attitude" in mistake.what
    started(tmp_path, f"{SKEW}initial: {{s: {{p: 0.3, q: -0.4, r: 2.0}}}}\n")
    square = SKEW.replace("[0.1, 0, 1]", "[1, 0, 0]").replace("[0, 0.1, 1]", "[0, 1, 0]")
    started(tmp_path, f"{square}{LYING}")


SEVERAL = {
    "a shift": (f"{SLIDER}initial: {{motor: {{angle: 30 deg}}}}\n", "rail.shift = "),
    "an attitude": (CROSS, "a.attitude = {axis: "),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", SEVERAL)
def test_ways_are_told_and_the_advice_helps(what: str, tmp_path: Path) -> None:
    text, told = SEVERAL[what]
    words = refused(tmp_path, text).what
    assert told in words
    (advice,) = re.findall("for instance (near: .*)$", words)
    started(tmp_path, f"{text}{advice}\n")


TWO = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}, b: {BODY}}}
  joints: {{hub: {{hinge: [ground.O, a.q], axis: [0, 0, 1]}}}}
"""


def test_a_mechanism_without_a_rate_rests_beside_one_that_turns(tmp_path: Path) -> None:
    """As in the plane; and of one of whose rates some are given the others are 0."""
    place = "b: {x: 2, y: 0, z: 0, attitude: {axis: [1, 0, 0], angle: 0}RATE}"
    start = f"initial: {{hub: {{angle: 0, omega: 1}}, {place}}}\n"
    tail = "duration: 1.0\nsamples: 11\nallow: {a.x: 1.0e-2}\n"
    case = typed(tmp_path, TWO, tail=start.replace("RATE", "") + tail)
    _, v = assemble(case)
    assert not np.any(v[-6:])
    assert np.any(v[:6])
    half = typed(tmp_path, TWO, tail=start.replace("RATE", ", vx: 1") + tail)
    _, v = assemble(half)
    assert v[-6:].tolist() == [1.0, 0.0, 0.0, 0.0, 0.0, 0.0]


AXLE = """\
scene:
  space: 3
  bodies:
    cart:
      rigid: {mass: 2, inertia: [0.02, 0.03, 0.04, 0, 0, 0]}
      points: {l: [0, 0.2, 0], r: [0, -0.2, 0], c: [-0.3, 0, -0.05]}
    left: {disk: {mass: 0.3, radius: 0.1, axle: [0, 1, 0]}}
    right: {disk: {mass: 0.3, radius: 0.1, axle: [0, 1, 0]}}
    caster: {sphere: {mass: 0.2, radius: 0.05}}
  joints:
    l: {hinge: [cart.l, left.center], axis: [0, 1, 0]}
    r: {hinge: [cart.r, right.center], axis: [0, 1, 0]}
    c: {ball: [cart.c, caster.center]}
  contacts:
    fl: {between: [left, ground.floor], friction: 1, ideal: rolling}
    fr: {between: [right, ground.floor], friction: 1, ideal: rolling}
    fb: {between: [caster, ground.floor], friction: 1, ideal: rolling}
"""
ONE_WHEEL = "".join(row for row in AXLE.splitlines(True) if "fr:" not in row)


def all_mistakes(tmp_path: Path, text: str) -> list[str]:
    with pytest.raises(CaseError) as error:
        assemble(typed(tmp_path, f"{text}allow: {{cart.x: 1.0e-2}}\n"))
    return [mistake.what for mistake in error.value.mistakes]


@pytest.mark.parametrize(
    ("start", "lacking"),
    [
        ("{cart: {x: 0, y: 0, vx: 1}}", "3 more needed: l.angle, r.angle, cart.attitude"),
        (
            "{cart: {x: 0, y: 0}, l: {angle: 0}, r: {angle: 0}}",
            "1 more needed: cart.attitude",
        ),
    ],
)
def test_two_wheels_on_an_axle_are_told_their_reason_first_and_all_that_lacks(
    tmp_path: Path, start: str, lacking: str
) -> None:
    """Neither is held by fewer words once more is given, so it is not asked for to no end."""
    reason, more = all_mistakes(tmp_path, f"{AXLE}initial: {start}\n")
    assert reason.startswith("the constraints are not independent")
    assert more.startswith(f"{lacking} ")


def test_what_is_named_is_enough(tmp_path: Path) -> None:
    """Of one wheel nothing is held twice: each name that is given takes its part of the number."""
    rows = [
        ("{cart: {x: 0, y: 0}}", "4 more needed: l.angle, r.angle, cart.attitude are"),
        ("{cart: {x: 0, y: 0}, l: {angle: 0}, r: {angle: 0}}", "2 more needed: cart.attitude is"),
    ]
    for start, expected in rows:
        (what,) = all_mistakes(tmp_path, f"{ONE_WHEEL}initial: {start}\n")
        assert what.startswith(expected)
    upright = (
        "{cart: {x: 0, y: 0, attitude: {axis: [0, 0, 1], angle: 0}}, l: {angle: 0}, r: {angle: 0}}"
    )
    assemble(typed(tmp_path, f"{ONE_WHEEL}initial: {upright}\nallow: {{cart.x: 1.0e-2}}\n"))


@pytest.mark.mutant("of an open start in space only the joints' coordinates are named")
def test_a_body_that_a_joint_holds_may_be_what_lacks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(SpatialClosure, "_open_places", lambda closure, loose, small: {})
    (what,) = all_mistakes(tmp_path, f"{ONE_WHEEL}initial: {{cart: {{x: 0, y: 0}}}}\n")
    assert "cart.attitude" not in what


@pytest.mark.mutant("what is held twice is told once all is given")
def test_a_reason_that_comes_last_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(positions, "_repeated", lambda closure, q, loose: None)
    (what,) = all_mistakes(tmp_path, f"{AXLE}initial: {{cart: {{x: 0, y: 0}}}}\n")
    assert "not independent" not in what
