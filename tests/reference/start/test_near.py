"""`near`: of all ways to assemble the nearest to what it says, in the plane and in space."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.linkages import LINKAGE, SLIDER_CRANK
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.reference.start import positions
from textmech.reference.start.assembly import start_poses

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


@pytest.mark.mutant("in the plane all starts beside what is near are what is near")
def test_near_that_names_both_angles_is_a_guess_in_the_plane(tmp_path: Path) -> None:
    """Nearly stretched, where Newton's first step from (0.2201, 0.2091) leads to the farther way.

    Off by 0.2765 rad is the one, by 0.2811 rad the other; the first time only the latter was found.
    """
    text = ELBOW.replace("length: 0.5", "length: 0.732").replace("length: 0.4", "length: 0.573")
    text = text.replace("0.REACH", "1.3023515").replace(
        "ANGLE deg}", "0.2201}, lower: {angle: 0.2091}"
    )
    found = start_poses(typed(tmp_path, text))["upper"][2]
    cosine = (0.732**2 + 1.3023515**2 - 0.573**2) / (2 * 0.732 * 1.3023515)
    assert found == pytest.approx(-math.acos(cosine), abs=1e-9)


@pytest.mark.mutant("near a whole turn off what is given is as near as any")
def test_near_a_turn_off_what_is_given_is_a_mistake_in_the_plane(tmp_path: Path) -> None:
    """The upper bar has the angle of the hip, and no turn more."""
    text = ELBOW.replace("{lower: {end: [0.REACH, 0]}}", "{hip: {angle: 0.3}, lower: {angle: 0}}")
    for off, fits in ((-0.2, True), (2 * math.pi, False), (-6.2, False)):
        case = typed(tmp_path, text.replace("ANGLE deg", f"{0.3 + off} rad"))
        if fits:
            assert start_poses(case)["upper"][2] == pytest.approx(0.3, abs=1e-15)
            continue
        with pytest.raises(CaseError) as wrong:
            start_poses(case)
        (mistake,) = wrong.value.mistakes
        assert mistake.where == "near.upper.angle"
        assert "upper.angle is 17.19 deg; say one of these" in mistake.what


@pytest.mark.slow
@pytest.mark.mutant("near by a joint's angle is no guess in the plane")
@pytest.mark.parametrize(("angle", "side"), [(50.0, -1), (-50.0, 1), (310.0, 1), (-670.0, -1)])
def test_near_a_joint_s_angle_in_the_plane(angle: float, side: int, tmp_path: Path) -> None:
    """The knee of the nearer way, on the turn that is said."""
    text = ELBOW.replace("0.REACH", "0.6").replace("upper: {angle: ANGLE", "knee: {angle: ANGLE")
    text = text.replace("ANGLE", repr(angle))
    poses = start_poses(typed(tmp_path, text))
    assert math.copysign(1, poses["upper"][2]) == side
    knee = 180 - math.degrees(math.acos((0.25 + 0.16 - 0.36) / 0.4))  # by the law of cosines
    wanted = -side * knee + 360 * round((angle + side * knee) / 360)
    turned = math.degrees(poses["lower"][2] - poses["upper"][2])
    assert turned == pytest.approx(wanted, abs=1e-9)


CRANK = SLIDER_CRANK + "initial: {crank: {angle: 60 deg}}\nnear: {bore: {shift: SHIFT}}\n"


@pytest.mark.parametrize(("shift", "side"), [(0.6, 1), (-0.4, -1)])
def test_near_a_joint_s_shift_in_the_plane(shift: float, side: int, tmp_path: Path) -> None:
    found = start_poses(typed(tmp_path, CRANK.replace("SHIFT", repr(shift))))["piston"][0]
    rise = 0.2 * math.sin(math.pi / 3)
    assert found == pytest.approx(0.1 + side * math.sqrt(0.36 - rise * rise), abs=1e-12)


@pytest.mark.slow
def test_a_shift_in_the_middle_decides_nothing(tmp_path: Path) -> None:
    """The two places of the piston are as far from 0.1 m, above which the crank's end is."""
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        start_poses(typed(tmp_path, CRANK.replace("SHIFT", "0.1")))


def test_beside_a_dead_centre_only_what_is_open_is_named(tmp_path: Path) -> None:
    """Stretched by all but 3e-11 m: the lower bar's end is given, both angles are open."""
    text = ELBOW.replace("0.REACH", "0.89999999997").replace("ANGLE", "0.01")
    with pytest.raises(CaseError) as wrong:
        start_poses(typed(tmp_path, text))
    (mistake,) = wrong.value.mistakes
    open_ = "upper.y, upper.angle, lower.y, lower.angle"
    assert mistake.what.endswith(f"hardly determines {open_}; give one of these instead")


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
    monkeypatch.setattr(positions, "nearest_ways", lambda closure, ways: ways[:1])
    monkeypatch.setattr(positions, "FAR", math.inf)
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


ROD = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies: {rod: {bar: {mass: 1.0, length: 1.0}}}
  joints: {q: {hinge: [ground.O, rod.start], axis: [0, -1, 0]}}
initial: {rod: {x: 0.3}}
NEAR
allow: {rod.z: 1.0e-3}
"""


@pytest.mark.slow
def test_a_chain_that_a_body_holds_may_have_two_ways(tmp_path: Path) -> None:
    """A rod by its x alone is up or down, though nothing closes a loop."""
    with pytest.raises(CaseError, match=r"can be assembled in 2 ways: q\.angle"):
        start_poses(typed(tmp_path, ROD.replace("NEAR\n", "")))
    for z in (0.4, 0.1, -0.1, -0.4):
        pose = start_poses(typed(tmp_path, ROD.replace("NEAR", f"near: {{rod: {{z: {z}}}}}")))
        assert pose["rod"][2] == pytest.approx(math.copysign(0.4, z), abs=1e-12)


WRIST = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    a: {sphere: {mass: 1.0, radius: 0.1}}
    b: {sphere: {mass: 1.0, radius: 0.1}}
    c: {sphere: {mass: 1.0, radius: 0.1}}
  joints:
    q1: {hinge: [ground.O, a.center], axis: [0, 0, 1]}
    q2: {hinge: [a.center, b.center], axis: [0, 1, 0]}
    q3: {hinge: [b.center, c.center], axis: [0, 0, 1]}
initial:
  c: {attitude: [{axis: [0, 0, 1], angle: 0.5}, {axis: [0, 1, 0], angle: 0.7},
                 {axis: [0, 0, 1], angle: -0.4}]}
near: {q2: {angle: NEAR}}
allow: {q2.angle: 1.0e-3}
"""


@pytest.mark.parametrize("near", [0.6, -0.6])
def test_a_wrist_that_an_attitude_holds_has_two(near: float, tmp_path: Path) -> None:
    """Euler's angles (ψ, θ, φ) and (ψ + π, −θ, φ + π) make one attitude."""
    w, x, y, z = start_poses(typed(tmp_path, WRIST.replace("NEAR", str(near))))["a"][3:7]
    assert (x, y) == pytest.approx((0.0, 0.0), abs=1e-12)
    turned = math.remainder(2 * math.atan2(z, w) - 0.5, math.tau)
    assert abs(turned) == pytest.approx(0.0 if near > 0 else math.pi, abs=1e-12)


PAIR = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.8, 0, 0]}
  bodies:
    a: {block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}
    b: {block: {mass: 1.0, size: [0.5, 0.1, 0.1]}, points: {s: [-0.25, 0, 0], e: [0.25, 0, 0]}}
  joints:
    q1: {hinge: [ground.O, a.s], axis: [0, -1, 0]}
    q2: {hinge: [a.e, b.s], axis: [0, -1, 0]}
    end: {freedoms: {u: {slide: [0, 1, 0]}, g: {hinge: [1, 0, 0]}, h: {hinge: [0, 1, 0]},
                     k: {hinge: [1, 0, 0]}}, of: [ground.Q, b.e]}
initial: {}
near: {q1: {angle: FIRST}, q2: {angle: SECOND}}
allow: {a.x: 1.0e-3}
"""
BETA = math.acos(0.8)  # of two equal links that reach 0.8 of their length: q1 = ±β, q2 = ∓2β


def pair(folder: Path, first: float, second: float) -> float:
    text = PAIR.replace("FIRST", repr(first)).replace("SECOND", repr(second))
    w, _, y, _ = start_poses(typed(folder, text))["a"][3:7]
    return -2 * math.atan2(y, w)


@pytest.mark.slow
@pytest.mark.mutant("in space all starts of the search are what is near")
@pytest.mark.parametrize(
    ("first", "second"), [(0.0, 0.1), (0.0, -0.1), (-0.4, -0.3), (0.9, 0.2), (-1.5, 0.0)]
)
def test_near_that_names_every_turn_is_a_guess_all_the_same(
    first: float, second: float, tmp_path: Path
) -> None:
    """Of all that it says the worst counts; at (0, 0), straight, Newton finds no way at all."""
    off = {sign: max(abs(first - sign * BETA), abs(second + 2 * sign * BETA)) for sign in (1, -1)}
    found = pair(tmp_path, first, second)
    assert found == pytest.approx(min(off, key=off.__getitem__) * BETA, abs=1e-9)


@pytest.mark.slow
def test_in_the_middle_of_all_turns_it_decides_nothing(tmp_path: Path) -> None:
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        pair(tmp_path, 0.0, 0.0)


def test_far_from_the_origin_rounding_is_a_place(tmp_path: Path) -> None:
    """At 10 km a place has twelve digits of a metre, and the loop is closed to that."""
    far = PAIR.replace("[0, 0, 0], Q: [0.8, 0, 0]", "[10000, 0, 0], Q: [10000.8, 0, 0]")
    text = far.replace("FIRST", "0.6").replace("SECOND", "-1.2")
    assert start_poses(typed(tmp_path, text))["a"][0] == pytest.approx(10000.2, abs=1e-10)
