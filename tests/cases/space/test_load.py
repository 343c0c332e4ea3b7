"""What becomes of the words of a case in space, and every mistake that only it can have."""

import re
from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest
from given.machines.spatial_motions import turn
from given.scenes import cases_of, mistakes_of
from given.scenes.spatial_case import SOUND

from textmech.cases.case import Case
from textmech.cases.scene import (
    STANDARD_GRAVITY,
    Anchor,
    Push,
    Scene,
    Signal,
    Torque,
)
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import matrix

# What becomes of the words of a case in space.

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def case_of(text: str) -> Case:
    (case,) = cases_of(text)
    return case


def scene_of(text: str = SOUND) -> Scene:
    return case_of(text).scene


@pytest.mark.parametrize(
    ("words", "gravity"),
    [
        ("incline: phi0", (STANDARD_GRAVITY * sin(pi / 6), 0, -STANDARD_GRAVITY * cos(pi / 6))),
        ("gravity: none", (0, 0, 0)),
        ("gravity: 1.62 m/s^2", (0, 0, -1.62)),
        ("gravity: 1.62\n  incline: phi0", (1.62 * sin(pi / 6), 0, -1.62 * cos(pi / 6))),
        ("gravity: [0.1, -0.2, -1.62 m/s^2]", (0.1, -0.2, -1.62)),
    ],
)
def test_gravity(words: str, gravity: tuple[float, float, float]) -> None:
    scene = scene_of(SOUND.replace("incline: phi0", words))
    assert scene.gravity == pytest.approx(gravity, rel=1e-15)


def test_contacts_forces_and_drives() -> None:
    scene = scene_of()
    at = Anchor("globe", "center")
    assert scene.contacts == {"touch": spatial_contact("touch", at, 0.5, rim=False)}
    on_rim = scene_of(SOUND.replace("[globe, ground", "[wheel, ground"))
    assert on_rim.contacts["touch"].rim
    assert scene.forces["hand"] == Push("hand", Anchor("wheel", "center"), Signal("constant", X))
    spin = Signal("sine", (0.0, 0.0, 1.0), pytest.approx(2 * pi / 3))  # type: ignore[arg-type]
    assert scene.forces["motor"] == Torque("motor", "top", spin)
    assert scene.drives == {
        "upright.theta_dot": Signal("constant", (2.0,)),
        "q1.omega": Signal("sine", (2.0,), 2.0, radians(30)),
    }
    assert scene.driven() == {
        "upright": {"theta_torque": ("N m", "force")},
        "q1": {"torque": ("N m", "force")},
    }
    shifted = scene_of(SOUND.replace("upright.theta_dot: w", "rail.shift_dot: {ramp: 3}"))
    assert shifted.drives["rail.shift_dot"] == Signal("ramp", (3.0,))
    assert table(shifted)["rail.shift_force"].unit == "N"
    assert "upright.theta_torque" not in table(shifted)


def test_each_turn_of_an_attitude_is_about_the_axes_that_those_before_it_leave() -> None:
    """About the ground's z, and then about the x that has turned with it."""
    found = case_of(SOUND).initial["top"].attitude
    assert found is not None
    about_x = turn([cos(0.1), sin(0.1), 0.0], radians(30))
    expected = about_x @ turn(Z, 0.1)
    np.testing.assert_allclose(matrix(np.array(found)), expected, atol=1e-15)


# Every mistake that only a case in space can have: its place, its field, and what is said.

ENGINES = {"mujoco": ("shipped", "tuned"), "pymunk": ("shipped", "tuned")}
TABLE = Path(__file__).with_name("mistakes.txt").read_text(encoding="utf-8")
EACH = re.findall(r"^- (.*)\n\+ (.*)\n(\d+:\d+): ([^:]*): (.*)$", TABLE, flags=re.MULTILINE)


def mistakes(text: str) -> list[tuple[str, str, str]]:
    told = mistakes_of(text, engines=ENGINES)
    return [(f"{m.line}:{m.column}", m.where, m.what) for m in told]


def test_sound() -> None:
    assert mistakes(SOUND) == []


def test_table_is_read_whole() -> None:
    assert len(EACH) == TABLE.count("\n- ") > 80


@pytest.mark.parametrize(("old", "new", "place", "field", "what"), EACH)
def test_each(old: str, new: str, place: str, field: str, what: str) -> None:
    assert SOUND.count(old) == 1
    text = SOUND.replace(old, new.replace(r"\n", "\n"))
    assert mistakes(text) == [(place, field, what)]


@pytest.mark.parametrize("free", [False, True])
def test_a_mistaken_parameter_is_named_once(free: bool) -> None:
    """What it spoils is neither judged nor computed with: lengths, tensors and axes."""
    text = SOUND.replace("along: [0, 3, 4]", "along: [0, 3, J]").replace("J: 0.05", "J: 0.05 q")
    text = text.replace("l: 0.8 m", "l: 0.8 q").replace("{slide: [1, 0, 0]}", "{slide: [1, J, 0]}")
    if free:  # the bar hangs on its spring alone
        text = text.replace("bar.start]", "box.center]")
        text = text.replace("universal: [bar.end, box", "universal: [box.center, top")
    assert [where for _, where, _ in mistakes(text)] == ["parameters.l", "parameters.J"]


def test_all_at_once() -> None:
    """A broken part hides no other, and drags nothing along: q1's own quantities are not named."""
    text = SOUND.replace("axis: [0, 0, 2]", "axis: [0, 0]")
    text = text.replace("touch.slip: unknown", "touch.slp: unknown")
    text = text.replace("constant: [1.0, 0, 0]", "constant: [1.0]")
    text = text.replace("slide: [ground.O, bob.center]", "slide: [ground.O, bobb.center]")
    text = text.replace("y: 0, z: 0.25", "yy: 0, z: 0.25 kg")
    assert [(where, what) for _, where, what in mistakes(text)] == [
        ("scene.joints.q1.axis", "should be a list of 3, has 2"),
        ("scene.joints.rail.slide.1", "unknown body 'bobb'; did you mean 'bob'?"),
        ("scene.forces.hand.constant", "should be a list of 3, has 1"),
        ("initial.globe.yy", "unknown key 'yy'; did you mean 'y'?"),
        ("initial.globe.z", "is '0.25 kg', but m was expected"),
        ("allow.touch.slp", "unknown quantity 'touch.slp'; did you mean 'touch.slip'?"),
    ]


# A body that nothing keeps from turning about an axis, and that has no inertia about it.

TEXT = """\
title: A body on its joints
scene:
  space: 3
  points: {{O: [0, 0, 0], Q: [1, 0, 0]}}
  bodies:
    rod: {body}
    box: {{block: {{mass: 1.0, size: [0.1, 0.1, 0.1]}}}}
  joints: {{{joints}}}
initial: {{box: {{x: 0}}}}
duration: 1.0
samples: 26
allow: {{box.x: 1.0e-3}}
"""
BAR = "{bar: {mass: 1.0, length: 0.5}, points: {side: [0.1, 0.2, 0], on: [0.1, 0, 0]}}"
THIN = "{rigid: {mass: 1.0, inertia: [0.5, 0.5, 1.0, -0.5, 0, 0]}, points: {P: [0.1, 0.1, 0]}}"


def said(body: str, joints: str) -> list[str]:
    text = TEXT.format(body=body, joints=joints)
    return [f"{m.line} {m.where}: {m.what}" for m in mistakes_of(text)]


@pytest.mark.parametrize(
    ("body", "joints"),
    [
        (BAR, ""),
        (BAR, "a: {ball: [ground.O, rod.start]}"),
        (BAR, "a: {ball: [ground.O, rod.on]}"),
        (BAR, "a: {ball: [ground.O, rod.start]}, b: {ball: [ground.Q, rod.end]}"),
        (BAR, "a: {hinge: [ground.O, rod.start], axis: [-2, 0, 0]}"),
        (BAR, "a: {universal: [ground.O, rod.start], axes: [[0, 1, 0], [1, 0, 0]]}"),
        (BAR, "a: {universal: [rod.end, box.center], axes: [[1, 0, 0], [0, 1, 0]]}"),
        (THIN, ""),
        (THIN, "a: {ball: [ground.O, rod.P]}"),
    ],
)
def test_turns_freely(body: str, joints: str) -> None:
    (mistake,) = said(body, joints)
    assert mistake.startswith("6 scene.bodies.rod: ")
    bar = "'rod' is a slender bar: nothing keeps it from turning about its own axis, and it has "
    bar += "no inertia about that; give it as a `rigid` with a tensor"
    thin = "nothing keeps 'rod' from turning about [0.707, 0.707, 0], and it has no inertia about "
    assert mistake.endswith(bar if body == BAR else thin + "that")


@pytest.mark.parametrize(
    "joints",
    [
        "a: {hinge: [ground.O, rod.start], axis: [0, 0, 1]}",
        "a: {ball: [ground.O, rod.side]}",  # where its own axis swings about the point
        "a: {slide: [ground.O, rod.start], along: [1, 0, 0]}",
        "a: {weld: [box.center, rod.start]}",
        "a: {universal: [ground.O, rod.start], axes: [[0, 1, 0], [0, 0, 1]]}",
        "a: {ball: [ground.O, rod.start]}, b: {hinge: [rod.end, box.center], axis: [0, 1, 0]}",
        "a: {freedoms: {x: {slide: [0, 0, 1]}, t: {hinge: [0, 1, 0]}}, of: [ground.O, rod.start]}",
    ],
)
def test_held_or_with_inertia(joints: str) -> None:
    assert said(BAR, joints) == []
