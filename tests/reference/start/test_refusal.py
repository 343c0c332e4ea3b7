"""Starts that are refused: where, and in which words."""

from pathlib import Path

import pytest
from given import scenes
from given.linkages import BAR, FOUR_BAR, PAIR, SLIDER_CRANK

from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.start.assembly import assemble


def refused(tmp_path: Path, text: str) -> Mistake:
    with pytest.raises(CaseError) as error:
        assemble(scenes.typed(tmp_path, text))
    (mistake,) = error.value.mistakes
    assert mistake.file.endswith("typed.yaml")
    return mistake


def line(text: str, word: str) -> int:
    """Where `word` stands in the file, which has two lines before the scene."""
    return 3 + next(i for i, row in enumerate(text.splitlines()) if word in row)


@pytest.mark.slow
def test_two_ways_are_both_printed(tmp_path: Path) -> None:
    text = FOUR_BAR + "initial: {crank: {angle: 70 deg}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.line == line(text, "initial")
    assert "can be assembled in 2 ways" in mistake.what
    assert "rocker.angle = 95.93 deg or -134.9 deg" in mistake.what
    assert "near: {rocker: {angle: 95.93 deg}}" in mistake.what


@pytest.mark.slow
def test_what_cannot_be_assembled_names_the_joint_and_the_gap(tmp_path: Path) -> None:
    text = SLIDER_CRANK + "initial: {crank: {angle: 0}, piston: {x: 0.83}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.line == line(text, "initial")
    assert "cannot be assembled from what is given: " in mistake.what
    part, gap = mistake.what.split(": ")[1].split(" stays open by ")
    assert part in ("main", "big_end", "small_end")
    assert float(gap.removesuffix(" m")) == pytest.approx(0.03 / 3, rel=0.01)  # shared by three


def test_a_start_that_violates_a_constraint(tmp_path: Path) -> None:
    text = BAR + "initial: {bar: {angle: 0, x: 2.5, y: 0.01}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.line == line(text, "initial")
    assert mistake.what == "the initial state violates a constraint: hinge stays open by 0.01 m"


def test_a_violated_angle_is_told_in_degrees(tmp_path: Path) -> None:
    text = PAIR.replace("JOINT", "weld: [one.end, two.start], angle: 10 deg")
    text += "initial: {one: {angle: 0, x: 0.4, y: 0}, two: {angle: 15 deg}}\n"
    assert "knee stays open by 5 deg" in refused(tmp_path, text).what


@pytest.mark.slow
def test_a_placed_point_out_of_reach(tmp_path: Path) -> None:
    mistake = refused(tmp_path, BAR + "initial: {bar: {end: [3, 5]}}\n")
    assert "cannot be assembled" in mistake.what


@pytest.mark.parametrize(
    "joint", ["E: {pin: [ground.Q, rocker.start]}", "E: {weld: [crank.start, ground.O]}"]
)
def test_a_joint_too_many_is_named(tmp_path: Path, joint: str) -> None:
    text = FOUR_BAR.replace("allow", f"    {joint}\nallow")
    text += "initial: {crank: {angle: 0}}\nnear: {rocker: {angle: 96 deg}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.where == "scene.joints.E"
    assert mistake.line == line(text, joint)
    assert "the constraints are not independent" in mistake.what


@pytest.mark.slow
def test_a_flat_parallelogram_is_not_independent(tmp_path: Path) -> None:
    text = FOUR_BAR.replace("0.8", "0.9").replace("0.6", "0.3")
    text += "initial: {crank: {angle: 0}, rocker: {angle: 0}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.where == "scene.joints.D"
    assert "in this position" in mistake.what


def test_rates_that_violate_a_constraint(tmp_path: Path) -> None:
    text = BAR + "initial: {bar: {angle: 0, omega: 1, vy: 2.4}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.line == line(text, "initial")
    assert "the rates violate hinge" in mistake.what


def test_open_positions_are_named(tmp_path: Path) -> None:
    text = PAIR.replace("JOINT", "pin: [one.end, two.start]") + "initial: {one: {angle: 0}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.what.startswith("1 more needed: two.y, two.angle are not determined")


def test_open_rates_are_named(tmp_path: Path) -> None:
    text = PAIR.replace("JOINT", "pin: [one.end, two.start]")
    text += "initial: {one: {angle: 0, omega: 2}, two: {angle: 0}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.what.startswith("1 more needed: two.vy, two.omega are not determined")


def test_a_free_body_without_places(tmp_path: Path) -> None:
    text = """\
scene:
  bodies: {free: {rigid: {mass: 1, inertia: 0.1}}}
initial: {free: {vx: 1}}
allow: {free.x: 1.0e-2}
"""
    assert refused(tmp_path, text).what.startswith("3 more needed: free.x, free.y, free.angle")


def test_a_rolling_wheel_needs_its_angle(tmp_path: Path) -> None:
    """But for a disk, which looks the same however it is turned."""
    text = """\
scene:
  bodies: {wheel: {rigid: {mass: 1, inertia: 0.05, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.5, ideal: rolling}}
initial: {wheel: {x: 1}}
allow: {wheel.x: 1.0e-2}
"""
    assert "wheel.angle is not determined" in refused(tmp_path, text).what


@pytest.mark.slow
@pytest.mark.parametrize("x", ["0.8", "0.79999999999"])
def test_a_piston_given_at_its_dead_centre_leaves_the_crank_open(tmp_path: Path, x: str) -> None:
    text = SLIDER_CRANK + f"initial: {{piston: {{x: {x}}}}}\nnear: {{crank: {{angle: 0}}}}\n"
    mistake = refused(tmp_path, text)
    assert "stands at a dead centre" in mistake.what  # it determines it, but no rate
    assert "crank.angle" in mistake.what
