"""`near`: of all ways to assemble the nearest to what it says, in the plane and in space."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.linkages import LINKAGE
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference.start.assembly import start_poses
from textmech.reference.start.space import positions as spatial

ELBOW = """\
scene:
  points: {O: [0, 0]}
  bodies: {upper: {bar: {mass: 1.0, length: 0.5}}, lower: {bar: {mass: 1.0, length: 0.4}}}
  joints: {hip: {pin: [ground.O, upper.start]}, knee: {pin: [upper.end, lower.start]}}
initial: {lower: {end: [0.REACH, 0]}}
near: {upper: {angle: ANGLE deg}}
allow: {upper.angle: 1.0e-2}
"""


def elbow(folder: Path, reach: str, angle: float) -> float:
    """[deg] of the upper bar, whose ways are ±β by the law of cosines."""
    text = ELBOW.replace("REACH", reach).replace("ANGLE", repr(angle))
    return math.degrees(start_poses(typed(folder, text))["upper"][2])


@pytest.mark.slow
@pytest.mark.parametrize("reach", ["6", "899", "8999"])
def test_the_nearer_of_two_ways_is_taken_in_the_plane(reach: str, tmp_path: Path) -> None:
    """Stretched by all but a tenth of a millimetre the two ways are 3 deg apart."""
    r = float(f"0.{reach}")
    beta = math.degrees(math.acos((0.25 + r * r - 0.16) / r))
    for share in (-1.9, -1.1, -0.9, -0.1, 0.1, 0.9, 1.1, 1.9):
        found = elbow(tmp_path, reach, share * beta)
        assert found == pytest.approx(math.copysign(beta, share), abs=1e-5)


@pytest.mark.slow
def test_in_the_middle_it_decides_nothing(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        elbow(tmp_path, "6", 0.0)


def test_a_turn_more_is_the_same_way_on_another_turn(tmp_path: Path) -> None:
    once, twice = (elbow(tmp_path, "6", 40.0 + more) for more in (0.0, 720.0))
    assert twice == pytest.approx(once + 720.0, abs=1e-9)


@pytest.mark.slow
def test_what_is_far_from_all_ways_is_told(tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        elbow(tmp_path, "6", 160.0)
    (mistake,) = caught.value.mistakes
    assert mistake.where == "near.upper.angle"
    assert "cannot be assembled near this: upper.angle is 41.41 deg or 318.6 deg" in mistake.what


# Each with both angles of the rocker: with Newton's first root every one of these was missed.
WAYS = [(80, 57.1, 157.1), (200, 111.0, 141.0), (240, 163.9, 104.6)]


def rocker(folder: Path, crank: int, near: str) -> float:
    """[deg] of the bearing, which turns about an axis in the ground's xz plane."""
    text = LINKAGE.replace("30 deg", f"{crank} deg") + f"near: {{{near}}}\n"
    pose = start_poses(typed(folder, text + "allow: {crank.x: 1.0e-3}\n"))["rocker"]
    w, *axis = pose[3:7]
    return math.degrees(2 * math.atan2(np.dot(axis, [0.6, 0, 0.8]), w)) % 360


@pytest.mark.slow
@pytest.mark.parametrize(("crank", "one", "other"), WAYS)
def test_the_way_that_near_says_is_taken_in_space(
    crank: int, one: float, other: float, tmp_path: Path
) -> None:
    for angle, off in ((one, 0.0), (other, 0.0), (one, 6.0), (other, -6.0)):
        found = rocker(tmp_path, crank, f"bearing: {{angle: {angle + off} deg}}")
        assert found == pytest.approx(angle, abs=0.06)  # as it is typed


@pytest.mark.mutant("in space the first way that is found in place of the nearest")
@pytest.mark.slow
def test_the_first_way_that_is_found_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(spatial, "nearest_ways", lambda closure, ways: ways[:1])
    monkeypatch.setattr(spatial, "FAR", math.inf)
    assert rocker(tmp_path, 80, "bearing: {angle: 157.1 deg}") == pytest.approx(57.1, abs=0.06)


@pytest.mark.slow
def test_what_does_not_decide_is_refused_in_space(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match=r"can be assembled in 2 ways: bearing\.angle"):
        rocker(tmp_path, 80, "motor: {angle: 80 deg}")
    with pytest.raises(CaseError) as caught:
        rocker(tmp_path, 80, "bearing: {angle: -70 deg}")
    (mistake,) = caught.value.mistakes
    assert mistake.where == "near.bearing.angle"
    assert "cannot be assembled near this: bearing.angle is " in mistake.what
