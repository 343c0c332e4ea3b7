"""Derived quantities in space against sums of point masses and motions made by this test."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.machines.spatial_motions import Array, Moving, T, rate, states, turn

from textmech.cases.scene import Anchor, Damper, GroundPoint, Scene, Signal, Spring
from textmech.cases.scene.body import Body
from textmech.cases.scene.chain import Turns
from textmech.cases.scene.constraint import Edge
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.counting import ambiguous_turns
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.observe import observe
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import about, product, turned
from textmech.cases.trajectory import Trajectory

# Derived quantities in space against finite sums of point masses, moved by this test.

G = np.array([0.3, -0.7, -9.0])
MASSES = np.array([0.4, 0.3, 0.6, 0.2, 0.5])
POINTS = np.random.default_rng(3).normal(size=(5, 3)) * 0.3
POINTS -= MASSES @ POINTS / MASSES.sum()
J: Array = sum(
    m * (x @ x * np.eye(3) - np.outer(x, x)) for m, x in zip(MASSES, POINTS, strict=True)
)
SIX = (J[0, 0], J[1, 1], J[2, 2], J[0, 1], J[0, 2], J[1, 2])
P, END = (0.1, 0.2, -0.3), (0.4, 0.0, 0.1)
CENTER = {"center": (0.0, 0.0, 0.0)}


def place(t: float) -> Array:
    return np.array([0.4 * t**2, 0.2 * np.sin(3 * t), 1.0 - 0.3 * t])


def attitude(t: float) -> Array:
    return turn((1, 2, 0), 0.7 + 1.3 * t) @ turn((0, 1, 3), 2.0 * np.sin(t)) @ turn((1, 0, 0), t)


def bob(t: float) -> Array:
    return np.array([1.0 + np.cos(t), 0.5 * t, 2.0 - t**2])


SCENE = Scene(
    frame=SPACE,
    gravity=(0.3, -0.7, -9.0),
    points={"O": GroundPoint((0.3, 0.1, 0.2), (0.5, -0.2, 0.1))},  # type: ignore[arg-type]
    bodies={
        "cloud": Body("cloud", "rigid", 2.0, SIX, {**CENTER, "P": P, "end": END}, frame=SPACE),
        "bob": Body("bob", "particle", 0.7, (), CENTER, frame=SPACE),
    },
    joints={
        "q": Joint(
            "q", "hinge", Anchor("bob", "center"), Anchor("cloud", "P"),
            (Freedom.turn((0.0, 0.0, 1.0), "angle"),), frame=SPACE,
        ),
    },
    contacts={"touch": spatial_contact("touch", Anchor("cloud", "center"), 0.5, rim=False)},
    forces={
        "coil": Spring("coil", Anchor("cloud", "end"), Anchor("ground", "O"), 40.0, 0.3),
        "oil": Damper("oil", Anchor("bob", "center"), Anchor("cloud", "P"), 3.0),
    },
    drives={"q.omega": Signal("constant", (1.0,))},
)  # fmt: skip
SCENE = replace(
    SCENE, bodies={**SCENE.bodies, "cloud": replace(SCENE.bodies["cloud"], radius=0.25)}
)
REACTIONS = {f"q.{f}": k * T for k, f in enumerate(("fx", "fy", "fz", "mx", "my", "mz", "torque"))}
BODIES = {"cloud": states(place, attitude), "bob": states(bob, lambda t: np.eye(3))}
MOTION = Trajectory(T, BODIES, REACTIONS)


def at(t: float, point: Array) -> Array:
    return place(t) + attitude(t) @ point


def masses() -> list[tuple[float, Array]]:
    """Each point mass with its place and velocity (N, 6)."""
    moved = [
        (m, np.array([[*at(t, x), *rate(lambda s, x=x: at(s, x), t)] for t in T]))
        for m, x in zip(MASSES, POINTS, strict=True)
    ]
    return [*moved, (0.7, np.array([[*bob(t), *rate(bob, t)] for t in T]))]


def same(name: str, expected: Array) -> None:
    np.testing.assert_allclose(observe(SCENE, MOTION, name), expected, rtol=1e-9, atol=1e-9)


def test_energy() -> None:
    kinetic = sum(m / 2 * np.sum(s[:, 3:] ** 2, axis=1) for m, s in masses())
    potential = sum(-m * s[:, :3] @ G for m, s in masses())
    potential = potential + 20.0 * (coil() - 0.3) ** 2
    same("energy.kinetic", kinetic)
    same("energy.potential", potential)
    same("energy.total", kinetic + potential)


def test_momentum() -> None:
    p: Array = sum(m * s[:, 3:] for m, s in masses())
    D: Array = sum(m * np.cross(s[:, :3], s[:, 3:]) for m, s in masses())
    for i, axis in enumerate("xyz"):
        same(f"momentum.{axis}", p[:, i])
        same(f"momentum.angular_{axis}", D[:, i])


@pytest.mark.parametrize(("name", "point"), [("P", P), ("end", END), ("center", (0, 0, 0))])
def test_points(name: str, point: tuple[float, float, float]) -> None:
    velocity = np.array([rate(lambda s: at(s, point), t) for t in T])
    for i, axis in enumerate("xyz"):
        same(f"cloud.{name}.{axis}", np.array([at(t, point)[i] for t in T]))
        same(f"cloud.{name}.v{axis}", velocity[:, i])
    same(f"cloud.{name}.speed", np.linalg.norm(velocity, axis=1))


def test_turning() -> None:
    """ω by the rates of two body axes along the third: no formula of a quaternion."""
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        turning = [rate(lambda s, j=j: attitude(s)[:, j], t) @ attitude(t)[:, k] for t in T]
        same(f"cloud.omega_{i + 1}", np.array(turning))
    assert observe(SCENE, MOTION, "cloud.attitude").shape == (len(T), 4)


def coil() -> Array:
    hook = np.array([0.3, 0.1, 0.2]) + np.array([0.5, -0.2, 0.1]) * T[:, None]
    return np.linalg.norm([at(t, END) for t in T] - hook, axis=1)


def test_lines() -> None:
    same("coil.length", coil())
    same("coil.force", 40.0 * (coil() - 0.3))
    same("oil.force", np.array([3.0 * rate(lambda s: length(s), t) for t in T]))


def length(t: float) -> float:
    return float(np.linalg.norm(at(t, P) - bob(t)))


def test_every_quantity_is_seen_or_refused() -> None:
    """Only reactions that the producer does not give are refused."""
    missing = []
    for name in table(SCENE):
        try:
            assert len(observe(SCENE, MOTION, name)) == len(T)
        except KeyError:
            missing.append(name)
    assert missing == ["touch.fx", "touch.fy", "touch.normal"]
    same("q.torque", 6 * T)
    same("q.force", np.sqrt(5) * T)
    same("q.moment", np.sqrt(9 + 16 + 25) * T)
    with pytest.raises(KeyError):
        observe(SCENE, MOTION, "cloud.angle")


# Coordinates, gaps and contacts in space on motions that are made from them.

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
    assert ambiguous_turns(found, np.array([0.0, 0.2])).tolist() == [turns == 1]


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


# What a blade in space observes, of motions that are known.

TIP = (0.13, 0.014, -0.045)
BLADE = Edge("blade", Anchor("hand", "P"), (1.0, 0.0, 0.0), kept=True, frame=SPACE)
HAND = Body(
    "hand",
    "rigid",
    0.7,
    (1.0, 1.0, 1.0, 0.0, 0.0, 0.0),
    {"P": TIP, "center": (0.0, 0.0, 0.0)},
    frame=SPACE,
)
YAW, PITCH = 0.5, 0.9  # of the hand; a roll does not turn its long axis


def hand_motion(**states: Any) -> Motion:
    times = np.linspace(0.0, 1.0, len(next(iter(states.values()))))
    return Motion({"hand": HAND}, {}, Trajectory(times, states, {}))


def carried(velocity: tuple[float, float, float], omega: tuple[float, float, float]) -> Motion:
    """The hand yawed, pitched down and rolled, its centre at this velocity; then 0.2 m higher."""
    q = np.array(about((0.0, 0.0, 1.0), YAW))
    for axis, angle in (((0.0, 1.0, 0.0), PITCH), ((1.0, 0.0, 0.0), 0.3)):
        q = product(q, np.array(about(axis, angle)))
    row = [0.1, 0.2, 0.3, *q, *velocity, *omega]
    return hand_motion(hand=np.array([row, [0.1, 0.2, 0.5, *row[3:]]]))


def test_slip_is_to_the_left() -> None:
    left = carried((-math.sin(YAW), math.cos(YAW), 0.0), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(BLADE.observe(left, "slip"), 1.0, rtol=1e-15)
    np.testing.assert_allclose(BLADE.observe(left, "speed"), 0.0, atol=1e-15)


def test_slip_is_that_of_the_point() -> None:
    """A roll about the long axis carries P by ω × P, level for what points to the left."""
    rolling = carried((0.0, 0.0, 0.0), (3.0, 0.0, 0.0))
    q = rolling.trajectory.states["hand"][:, 3:7]
    moved = turned(q, np.cross([3.0, 0.0, 0.0], TIP))
    expected = moved @ [-math.sin(YAW), math.cos(YAW), 0.0]
    assert abs(expected).min() > 0.1
    np.testing.assert_allclose(BLADE.observe(rolling, "slip"), expected, rtol=1e-14)


def test_gap_is_the_height_over_the_start() -> None:
    lifted = carried((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
    np.testing.assert_allclose(BLADE.observe(lifted, "gap"), [0.0, 0.2], atol=1e-15)


def test_who_cannot_carry_one() -> None:
    bob = Body("bob", "particle", 0.7, (), {}, frame=SPACE)
    assert BLADE.why_unfit(HAND) is None
    assert "particle" in (BLADE.why_unfit(bob) or "")
    assert "ground" in (replace(BLADE, at=Anchor("ground", "O")).why_unfit(None) or "")
