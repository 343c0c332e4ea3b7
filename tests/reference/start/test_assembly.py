"""Starts that a case file describes, and what follows from them."""

import math
import re
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.linkages import BAR, FOUR_BAR, PAIR, SLIDER_CRANK

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.start.assembly import assemble
from textmech.reference.system import Array


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


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.mark.slow
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


@pytest.mark.parametrize("given", ["vx: 2", "vx: 2, vy: 0", "vx: 1.0e12", "omega: 3"])
def test_rates_that_nothing_determines_are_zero(tmp_path: Path, given: str) -> None:
    """A welded pair on the floor: once any rate is given, the others were asked for too."""
    text = """\
scene:
  bodies: {a: {block: {mass: 1.0e-30, width: 0.2, height: 0.2}}, b: {disk: {mass: 1, radius: 0.2}}}
  joints: {w: {weld: [a.center, b.center]}}
  contacts: {touch: {between: [b, ground.floor], friction: 0.3}}
initial: {b: {x: 0, y: 0.2, angle: 0, GIVEN}}
allow: {b.x: 1.0e-2}
"""
    _, v = start(tmp_path, text.replace("GIVEN", given))
    name, value = given.split(",")[0].split(": ")
    field = {"vx": "x", "omega": "angle"}[name]
    both = {f"{body}.{field}": float(value) for body in ("a", "b")}
    assert v == {key: both.get(key, 0.0) for key in v}


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


STACK = """\
scene:
  bodies:
    lo: {block: {mass: 1, width: 1.2, height: 0.2}}
    up: {block: {mass: 1, width: 0.3, height: 0.2}}
  contacts:
    a: {between: [lo.lower_left, ground.floor], friction: 0.3}
    b: {between: [lo.lower_right, ground.floor], friction: 0.3}
    c: {between: [up.lower_left, lo.top], friction: 0.3}
    d: {between: [up.lower_right, lo.top], friction: 0.3}
initial: {lo: {x: 0, on: [lower_left, lower_right]}, up: {x: 0.055, on: [lower_left, lower_right]}}
allow: {up.x: 0.01}
"""


@pytest.mark.slow
def test_the_advice_tells_one_way_from_all_others(tmp_path: Path) -> None:
    """Each of two blocks may stand on its head; an angle of rounding is none."""
    with pytest.raises(CaseError) as caught:
        assemble(scenes.typed(tmp_path, STACK))
    (mistake,) = caught.value.mistakes
    assert "in 4 ways: up.angle = 0 deg or 180 deg; say which" in mistake.what
    (advice,) = re.findall("for instance (near: .*)$", mistake.what)
    assert advice.count("angle") == 2
    q, _ = assemble(scenes.typed(tmp_path, f"{STACK}{advice}\n"))
    assert q == pytest.approx([0, 0.1, 0, 0.055, 0.3, 0], abs=1e-12)


CARRIED = """\
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


@pytest.mark.mutant("what stands on another body has rates of its own")
def test_what_stands_on_a_body_moves_with_it(tmp_path: Path) -> None:
    """The plank's −1 m/s follow from the left bar alone; the rod's foot has them too."""
    _, v = start(tmp_path, CARRIED)
    assert v["plank.x"] == pytest.approx(-1.0, abs=1e-12)
    angle, omega = math.radians(80), 0.3
    foot = (
        v["rod.x"] + omega * 0.2 * math.sin(angle),
        v["rod.y"] - omega * 0.2 * math.cos(angle),
    )
    assert foot == pytest.approx((-1.0, 0.0), abs=1e-12)
