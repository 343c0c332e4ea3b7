"""Starts in the plane: what a case file describes, by bodies or joints, and `near` which way."""

import math
from typing import Any

import numpy as np
import pytest
from given.scenes import parsed, scene

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.start.assembly import assemble, start_poses
from textmech.reference.start.planar_closure import PlanarClosure
from textmech.reference.system import Array


def start(case: Case) -> tuple[dict[str, float], dict[str, float]]:
    """Coordinates and rates at the start, by the coordinate's name."""
    q, v = assemble(case)
    mechanism = Multibody(case.scene, (q, v))
    size = max(1.0, float(np.max(np.abs(q))))
    assert np.max(np.abs(mechanism.f(0.0, q)), initial=0.0) < 1e-12 * size
    assert np.max(np.abs(mechanism.f_a(0.0, q) @ v - mechanism.g(0.0, q)), initial=0.0) < 1e-12

    def named(values: Array) -> dict[str, float]:
        return dict(zip(mechanism.coordinates, values.tolist(), strict=True))

    return named(q), named(v)


def four_bar(near: str = "rocker: {angle: 96 deg}", omega: float = 0.0, **parameters: Any) -> Case:
    crank = f"initial: {{crank: {{omega: {omega}}}}}\n" if omega else ""
    return scene("four_bar", f"{crank}near: {{{near}}}", **parameters)


def test_the_loop_closes_and_rates_follow_from_the_crank() -> None:
    """Against the closed form of the linkage: the cosine rule, and its derivative."""
    q, v = start(four_bar(omega=3.0))
    B = 0.3 * np.array([math.cos(q["crank.angle"]), math.sin(q["crank.angle"])])
    s = np.array([0.9, 0.0]) - B
    length = math.hypot(*s)
    turn = math.acos((0.8**2 + length**2 - 0.6**2) / (2 * 0.8 * length))
    assert q["coupler.angle"] == pytest.approx(math.atan2(s[1], s[0]) + turn, abs=1e-13)
    turned = q["rocker.angle"] - q["coupler.angle"]
    rate = 0.3 * 3 * math.sin(q["crank.angle"] - q["coupler.angle"]) / (-0.6 * math.sin(-turned))
    assert v["rocker.angle"] == pytest.approx(rate, rel=1e-12)


@pytest.mark.parametrize(
    ("near", "angle"),
    [
        ("rocker: {end: [0.5, -0.4]}", -134.9),  # by a point
        ("coupler: {y: 0.5}", 95.93),
        ("rocker: {angle: 460 deg}", 455.93),  # the turn of the guess is kept
    ],
)
def test_near_says_which_way(near: str, angle: float) -> None:
    q, v = start(four_bar(near))
    assert math.degrees(q["rocker.angle"]) == pytest.approx(angle, abs=0.05)
    assert not any(v.values())  # at rest, since that satisfies the constraints


@pytest.mark.parametrize(
    "parameters",
    [
        {"a": 0.3e-3, "b": 0.8e-3, "c": 0.6e-3, "q": 0.9e-3},
        {"a": 30.0, "b": 80.0, "c": 60.0, "q": 90.0},
        {"o": 10000.0, "q": 10000.9},  # where rounding is 1e-12 m: neither open nor a dead centre
    ],
    ids=["a watch", "a crane", "far away"],
)
def test_neither_size_nor_place_matters(parameters: dict[str, Any]) -> None:
    q = assemble(four_bar(**parameters))[0]
    assert math.degrees(q[-1]) == pytest.approx(95.93, abs=0.01)


def bar(initial: str, changes: str = "") -> Case:
    """A bar of 5 m on a pin."""
    text = f"initial: {{bar: {{{initial}}}}}\n{changes}"
    return scene("pendulum", text, l=5)


HOOK = "scene: {points: {O: {at: [x, 0], velocity: [1.0, 0.5]}}}"
PLACED = {
    "a point": ("angle: null, end: [3, 4]", "", "bar.angle", math.atan2(4, 3), 0.0),
    "on what moves": ("angle: 90 deg, omega: 2", HOOK, "bar.x", 0.0, 1.0 - 2 * 2.5),
    "twice, and alike": ("angle: 90 deg, x: 0, y: 2.5, end: [0, 5]", "", "bar.y", 2.5, 0.0),
    "on its turn": ("angle: -1000 deg", "", "bar.angle", math.radians(-1000), 0.0),
    "half a turn": ("angle: 180 deg", "", "bar.angle", math.pi, 0.0),
    "half a turn back": ("angle: -180 deg", "", "bar.angle", -math.pi, 0.0),
}


@pytest.mark.parametrize("how", PLACED)
def test_a_bar_is_placed(how: str) -> None:
    initial, changes, name, place, rate = PLACED[how]
    q, v = start(bar(initial, changes))
    assert (q[name], v[name]) == pytest.approx((place, rate), abs=1e-13)


def two_bars(changes: str, **lengths: float) -> Case:
    return scene("two_bars", changes, **lengths)


@pytest.mark.parametrize(
    ("joint", "initial", "two"),
    [
        ("weld: [upper.end, lower.start], angle: 200 deg", "upper: {angle: 370 deg}", 570),
        ("weld: [upper.end, lower.start], angle: 200 deg", "lower: {angle: 10 deg}", 10),
        # Given apart by a whole turn from what the weld holds: the same place.
        ("weld: [upper.end, lower.start]", "upper: {angle: 370 deg}, lower: {angle: 10 deg}", 10),
        ("slide: [upper.end, lower.start], along: [1, 2], angle: 30 deg",
         "upper: {angle: 20 deg}, lower: {x: 1.5}", 50),
    ],
)  # fmt: skip
def test_held_angles(joint: str, initial: str, two: int) -> None:
    text = f"scene: {{joints: {{knee: {{pin: null, {joint}}}}}}}\ninitial: {{{initial}}}"
    q, _ = start(two_bars(text, l1=0.8, l2=0.8))
    assert math.degrees(q["lower.angle"]) == pytest.approx(two, abs=1e-12)


def test_a_slide_between_moving_bodies_keeps_its_line() -> None:
    text = """\
scene: {joints: {knee: {pin: null, slide: [upper.end, lower.center], along: [30, 40]}}}
initial: {upper: {angle: 0, omega: 2}, lower: {x: 1.1, vx: 1}}
"""
    q, v = start(two_bars(text, l1=0.8, l2=0.8))
    assert q["lower.y"] == pytest.approx(0.3 * 4 / 3, abs=1e-14)
    # u·Δ = 0.5 along (0.6, 0.8); ṙ = ω × r + s u with r = (1.1, 0.4): s = (1 + 0.8)/0.6
    assert v["lower.y"] == pytest.approx(2.2 + 0.8 * 1.8 / 0.6, abs=1e-12)


def slider_crank(initial: str, near: str) -> Case:
    return scene("slider_crank", f"initial: {{{initial}}}\nnear: {{{near}}}")


def test_a_dead_centre_is_a_start_like_any_other() -> None:
    _, v = start(slider_crank("crank: {angle: 0, omega: 3}", "piston: {x: 0.8}"))
    assert (v["piston.x"], v["rod.angle"]) == pytest.approx((0.0, -1.0), abs=1e-12)


@pytest.mark.slow
def test_half_a_turn_is_one_way_and_not_two() -> None:
    """180° and −180° are the same place: Newton's method ends on either side by rounding."""
    q, _ = start(slider_crank("crank: {angle: 180 deg}", "piston: {x: -0.8}"))
    assert q["rod.angle"] == pytest.approx(math.pi, abs=1e-12)


@pytest.mark.mutant("what stands on another body has rates of its own")
def test_what_stands_on_a_body_moves_with_it() -> None:
    """The plank's −1 m/s follow from the left bar alone; the rod's foot has them too."""
    text = """\
scene:
  points: {A: [0, 0], B: [1, 0]}
  bodies:
    rod: {bar: {mass: 1, length: 0.4}}
    plank: {block: {mass: 2, width: 1.0, height: 0.1}, points: {l: [-0.5, 0], r: [0.5, 0]}}
    left: {bar: {mass: 1, length: 0.5}}
    right: {bar: {mass: 1, length: 0.5}}
  joints:
    a: {pin: [ground.A, left.start]}
    b: {pin: [ground.B, right.start]}
    c: {pin: [left.end, plank.l]}
    d: {pin: [right.end, plank.r]}
  contacts: {foot: {between: [rod.start, plank.top], friction: 0.9}}
initial:
  left: {angle: 90 deg, omega: 2}
  right: {angle: 90 deg}
  rod: {on: start, x: 0.6, angle: 80 deg, omega: 0.3}
allow: {rod.angle: 1.0e-3}
"""
    _, v = start(parsed(text))
    assert v["plank.x"] == pytest.approx(-1.0, abs=1e-12)
    lever = 0.3 * 0.2
    foot = (
        v["rod.x"] + lever * math.sin(math.radians(80)),
        v["rod.y"] - lever * math.cos(math.radians(80)),
    )
    assert foot == pytest.approx((-1.0, 0.0), abs=1e-12)


# By joints: the bodies of `two_bars`, a cart on a rail, and the crank of `four_bar`.

SAME = [
    (
        "hip: {angle: 380 deg, omega: 1.5}, knee: {angle: -50 deg, omega: 2.0}",
        "upper: {angle: 380 deg, omega: 1.5}, lower: {angle: 330 deg, omega: 3.5}",
    ),
    (
        "hip: {angle: 20 deg}, knee: {angle: 400 deg}",
        "upper: {angle: 20 deg}, lower: {angle: 420 deg}",
    ),
]


@pytest.mark.parametrize(("by_joints", "by_bodies"), SAME)
def test_by_joints_as_by_bodies(by_joints: str, by_bodies: str) -> None:
    one, other = (assemble(two_bars(f"initial: {{{at}}}")) for at in (by_joints, by_bodies))
    assert one[0] == pytest.approx(other[0], abs=1e-12)
    assert one[1] == pytest.approx(other[1], abs=1e-12)


def test_a_joint_that_names_its_bodies_the_other_way_round() -> None:
    text = "scene: {joints: {knee: {pin: [lower.start, upper.end]}}}\ninitial: "
    q, v = start(
        two_bars(text + "{hip: {angle: 20 deg, omega: 1.5}, knee: {angle: 400 deg, omega: 2}}")
    )
    assert math.degrees(q["lower.angle"]) == pytest.approx(-380, abs=1e-12)
    assert v["lower.angle"] == pytest.approx(-0.5, abs=1e-12)


def test_a_slide_and_a_slot() -> None:
    """The cart stands 0.2 m up the line from O, the rod's start 0.1 m beyond it across the cart."""
    text = """\
scene:
  points: {O: [0.3, 0]}
  bodies:
    cart: {block: {mass: 2.0, width: 0.2, height: 0.1}}
    rod: {bar: {mass: 0.5, length: 0.6}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [0.6, 0.8], angle: 20 deg}
    guide: {slot: [cart.center, rod.start], along: [0, 1]}
initial: {rail: {shift: 0.2, speed: 0.5}, guide: {shift: 0.1, speed: -0.3, angle: 1, omega: 2}}
allow: {rail.shift: 1.0e-2}
"""
    q, v = assemble(parsed(text))
    turn = np.radians(20.0)
    cart, up = np.array([0.3 + 0.12, 0.16]), np.array([-np.sin(turn), np.cos(turn)])
    lean = np.array([np.cos(turn + 1), np.sin(turn + 1)])
    aside = np.array([-lean[1], lean[0]])
    cart_dot = 0.5 * np.array([0.6, 0.8])
    assert q == pytest.approx([*cart, turn, *(cart + 0.1 * up + 0.3 * lean), turn + 1], abs=1e-12)
    rod_dot = cart_dot - 0.3 * up + 2.0 * 0.3 * aside
    assert v == pytest.approx([*cart_dot, 0.0, *rod_dot, 2.0], abs=1e-12)


@pytest.mark.mutant("an angle of a joint a turn from that of its body")
def test_an_angle_that_is_given_twice_is_given_on_one_turn() -> None:
    text = "initial: {{upper: {{angle: {} deg}}, hip: {{angle: 20 deg}}, knee: {{angle: 0}}}}"
    assert assemble(two_bars(text.format(20)))[0][2] == pytest.approx(np.radians(20))
    with pytest.raises(CaseError, match=r"hip.angle: is 0.349066 rad, but .* another turn"):
        assemble(two_bars(text.format(380)))


WHEEL = "scene: {joints: {knee: {pin: [upper.end, lower.center]}}}\ninitial: "


@pytest.mark.parametrize("rate", ["knee: {angle: 30 deg}", "knee: {angle: 30 deg, omega: -1}"])
def test_a_rate_that_is_zero_both_ways_or_said_is_known(rate: str) -> None:
    start = f"{{upper: {{angle: 20 deg, omega: 0}}, lower: {{angle: 50 deg}}, {rate}}}"
    assert assemble(two_bars(WHEEL + start))[1][5] == (-1.0 if "omega" in rate else 0.0)


def test_of_two_rates_that_may_be_zero_one_is_asked_for() -> None:
    """The wheel that hangs on the bar may keep its own rate, or turn with the bar."""
    hip = "{hip: {angle: 20 deg, omega: 1.5}, "
    with pytest.raises(CaseError, match=r"knee.angle: gives the angle and no omega.*say omega"):
        assemble(two_bars(WHEEL + hip + "knee: {angle: 30 deg}}"))
    assert assemble(two_bars(WHEEL + hip + "lower: {angle: 1}}"))[1][5] == 0.0  # its own


def pendulum(initial: str) -> Case:
    return scene("pendulum", f"initial: {{{initial}}}")


@pytest.mark.parametrize(
    "given",
    ["bar: null, hinge: {angle: 400 deg}", "bar: {angle: 400 deg}, hinge: {angle: 400 deg}"],
)
def test_a_turn_more_is_kept(given: str) -> None:
    pose = start_poses(pendulum(given))["bar"]
    assert pose[2] == pytest.approx(6.981317007977318, abs=1e-14)


@pytest.mark.mutant("a joint's angle a whole turn from its bodies' accepted")
def test_a_joint_and_its_body_on_different_turns_are_a_mistake(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    case = pendulum("bar: {angle: 6.783185307179586 rad}, hinge: {angle: 0.5}")
    with pytest.raises(CaseError) as caught:
        start_poses(case)
    (mistake,) = caught.value.mistakes
    assert mistake.where == "initial.hinge.angle"
    assert "is 0.5 rad, but the bodies start 6.78319 rad apart" in mistake.what
    monkeypatch.setattr(PlanarClosure, "refuse_turns", lambda self, q: None)
    assert start_poses(case)["bar"][2] == pytest.approx(6.783185307179586)


# `near`: the nearest of all ways.


def elbow(reach: float, near: str, **lengths: float) -> Case:
    """Two bars to a point on the x axis: the ways of the upper one are ±β by the law of cosines."""
    return two_bars(f"initial: {{lower: {{end: [{reach!r}, 0]}}}}\nnear: {{{near}}}", **lengths)


def upper(reach: float, angle: float) -> float:
    """Returns the angle of the upper bar of `elbow` near that angle [deg]."""
    return math.degrees(start_poses(elbow(reach, f"upper: {{angle: {angle!r} deg}}"))["upper"][2])


@pytest.mark.slow
@pytest.mark.parametrize("reach", [0.6, 0.8999])
def test_the_nearer_of_two_ways_is_taken_in_the_plane(reach: float) -> None:
    """Stretched by all but a tenth of a millimetre the two ways are 3 deg apart."""
    beta = math.degrees(math.acos((0.25 + reach * reach - 0.16) / reach))
    for share in (-1.9, -0.9, -0.1, 0.1, 0.9, 1.9):
        assert upper(reach, share * beta) == pytest.approx(math.copysign(beta, share), abs=1e-5)


@pytest.mark.slow
def test_in_the_middle_or_far_from_both_ways_near_decides_nothing() -> None:
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        upper(0.6, 0.0)
    with pytest.raises(CaseError) as caught:
        upper(0.6, 160.0)
    (mistake,) = caught.value.mistakes
    assert mistake.where == "near.upper.angle"
    assert "cannot be assembled near this: upper.angle is 41.41 deg or 318.6 deg" in mistake.what
    assert upper(0.6, 760.0) == pytest.approx(upper(0.6, 40.0) + 720.0, abs=1e-9)


@pytest.mark.mutant("in the plane all starts beside what is near are what is near")
def test_near_that_names_both_angles_is_a_guess_in_the_plane() -> None:
    """Nearly stretched, where Newton's first step from (0.2201, 0.2091) leads to the farther way.

    Off by 0.2765 rad is the one, by 0.2811 rad the other; the first time only the latter was found.
    """
    case = elbow(1.3023515, "upper: {angle: 0.2201}, lower: {angle: 0.2091}", l1=0.732, l2=0.573)
    cosine = (0.732**2 + 1.3023515**2 - 0.573**2) / (2 * 0.732 * 1.3023515)
    assert start_poses(case)["upper"][2] == pytest.approx(-math.acos(cosine), abs=1e-9)


@pytest.mark.mutant("near a whole turn off what is given is as near as any")
def test_near_a_turn_off_what_is_given_is_a_mistake_in_the_plane() -> None:
    """The upper bar has the angle of the hip, and no turn more."""
    text = (
        "initial: {{hip: {{angle: 0.3}}, lower: {{angle: 0}}}}\nnear: {{upper: {{angle: {} rad}}}}"
    )
    assert start_poses(two_bars(text.format(0.1)))["upper"][2] == pytest.approx(0.3, abs=1e-15)
    for off in (2 * math.pi, -6.2):
        with pytest.raises(CaseError) as wrong:
            start_poses(two_bars(text.format(0.3 + off)))
        (mistake,) = wrong.value.mistakes
        assert mistake.where == "near.upper.angle"
        assert "upper.angle is 17.19 deg; say one of these" in mistake.what


@pytest.mark.slow
@pytest.mark.mutant("near by a joint's angle is no guess in the plane")
@pytest.mark.parametrize(("angle", "side"), [(50.0, -1), (310.0, 1), (-670.0, -1)])
def test_near_a_joint_s_angle_in_the_plane(angle: float, side: int) -> None:
    """The knee of the nearer way, on the turn that is said."""
    poses = start_poses(elbow(0.6, f"knee: {{angle: {angle!r} deg}}"))
    assert math.copysign(1, poses["upper"][2]) == side
    knee = 180 - math.degrees(math.acos((0.25 + 0.16 - 0.36) / 0.4))  # by the law of cosines
    wanted = -side * knee + 360 * round((angle + side * knee) / 360)
    turned = math.degrees(poses["lower"][2] - poses["upper"][2])
    assert turned == pytest.approx(wanted, abs=1e-9)


@pytest.mark.slow
def test_near_a_joint_s_shift_in_the_plane() -> None:
    """The two places of the piston are as far from 0.1 m, above which the crank's end is."""
    crank = "crank: {angle: 60 deg}"
    rise = 0.2 * math.sin(math.pi / 3)
    for shift, side in ((0.6, 1), (-0.4, -1)):
        x = start_poses(slider_crank(crank, f"bore: {{shift: {shift}}}"))["piston"][0]
        assert x == pytest.approx(0.1 + side * math.sqrt(0.36 - rise * rise), abs=1e-12)
    with pytest.raises(CaseError, match="can be assembled in 2 ways"):
        start_poses(slider_crank(crank, "bore: {shift: 0.1}"))


def test_beside_a_dead_centre_only_what_is_open_is_named() -> None:
    """Stretched by all but 3e-11 m: the lower bar's end is given, both angles are open."""
    with pytest.raises(CaseError) as wrong:
        upper(0.89999999997, 0.01)
    (mistake,) = wrong.value.mistakes
    open_ = "upper.y, upper.angle, lower.y, lower.angle"
    assert mistake.what.endswith(f"hardly determines {open_}; give one of these instead")
