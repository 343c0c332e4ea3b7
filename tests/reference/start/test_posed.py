"""Starts by joints: the same start as by bodies, on its turn; what does not fit is refused."""

from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.linkages import FOUR_BAR

from textmech.cases.mistake import CaseError
from textmech.reference.start.assembly import assemble
from textmech.reference.system import Array

CHAIN = """\
scene:
  points: {O: [0, 0]}
  bodies: {rod: {bar: {mass: 1.2, length: 0.8}}, arm: {bar: {mass: 0.7, length: 0.5}}}
  joints: {hinge: {pin: [ground.O, rod.start]}, elbow: {pin: [arm.start, rod.end]}}
initial: START
allow: {hinge.angle: 1.0e-2, elbow.omega: 1.0e-2}
"""
CART = """\
scene:
  points: {O: [0.3, 0]}
  bodies:
    cart: {block: {mass: 2.0, width: 0.2, height: 0.1}}
    rod: {bar: {mass: 0.5, length: 0.6}}
  joints:
    rail: {slide: [ground.O, cart.center], along: [0.6, 0.8], angle: 20 deg}
    guide: {slot: [cart.center, rod.start], along: [0, 1]}
initial: START
allow: {rail.shift: 1.0e-2}
"""
LOOP = FOUR_BAR + "initial: START\nnear: {rocker: {angle: 96 deg}}\n"


def begun(folder: Path, scene: str, start: str) -> tuple[Array, Array]:
    return assemble(scenes.typed(folder, scene.replace("START", start)))


SAME = [
    (
        CHAIN,
        "{hinge: {angle: 380 deg, omega: 1.5}, elbow: {angle: -50 deg, omega: 2.0}}",
        "{rod: {angle: 380 deg, omega: 1.5}, arm: {angle: 430 deg, omega: -0.5}}",
    ),
    (
        CHAIN,
        "{hinge: {angle: 20 deg}, elbow: {angle: 400 deg}}",
        "{rod: {angle: 20 deg}, arm: {angle: -380 deg}}",
    ),
    (
        LOOP,
        "{A: {angle: 70 deg, omega: 2.0}}",
        "{crank: {angle: 70 deg, omega: 2.0}}",
    ),
]


@pytest.mark.parametrize(("scene", "by_joints", "by_bodies"), SAME)
def test_as_by_bodies(scene: str, by_joints: str, by_bodies: str, tmp_path: Path) -> None:
    one, other = (begun(tmp_path, scene, start) for start in (by_joints, by_bodies))
    assert one[0] == pytest.approx(other[0], abs=1e-12)
    assert one[1] == pytest.approx(other[1], abs=1e-12)


def test_a_slide_and_a_slot(tmp_path: Path) -> None:
    """The cart stands 0.2 m up the line from O, the rod's start 0.1 m beyond it across the cart."""
    start = "{rail: {shift: 0.2, speed: 0.5}, guide: {shift: 0.1, speed: -0.3, angle: 1, omega: 2}}"
    q, v = begun(tmp_path, CART, start)
    turn = np.radians(20.0)
    cart, up = np.array([0.3 + 0.12, 0.16]), np.array([-np.sin(turn), np.cos(turn)])
    lean = np.array([np.cos(turn + 1), np.sin(turn + 1)])
    aside = np.array([-lean[1], lean[0]])
    cart_dot = 0.5 * np.array([0.6, 0.8])
    assert q == pytest.approx([*cart, turn, *(cart + 0.1 * up + 0.3 * lean), turn + 1], abs=1e-12)
    rod_dot = cart_dot - 0.3 * up + 2.0 * 0.3 * aside
    assert v == pytest.approx([*cart_dot, 0.0, *rod_dot, 2.0], abs=1e-12)


REFUSED = [
    (
        CHAIN,
        "{hinge: {angle: 0}, elbow: {angle: 20 deg}, arm: {angle: 0}}",
        "cannot be assembled from what is given: elbow.angle stays open by 20 deg",
    ),
    (LOOP, "{A: {angle: 70 deg}, D: {angle: 10 deg}}", "cannot be assembled"),
    (
        CHAIN,
        "{hinge: {angle: 0, omega: 1}, rod: {omega: 2}, elbow: {angle: 0, omega: 0}}",
        "the rates violate",
    ),
]


@pytest.mark.slow
@pytest.mark.parametrize(("scene", "start", "what"), REFUSED)
def test_what_does_not_fit(scene: str, start: str, what: str, tmp_path: Path) -> None:
    with pytest.raises(CaseError) as caught:
        begun(tmp_path, scene, start)
    assert what in caught.value.mistakes[0].what


@pytest.mark.mutant("an angle of a joint a turn from that of its body")
def test_an_angle_that_is_given_twice_is_given_on_one_turn(tmp_path: Path) -> None:
    start = "{{rod: {{angle: {rod} deg}}, hinge: {{angle: 20 deg}}, elbow: {{angle: 0}}}}"
    assert begun(tmp_path, CHAIN, start.format(rod=20))[0][2] == pytest.approx(np.radians(20))
    with pytest.raises(CaseError, match=r"hinge.angle: is 0.349066 rad, but .* another turn"):
        begun(tmp_path, CHAIN, start.format(rod=380))


FLYWHEEL = CHAIN.replace("arm.start, rod.end", "rod.end, arm.center")


@pytest.mark.parametrize("rate", ["elbow: {angle: 30 deg}", "elbow: {angle: 30 deg, omega: -1}"])
def test_a_rate_that_is_zero_both_ways_or_said_is_known(rate: str, tmp_path: Path) -> None:
    start = f"{{rod: {{angle: 20 deg, omega: 0}}, arm: {{angle: 50 deg}}, {rate}}}"
    _, v = begun(tmp_path, FLYWHEEL, start)
    assert v[5] == (-1.0 if "omega" in rate else 0.0)


def test_of_two_rates_that_may_be_zero_one_is_asked_for(tmp_path: Path) -> None:
    """The wheel that hangs on the arm may keep its own rate, or turn with the arm."""
    start = "{hinge: {angle: 20 deg, omega: 1.5}, elbow: {angle: 30 deg}}"
    with pytest.raises(CaseError, match=r"elbow.angle: gives the angle and no omega.*say omega"):
        begun(tmp_path, FLYWHEEL, start)
    _, v = begun(tmp_path, FLYWHEEL, start.replace("elbow: {angle: 30 deg}", "arm: {angle: 1}"))
    assert v[5] == 0.0  # by the body: its own
