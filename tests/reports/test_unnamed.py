"""What goes through the floor on which its neighbours stand is told in one line, and goes on."""

import json
import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.command import textmech

from textmech.cases.scene import unnamed
from textmech.cases.scene.unnamed import through
from textmech.reference.solve import solve
from textmech.reports import solve as solved

HEAD = "title: What no contact names\n"
DOMINO = """\
scene:
  bodies: {box: {block: {mass: 1, width: 0.1, height: 0.4}}}
  contacts: {right: {between: [box.lower_right, ground.floor], friction: 1}MORE}
initial: {box: {x: 0, angle: 0, on: lower_right, omega: -4}}
allow: {box.angle: 1.0e-3}
"""
STACKED = """\
scene:
  bodies:
    base: {block: {mass: 5, width: 1, height: 0.2}}
    box: {block: {mass: 1, width: 0.1, height: 0.4}}
  contacts:
    bl: {between: [base.lower_left, ground.floor], friction: 1}
    br: {between: [base.lower_right, ground.floor], friction: 1}
    right: {between: [box.lower_right, base.top], friction: 1}
initial: {base: {x: 0, angle: 0, on: [lower_left, lower_right]}, box: {x: 0, y: 0.4, angle: 0}}
allow: {box.angle: 1.0e-3}
"""
SPACE = """\
scene:
  space: 3
  bodies: {box: {block: {mass: 1, size: [0.2, 0.2, 0.4]}, points: {tip: [0, 0, -0.2]}}}
  contacts: {foot: {between: [box.tip, ground.floor], friction: 9, ideal: pivot}}
initial: {box: {x: 0, y: 0, z: 0.2, attitude: {axis: [0, 0, 1], angle: 0}, omega: [0.5, 0, 0]}}
allow: {box.attitude: 1.0e-3}
"""
LENGTH = {DOMINO: 0.5, STACKED: 0.1, SPACE: 0.1}


def told(folder: Path, text: str, more: str = "") -> list[str]:
    case = scenes.typed(folder, text.replace("MORE", more), tail=scenes.tail(LENGTH[text], 26))
    return [*through(case.scene, solve(case).trajectory)]


@pytest.mark.parametrize(
    ("text", "begins"),
    [
        (DOMINO, "box.upper_left goes 409 mm deep into the floor, which it enters by t = 0.36 s"),
        (STACKED, "box.lower_left goes 4.45 mm deep into the top of base"),
        (SPACE, "box.corner"),
    ],
)
def test_the_deepest_point_is_told(text: str, begins: str, tmp_path: Path) -> None:
    (warning,) = told(tmp_path, text)
    assert warning.startswith(begins)
    assert warning.endswith("no contact names it, so nothing holds it there")


def test_how_deep_is_what_the_angle_says(tmp_path: Path) -> None:
    """A domino about its right corner at φ < 0: its left upper one is h cos φ − w sin φ high."""
    case = scenes.typed(tmp_path, DOMINO.replace("MORE", ""), tail=scenes.tail(0.5, 26))
    motion = solve(case).trajectory
    angle = motion.states["box"][:, 2]
    above = 0.4 * np.cos(angle) - 0.1 * np.sin(angle)
    (warning,) = through(case.scene, motion)
    assert f"goes {-1e3 * min(above):.3g} mm deep" in warning


def test_nothing_is_told_of_what_is_named(tmp_path: Path) -> None:
    names = ("lower_left", "upper_right", "upper_left")
    more = "".join(f", {n}: {{between: [box.{n}, ground.floor], friction: 1}}" for n in names)
    case = DOMINO.replace("allow:", "events: {falls: {upper_right.gap: falls to zero}}\nallow:")
    LENGTH[case] = 0.5
    assert told(tmp_path, case, more) == []


@pytest.mark.slow
def test_no_shipped_case_is_warned_of() -> None:
    for name, case in scenes.SHIPPED.items():
        if case.scene.contacts or case.scene.pairs:
            assert [*through(case.scene, scenes.solved(name).trajectory)] == [], name


@pytest.fixture
def domino(tmp_path: Path) -> Path:
    file = tmp_path / "domino.yaml"
    tail = scenes.tail(0.5, 26).replace("5e-05", "1e-3")
    file.write_text(HEAD + DOMINO.replace("MORE", "") + tail, encoding="utf-8")
    return file


def test_check_and_python_warn_and_refuse_nothing(domino: Path) -> None:
    done = textmech("check", domino)
    assert done.returncode == 0
    warning, sound = done.stdout.splitlines()
    assert warning.startswith(f"{domino}: warning: box.upper_left goes 409 mm deep")
    assert sound == f"{domino}: 1 case, no mistakes"
    (file,) = json.loads(textmech("check", domino, "--json").stdout)["files"]
    (known,) = file["warnings"]
    assert known["case"] == "domino"
    assert solved(str(domino)).warnings == (known["what"],)


@pytest.mark.slow
def test_run_warns_and_refuses_nothing(domino: Path) -> None:
    done = textmech("run", domino, "--engine", "pymunk.shipped")
    assert done.returncode == 0
    assert "domino: warning: box.upper_left goes 409 mm deep" in done.stdout


@pytest.mark.mutant("a corner that goes through the floor is told of none")
def test_a_warning_that_is_left_out_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(unnamed, "DEEP", math.inf)
    assert told(tmp_path, DOMINO) == []
