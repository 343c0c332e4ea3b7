"""Starts that a case file describes: what follows from it, and in which words it is refused."""

import math
from pathlib import Path

import numpy as np
import pytest
from given import scenes

from textmech.cases.mistake import CaseError, Mistake
from textmech.reference.generated.mode import Multibody
from textmech.reference.start.assembly import assemble
from textmech.reference.system import Array

FOUR_BAR = """\
scene:
  points: {O: [0, 0], Q: [0.9, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.3}}
    coupler: {bar: {mass: 1, length: 0.8}}
    rocker: {bar: {mass: 1, length: 0.6}}
  joints:
    A: {pin: [ground.O, crank.start]}
    B: {pin: [crank.end, coupler.start]}
    C: {pin: [coupler.end, rocker.end]}
    D: {pin: [ground.Q, rocker.start]}
allow: {crank.angle: 1.0e-2}
"""
SLIDER_CRANK = """\
scene:
  points: {O: [0, 0]}
  bodies:
    crank: {bar: {mass: 1, length: 0.2}}
    rod: {bar: {mass: 1, length: 0.6}}
    piston: {block: {mass: 1.1, width: 0.1, height: 0.06}}
  joints:
    main: {pin: [ground.O, crank.start]}
    big_end: {pin: [crank.end, rod.start]}
    small_end: {pin: [rod.end, piston.center]}
    bore: {slide: [ground.O, piston.center], along: [3, 0]}
allow: {crank.angle: 1.0e-2}
"""
BAR = """\
scene:
  points: {O: [0, 0], hook: {at: [0, 0], velocity: [1.0, 0.5]}}
  bodies: {bar: {bar: {mass: 1, length: 5}}}
  joints: {hinge: {pin: [ground.O, bar.start]}}
allow: {bar.angle: 1.0e-2}
"""
PAIR = """\
scene:
  points: {O: [0, 0]}
  bodies: {one: {bar: {mass: 1, length: 0.8}}, two: {bar: {mass: 1, length: 0.8}}}
  joints: {top: {pin: [ground.O, one.start]}, knee: {JOINT}}
allow: {one.angle: 1.0e-2}
"""


def start(tmp_path: Path, text: str) -> tuple[dict[str, float], dict[str, float]]:
    """Coordinates and rates at the start, by the coordinate's name."""
    case = scenes.typed(tmp_path, text)
    q, v = assemble(case)
    mechanism = Multibody(case.scene, (q, v))
    size = max(1.0, float(np.max(np.abs(q))))
    assert np.max(np.abs(mechanism.f(0.0, q)), initial=0.0) < 1e-12 * size
    assert np.max(np.abs(mechanism.f_a(0.0, q) @ v - mechanism.g(0.0, q)), initial=0.0) < 1e-12

    def named(values: Array) -> dict[str, float]:
        return dict(zip(mechanism.coordinates, values.tolist(), strict=True))

    return named(q), named(v)


def refused(tmp_path: Path, text: str) -> Mistake:
    with pytest.raises(CaseError) as error:
        start(tmp_path, text)
    (mistake,) = error.value.mistakes
    assert mistake.file.endswith("typed.yaml")
    return mistake


def line(text: str, word: str) -> int:
    """Where `word` stands in the file, which has two lines before the scene."""
    return 3 + next(i for i, row in enumerate(text.splitlines()) if word in row)


# What follows.


def test_the_loop_closes_and_rates_follow_from_the_crank(tmp_path: Path) -> None:
    """Against the closed form of the linkage: the cosine rule, and its derivative."""
    text = FOUR_BAR + (
        "initial: {crank: {angle: 70 deg, omega: 3}}\nnear: {rocker: {angle: 96 deg}}\n"
    )
    q, v = start(tmp_path, text)
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
        ("rocker: {angle: 96 deg}", 95.93),
        ("rocker: {angle: -120 deg}", -134.9),
        ("rocker: {end: [0.5, -0.4]}", -134.9),  # by a point
        ("coupler: {angle: -70 deg}", -134.9),
        ("coupler: {y: 0.5}", 95.93),
        ("rocker: {angle: 460 deg}", 455.93),  # the turn of the guess is kept
    ],
)
def test_near_says_which_way(tmp_path: Path, near: str, angle: float) -> None:
    text = FOUR_BAR + f"initial: {{crank: {{angle: 70 deg}}}}\nnear: {{{near}}}\n"
    q, v = start(tmp_path, text)
    assert math.degrees(q["rocker.angle"]) == pytest.approx(angle, abs=0.05)
    assert not any(v.values())  # at rest, since that satisfies the constraints


@pytest.mark.parametrize("scale", ["e-3", "e+2"], ids=["a watch", "a crane"])
def test_the_size_does_not_matter(tmp_path: Path, scale: str) -> None:
    text = FOUR_BAR
    for length in ("0.3", "0.8", "0.6", "0.9"):
        text = text.replace(length, length + scale)
    text += "initial: {crank: {angle: 70 deg, omega: 3}}\nnear: {rocker: {angle: 1.2}}\n"
    q, _ = start(tmp_path, text)
    assert math.degrees(q["rocker.angle"]) == pytest.approx(95.93, abs=0.01)


def test_the_place_does_not_matter(tmp_path: Path) -> None:
    """10 km from the origin, where rounding is 1e-12 m: neither open nor at a dead centre."""
    text = FOUR_BAR.replace("[0, 0]", "[10000, 0]").replace("[0.9, 0]", "[10000.9, 0]")
    text += "initial: {crank: {angle: 70 deg}}\nnear: {rocker: {angle: 96 deg}}\n"
    case = scenes.typed(tmp_path, text)
    q = assemble(case)[0]
    assert math.degrees(q[-1]) == pytest.approx(95.93, abs=0.01)


def test_points_are_placed(tmp_path: Path) -> None:
    q, v = start(tmp_path, BAR + "initial: {bar: {end: [3, 4]}}\n")
    assert q["bar.angle"] == pytest.approx(math.atan2(4, 3), abs=1e-14)
    assert not any(v.values())


def test_driven_points_give_rates(tmp_path: Path) -> None:
    text = BAR.replace("ground.O", "ground.hook") + "initial: {bar: {angle: 90 deg, omega: 2}}\n"
    _, v = start(tmp_path, text)
    assert v["bar.x"] == pytest.approx(1.0 - 2 * 2.5, abs=1e-13)
    assert v["bar.y"] == pytest.approx(0.5, abs=1e-13)


def test_redundant_values_that_agree_are_accepted(tmp_path: Path) -> None:
    q, _ = start(tmp_path, BAR + "initial: {bar: {angle: 90 deg, x: 0, y: 2.5, end: [0, 5]}}\n")
    assert q["bar.y"] == 2.5


@pytest.mark.parametrize("angle", [400, -1000, 180, -180])
def test_given_angles_stay_as_they_are(tmp_path: Path, angle: int) -> None:
    q, _ = start(tmp_path, BAR + f"initial: {{bar: {{angle: {angle} deg}}}}\n")
    assert q["bar.angle"] == math.radians(angle)


def test_half_a_turn_is_one_way_and_not_two(tmp_path: Path) -> None:
    """180° and −180° are the same place: Newton's method ends on either side by rounding."""
    text = SLIDER_CRANK.replace("allow", "initial: {crank: {angle: 180 deg}}\nallow")
    q, _ = start(tmp_path, text + "near: {piston: {x: -0.8}}\n")
    assert q["rod.angle"] == pytest.approx(math.pi, abs=1e-12)


@pytest.mark.parametrize(
    ("joint", "initial", "two"),
    [
        ("weld: [one.end, two.start], angle: 200 deg", "one: {angle: 370 deg}", 570),
        ("weld: [one.end, two.start], angle: 200 deg", "two: {angle: 10 deg}", 10),
        # Given apart by a whole turn from what the weld holds: the same place.
        ("weld: [one.end, two.start]", "one: {angle: 370 deg}, two: {angle: 10 deg}", 10),
        ("slide: [one.end, two.start], along: [1, 2], angle: 30 deg",
         "one: {angle: 20 deg}, two: {x: 1.5}", 50),
    ],
)  # fmt: skip
def test_held_angles(tmp_path: Path, joint: str, initial: str, two: int) -> None:
    q, _ = start(tmp_path, PAIR.replace("JOINT", joint) + f"initial: {{{initial}}}\n")
    assert math.degrees(q["two.angle"]) == pytest.approx(two, abs=1e-12)


def test_a_slide_between_moving_bodies_keeps_its_line(tmp_path: Path) -> None:
    text = PAIR.replace("JOINT", "slide: [one.end, two.center], along: [30, 40]")
    q, v = start(tmp_path, text + "initial: {one: {angle: 0, omega: 2}, two: {x: 1.1, vx: 1}}\n")
    assert q["two.y"] == pytest.approx(0.3 * 4 / 3, abs=1e-14)
    # u·Δ = 0.5 along (0.6, 0.8); ṙ = ω × r + s u with r = (1.1, 0.4): s = (1 + 0.8)/0.6
    assert v["two.y"] == pytest.approx(2.2 + 0.8 * 1.8 / 0.6, abs=1e-12)


def test_bodies_that_nothing_holds(tmp_path: Path) -> None:
    """A free body, one held by springs only: all is given, rates that are not are zero."""
    text = """\
scene:
  points: {O: [0, 0]}
  bodies: {free: {rigid: {mass: 1, inertia: 0.1}}, hung: {particle: {mass: 1}}}
  forces: {coil: {spring: [ground.O, hung.center], stiffness: 30, rest_length: 0.3}}
initial: {free: {x: 1, y: 2, angle: 3, vx: 4}, hung: {x: 0, y: -1}}
allow: {free.x: 1.0e-2}
"""
    q, v = start(tmp_path, text)
    assert list(q.values()) == [1, 2, 3, 0, -1]
    assert list(v.values()) == [4, 0, 0, 0, 0]


def test_of_two_mechanisms_each_has_its_own_rates(tmp_path: Path) -> None:
    text = """\
scene:
  points: {O: [0, 0], Q: [2, 0]}
  bodies:
    one: {bar: {mass: 1, length: 0.8}}
    two: {bar: {mass: 1, length: 0.8}}
    dot: {particle: {mass: 0.2}}
  joints:
    left: {pin: [ground.O, one.start]}
    right: {pin: [ground.Q, two.start]}
    tip: {pin: [one.end, dot.center]}
initial: {one: {angle: 0, omega: 2}, two: {angle: 0}}
allow: {one.angle: 1.0e-2}
"""
    q, v = start(tmp_path, text)
    assert (q["dot.x"], v["dot.y"]) == pytest.approx((0.8, 1.6), abs=1e-14)
    assert v["two.angle"] == v["two.y"] == 0.0


def test_a_dead_centre_is_a_start_like_any_other(tmp_path: Path) -> None:
    text = SLIDER_CRANK + "initial: {crank: {angle: 0, omega: 3}}\nnear: {piston: {x: 0.8}}\n"
    _, v = start(tmp_path, text)
    assert v["piston.x"] == pytest.approx(0.0, abs=1e-12)
    assert v["rod.angle"] == pytest.approx(-1.0, abs=1e-12)


def test_a_wheel_stands_on_the_floor_and_rolls(tmp_path: Path) -> None:
    text = """\
scene:
  bodies: {wheel: {disk: {mass: 1, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.5, ideal: rolling}}
initial: {wheel: {x: 1, angle: 0, omega: -2}}
allow: {wheel.x: 1.0e-2}
"""
    q, v = start(tmp_path, text)
    assert (q["wheel.y"], v["wheel.x"]) == pytest.approx((0.25, 0.5), abs=1e-15)


# What is refused, where, and in which words.


def test_two_ways_are_both_printed(tmp_path: Path) -> None:
    text = FOUR_BAR + "initial: {crank: {angle: 70 deg}}\n"
    mistake = refused(tmp_path, text)
    assert mistake.line == line(text, "initial")
    assert "can be assembled in 2 ways" in mistake.what
    assert "rocker.angle = 95.93 deg or -134.9 deg" in mistake.what
    assert "near: {rocker: {angle: 95.93 deg}}" in mistake.what


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
    text = """\
scene:
  bodies: {wheel: {disk: {mass: 1, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.5, ideal: rolling}}
initial: {wheel: {x: 1}}
allow: {wheel.x: 1.0e-2}
"""
    assert "wheel.angle is not determined" in refused(tmp_path, text).what


@pytest.mark.parametrize("x", ["0.8", "0.79999999999"])
def test_a_piston_given_at_its_dead_centre_leaves_the_crank_open(tmp_path: Path, x: str) -> None:
    text = SLIDER_CRANK + f"initial: {{piston: {{x: {x}}}}}\nnear: {{crank: {{angle: 0}}}}\n"
    mistake = refused(tmp_path, text)
    assert "determine" in mistake.what
    assert "crank.angle" in mistake.what
