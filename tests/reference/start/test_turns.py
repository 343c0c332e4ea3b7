"""Turns that a start counts in the plane: those of a joint are those of its bodies."""

from pathlib import Path

import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference.start.assembly import start_poses
from textmech.reference.start.planar_closure import PlanarClosure

PENDULUM = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1.0, length: 0.4}}}
  joints: {q: {pin: [ground.O, b.start]}}
initial: {GIVEN}
allow: {b.angle: 1.0e-2}
"""
TURN_MORE = "b: {angle: 6.783185307179586 rad}, q: {angle: 0.5}"


def started(folder: Path, given: str) -> float:
    """[rad] of the bar."""
    pose = start_poses(typed(folder, PENDULUM.replace("GIVEN", given)))["b"]
    return float(pose[2])


def test_a_joint_and_its_body_on_different_turns_are_a_mistake(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        started(tmp_path, TURN_MORE)
    (mistake,) = caught.value.mistakes
    assert mistake.where == "initial.q.angle"
    assert "is 0.5 rad, but the bodies start 6.78319 rad apart" in mistake.what


@pytest.mark.parametrize("given", ["q: {angle: 400 deg}", "b: {angle: 400 deg}"])
def test_a_turn_more_is_kept(given: str, tmp_path: Path) -> None:
    assert started(tmp_path, given) == pytest.approx(6.981317007977318, abs=1e-14)


def test_both_on_one_turn_agree(tmp_path: Path) -> None:
    both = "b: {angle: 400 deg}, q: {angle: 400 deg}"
    assert started(tmp_path, both) == pytest.approx(6.981317007977318, abs=1e-14)


@pytest.mark.mutant("a joint's angle a whole turn from its bodies' accepted")
def test_without_the_question_the_joints_angle_is_lost(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PlanarClosure, "refuse_turns", lambda self, q: None)
    assert started(tmp_path, TURN_MORE) == pytest.approx(6.783185307179586)
