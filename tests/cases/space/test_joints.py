"""Coordinates, gaps and contacts in space on motions that are made from them."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given.spatial_motions import Array, Moving, T, rate, states, turn

from textmech.cases.scene import Anchor, GroundPoint
from textmech.cases.scene.body import Body
from textmech.cases.scene.chain import Turns
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.counting import far
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.motion import Motion
from textmech.cases.trajectory import Trajectory

A, B = np.array([0.1, -0.2, 0.3]), np.array([-0.2, 0.1, 0.4])  # the points that are joined
U, V, W = (np.array(u) / np.linalg.norm(u) for u in [(1, 2, 2), (0, 3, -1), (2, 0, 1)])
Coordinate = Callable[[float], float]


def one(t: float) -> float:
    return 0.3 + 7.0 * t - 2.0 * t**2  # more than a turn


def two(t: float) -> float:
    return 0.4 * math.sin(2 * t) + 0.1


def three(t: float) -> float:
    return -0.5 + 8.0 * t


def first(t: float) -> Array:
    return np.array([math.sin(t), t**2, 0.4])


def first_attitude(t: float) -> Array:
    return turn((1, 1, 3), 2 * t) @ turn((0, 1, 0), t**2)


def body(name: str, point: Array) -> Body:
    return Body(name, "rigid", 1.0, (1, 1, 1, 0, 0, 0), {"P": tuple(point)}, frame=SPACE)


def motion(place: Moving, attitude: Moving) -> Motion:
    """Of a first body that flies about, and a second one."""
    bodies = {"a": body("a", A), "b": body("b", B)}
    moved = {"a": states(first, first_attitude), "b": states(place, attitude)}
    return Motion(bodies, {"O": GroundPoint((0, 0, 0), (0, 0, 0))}, Trajectory(T, moved, {}))  # type: ignore[arg-type]


def jointed(freedoms: list[Freedom], values: list[Coordinate]) -> Motion:
    """The second part where the freedoms, one after the other, take it from the first."""

    def attitude(t: float) -> Array:
        R = first_attitude(t)
        for freedom, value in zip(freedoms, values, strict=True):
            if freedom.kind == "turn":
                R = R @ turn(freedom.axis, value(t))
        return R

    def place(t: float) -> Array:
        shifts = [f.kind == "shift" for f in freedoms]
        d = sum(
            (
                value(t) * np.array(f.axis)
                for f, value, s in zip(freedoms, values, shifts, strict=True)
                if s
            ),
            np.zeros(3),
        )
        return first(t) + first_attitude(t) @ (A + d) - attitude(t) @ B

    return motion(place, attitude)


def shift(axis: Array, name: str) -> Freedom:
    return Freedom.shift(tuple(axis), name)


def hinge(axis: Array, name: str) -> Freedom:
    return Freedom.turn(tuple(axis), name)


@pytest.mark.parametrize(
    ("freedoms", "values"),
    [
        ([hinge(U, "angle")], [one]),
        ([hinge(U, "c1"), hinge(V, "c2")], [one, three]),
        ([hinge(U, "c1"), hinge(V, "c2"), hinge(W, "c3")], [one, two, three]),
        ([shift(U, "x")], [one]),
        ([shift(U, "x"), shift(V, "y"), hinge(W, "phi")], [one, two, three]),
        ([shift(U, "x"), shift(V, "y"), shift(W, "z"), hinge(W, "c")], [one, two, three, one]),
    ],
)
def test_coordinates(freedoms: list[Freedom], values: list[Coordinate]) -> None:
    moved = jointed(freedoms, values)
    joint = Joint("j", "freedoms", Anchor("a", "P"), Anchor("b", "P"), tuple(freedoms), frame=SPACE)
    for freedom, value in zip(freedoms, values, strict=True):
        seen = joint.observe(moved, freedom.name)
        expected = np.array([value(t) for t in T])
        if freedom.kind == "turn":  # counted from where it starts, within half a turn
            seen = seen + 2 * math.pi * np.round((expected[0] - seen[0]) / (2 * math.pi))
        np.testing.assert_allclose(seen, expected, atol=1e-9)
        name = "omega" if freedom.name == "angle" else f"{freedom.name}_dot"
        rates = [rate(value, t) for t in T]
        np.testing.assert_allclose(joint.observe(moved, name), rates, atol=1e-9)
    np.testing.assert_allclose(joint.observe(moved, "gap"), 0, atol=1e-12)


@pytest.mark.parametrize("turns", [0, 1, 2])
def test_only_the_middle_of_three_turns_can_pass_gimbal_lock(turns: int) -> None:
    """0.2 rad in a step whose ends are 0.1 from it: the first and the last do not change that."""
    rates = np.tile(np.eye(3)[turns], (2, 1))
    found = Turns(rates * [[0.0], [0.2]], rates, np.full(2, 0.1))
    assert far(found, np.array([0.0, 0.2])).tolist() == [turns == 1]


def test_gap() -> None:
    """Two centimetres off, in a direction that the slide does not leave."""
    off = np.cross(U, V) / np.linalg.norm(np.cross(U, V))
    moved = motion(
        lambda t: first(t) + first_attitude(t) @ (A + one(t) * U + 0.02 * off - B), first_attitude
    )
    joint = Joint(
        "j", "slide", Anchor("a", "P"), Anchor("b", "P"), (shift(U, "shift"),), frame=SPACE
    )
    np.testing.assert_allclose(joint.observe(moved, "gap"), 0.02, rtol=1e-9)
    np.testing.assert_allclose(joint.observe(moved, "shift"), [one(t) for t in T], atol=1e-9)


def test_what_touches() -> None:
    """A tilting disk and a sphere: where their lowest points are, and how fast those move."""
    axle = np.array(V)
    disk = Body(
        "d",
        "disk",
        1.0,
        (1, 1, 1, 0, 0, 0),
        {"center": (0, 0, 0)},
        0.25,
        tuple(axle),
        frame=SPACE,
    )
    ball = Body("s", "sphere", 1.0, (1, 1, 1, 0, 0, 0), {"center": (0, 0, 0)}, 0.3, frame=SPACE)
    rows = states(first, first_attitude)
    reactions = {"d.fx": np.cos(T), "d.fy": np.sin(3 * T)}
    moved = Motion({"d": disk, "s": ball}, {}, Trajectory(T, {"d": rows, "s": rows}, reactions))
    on_rim = spatial_contact("d", Anchor("d", "center"), 1.0, rim=True)
    anywhere = spatial_contact("s", Anchor("s", "center"), 1.0, rim=False)
    e = np.cross(axle, (1.0, 0.0, 0.0))
    e /= np.linalg.norm(e)
    rim = 0.25 * (
        np.cos(around := np.linspace(0, 2 * math.pi, 20001))[:, None] * e
        + np.sin(around)[:, None] * np.cross(axle, e)
    )
    for k, t in enumerate(T):
        heights = (first(t) + rim @ first_attitude(t).T)[:, 2]
        lowest = rim[np.argmin(heights)]
        assert on_rim.observe(moved, "gap")[k] == pytest.approx(heights.min(), abs=1e-7)
        v = rate(lambda s, x=lowest: first(s) + first_attitude(s) @ x, t)
        assert on_rim.observe(moved, "slip")[k] == pytest.approx(math.hypot(*v[:2]), abs=1e-3)
        under = first_attitude(t).T @ (0.0, 0.0, -0.3)
        v = rate(lambda s, x=under: first(s) + first_attitude(s) @ x, t)
        assert anywhere.observe(moved, "slip")[k] == pytest.approx(math.hypot(*v[:2]), abs=1e-9)
        left = (first_attitude(t) @ axle)[:2]
        left /= np.linalg.norm(left)
        F = np.array([math.cos(t), math.sin(3 * t)])
        assert on_rim.observe(moved, "side")[k] == pytest.approx(F @ left, abs=1e-12)
        forward = np.array([left[1], -left[0]])  # left is forward turned by 90° to the left
        assert on_rim.observe(moved, "along")[k] == pytest.approx(F @ forward, abs=1e-12)
    np.testing.assert_allclose(anywhere.observe(moved, "gap"), 0.4 - 0.3, atol=1e-12)
