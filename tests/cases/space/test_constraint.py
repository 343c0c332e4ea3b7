"""What a blade in space observes, of motions that are known."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.scene.body import Body
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.point import Anchor
from textmech.cases.scene.rotation import about, product, turned
from textmech.cases.trajectory import Trajectory
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.systems import written

P = (0.13, 0.014, -0.045)
BLADE = Edge("blade", Anchor("hand", "P"), (1.0, 0.0, 0.0), kept=True, frame=SPACE)
HAND = Body(
    "hand",
    "rigid",
    0.7,
    (1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
    {"P": P, "center": (0.0, 0.0, 0.0)},
    frame=SPACE,
)
YAW, PITCH = 0.5, 0.9  # of the hand; a roll does not turn its long axis


def motion(**states: Any) -> Motion:
    times = np.linspace(0.0, 1.0, len(next(iter(states.values()))))
    return Motion({"hand": HAND}, {}, Trajectory(times, states, {}))


def carried(velocity: tuple[float, float, float], omega: tuple[float, float, float]) -> Motion:
    """The hand yawed, pitched down and rolled, its centre at this velocity; then 0.2 m higher."""
    q = np.array(about((0.0, 0.0, 1.0), YAW))
    for axis, angle in (((0.0, 1.0, 0.0), PITCH), ((1.0, 0.0, 0.0), 0.3)):
        q = product(q, np.array(about(axis, angle)))
    row = [0.1, 0.2, 0.3, *q, *velocity, *omega]
    return motion(hand=np.array([row, [0.1, 0.2, 0.5, *row[3:]]]))


def test_a_blade_carried_along_its_heading_does_not_slip() -> None:
    ahead = carried((2 * math.cos(YAW), 2 * math.sin(YAW), -0.7), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(BLADE.observe(ahead, "speed"), 2.0, rtol=1e-15)
    np.testing.assert_allclose(BLADE.observe(ahead, "slip"), 0.0, atol=1e-15)


def test_slip_is_to_the_left() -> None:
    left = carried((-math.sin(YAW), math.cos(YAW), 0.0), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(BLADE.observe(left, "slip"), 1.0, rtol=1e-15)
    np.testing.assert_allclose(BLADE.observe(left, "speed"), 0.0, atol=1e-15)


def test_slip_is_that_of_the_point() -> None:
    """A roll about the long axis carries P by ω × P, level for what points to the left."""
    rolling = carried((0.0, 0.0, 0.0), (3.0, 0.0, 0.0))
    q = rolling.trajectory.states["hand"][:, 3:7]
    moved = turned(q, np.cross([3.0, 0.0, 0.0], P))
    expected = moved @ [-math.sin(YAW), math.cos(YAW), 0.0]
    assert abs(expected).min() > 0.1
    np.testing.assert_allclose(BLADE.observe(rolling, "slip"), expected, rtol=1e-14)


def test_gap_is_the_height_over_the_start() -> None:
    lifted = carried((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(BLADE.observe(lifted, "gap"), [0.0, 0.2], atol=1e-15)


def test_what_it_can_be_asked() -> None:
    free = replace(BLADE, kept=False)
    assert set(BLADE.quantities()["blade"]) == {"force", "slip", "speed", "normal", "gap"}
    assert set(free.quantities()["blade"]) == {"force", "slip", "speed"}
    lifted = carried((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    for edge, field in ((BLADE, "force"), (BLADE, "normal"), (free, "gap")):
        with pytest.raises(KeyError):
            edge.observe(lifted, field)


def test_who_cannot_carry_one() -> None:
    bob = Body("bob", "particle", 0.7, (), {}, frame=SPACE)
    assert BLADE.unfit(HAND) is None
    assert "particle" in (BLADE.unfit(bob) or "")
    assert "ground" in (replace(BLADE, at=Anchor("ground", "O")).unfit(None) or "")


def test_the_robots_knife_neither_slips_nor_rises() -> None:
    angles = {f"q{k + 1}": x for k, x in enumerate((0.35, -0.7, 1.13, 0.61, -0.44))}
    times = np.linspace(0.0, 0.1, 3)
    system = written("robot_knife", {**angles, "w3": 0.9, "w4": -1.1, "w5": 6.0})
    states = Answer(system, follow(system, times)).trajectory(times).states
    moving = motion(hand=states["hand"])
    assert BLADE.observe(moving, "speed")[-1] > 0.1, "it stands still"
    for field in ("slip", "gap"):
        assert abs(BLADE.observe(moving, field)).max() < 1e-13  # rounding of metres and m/s
    wrong = replace(BLADE, along=(0.0, 1.0, 0.0))
    assert abs(wrong.observe(moving, "slip")).max() > 0.1
    elsewhere = replace(BLADE, at=Anchor("hand", "center"))
    assert abs(elsewhere.observe(moving, "slip")).max() > 0.1
