"""MuJoCo's loops in space: what closes them, how they move, and what they hold."""

import math

import numpy as np
import pytest
from given.spatial_scenes import (
    STILL,
    ball,
    hinge,
    joint,
    omega,
    point,
    rigid,
    simulated,
    spatial,
    state,
    vector,
)  # fmt: skip
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from textmech.cases.motion import Motion
from textmech.cases.space.joint import Freedom, SpatialJoint
from textmech.cases.space.rotation import angle_between
from textmech.cases.space.scene import SpatialScene
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Refusal, Start
from textmech.engines.mujoco import MuJoCo

TIMES = np.linspace(0.0, 0.5, 6)
UP = np.array([0.0, 0.0, 1.0])
BEND = math.radians(30)
OUT = np.array([math.sin(BEND), 0.0, math.cos(BEND)])


def gap(scene: SpatialScene, motion: Trajectory, name: str) -> float:
    """The largest of a joint [m]."""
    found = scene.joints[name].observe(Motion(scene.bodies, scene.points, motion), "gap")
    return float(np.max(found))


def upright(matrix: Array) -> list[float]:
    """The quaternion of a rotation matrix."""
    return Rotation.from_matrix(matrix).as_quat(scalar_first=True).tolist()


def other_speed(arm: Array) -> tuple[float, Array]:
    """Of the driven shaft, where the driving one has 1 rad/s and its arm of the cross is there."""
    arm2 = np.cross(OUT, arm)
    arm2 /= np.linalg.norm(arm2)
    speed, *_ = np.linalg.solve(np.column_stack([OUT, -arm, -arm2]), UP)
    return float(speed), arm2


def shafts() -> tuple[SpatialScene, Start]:
    """Two shafts at 30 degrees, joined by a universal joint; the far end is held by a ball."""
    joints = [
        hinge("first", "ground.F", "in.foot", UP),
        joint(
            "cross", "universal", "in.end", "out.foot",
            Freedom("turn", (0.0, 1.0, 0.0)), Freedom("turn", (1.0, 0.0, 0.0)),
        ),
        ball("last", "out.end", "ground.E"),
    ]  # fmt: skip
    bodies = [
        rigid("in", 1.0, (0.01, 0.02, 0.03), {"end": 0.1 * UP, "foot": -0.1 * UP}),
        rigid("out", 2.0, (0.02, 0.02, 0.025), {"end": 0.2 * UP, "foot": -0.2 * UP}),
    ]
    at = {"F": point(-0.1 * UP), "E": point(0.1 * UP + 0.4 * OUT)}
    arm = np.array([0.0, 1.0, 0.0])
    speed, _ = other_speed(arm)
    axes = np.column_stack([np.cross(arm, OUT), arm, OUT])
    start = {
        "in": state(STILL, (1, 0, 0, 0), STILL, 10.0 * UP),
        "out": state(0.1 * UP + 0.2 * OUT, upright(axes), STILL, (0, 0, 10.0 * speed)),
    }
    return spatial(bodies, joints, points=at), start


def test_a_universal_joint_turns_unevenly() -> None:
    """cos β/(1 − sin²β cos²α), from its cross. Reached: 8e-8 at 1e-3, 7e-9 at 1e-4."""
    scene, start = shafts()
    motion = simulated(scene, start, TIMES, 1e-3)
    q = motion.states["in"][:, 3:7]
    angle = 2 * np.arctan2(q[:, 3], q[:, 0])
    arms = np.column_stack([-np.sin(angle), np.cos(angle), np.zeros_like(angle)])
    given = np.array([other_speed(arm)[0] for arm in arms])
    closed = math.cos(BEND) / (1 - math.sin(BEND) ** 2 * np.sin(angle) ** 2)
    assert np.max(np.abs(given - closed)) < 1e-12
    one, other = (omega(motion, body)[:, 2] for body in ("in", "out"))
    assert np.ptp(other / one) > 0.1
    assert np.max(np.abs(other / one - given)) < 3e-7
    energy = 0.03 * one**2 + 0.025 * other**2
    assert np.max(np.abs(energy / energy[0] - 1)) < 2e-8
    assert gap(scene, motion, "last") < 3e-8


P, Q = np.array([0.0, 0.0, 0.0]), np.array([0.6, 0.1, 0.0])
SKEW = np.array([0.6, 0.0, 0.8])
CRANK, LENGTH = 0.15, 0.75
FOOT, END, SIDE = np.array([-0.1, -0.2, 0.0]), np.array([0.1, 0.25, 0.0]), np.array([0.0, 1.0, 0.0])


def rssr(order: tuple[str, str]) -> tuple[SpatialScene, Start]:
    """Crank, coupler on two balls in an order of choice, rocker about a skew axis."""
    pin, half = P + CRANK * SIDE, LENGTH / 2 * SIDE
    bodies = [
        rigid("crank", 0.5, (0.002, 0.001, 0.002), {"foot": -0.5 * pin, "end": 0.5 * pin}),
        rigid("coupler", 1.0, (0.05, 0.002, 0.051), {"a": -half, "b": half}),
        rigid("rocker", 0.8, (0.01, 0.012, 0.015), {"foot": FOOT, "end": END}),
    ]

    def end(angle: float) -> Array:
        return Q + Rotation.from_rotvec(angle * SKEW).apply(END - FOOT)

    angle = float(brentq(lambda x: np.linalg.norm(end(x) - pin) - LENGTH, -0.5, 2.0))
    along = (end(angle) - pin) / LENGTH
    side = np.cross(along, UP) / np.linalg.norm(np.cross(along, UP))
    axes = np.column_stack([side, along, np.cross(side, along)])
    turn = Rotation.from_rotvec(angle * SKEW)
    start = {
        "crank": state(0.5 * pin, (1, 0, 0, 0), STILL, STILL),
        "coupler": state(pin + LENGTH / 2 * along, upright(axes), STILL, STILL),
        "rocker": state(Q + turn.apply(-FOOT), turn.as_quat(scalar_first=True), STILL, STILL),
    }
    balls = {
        "near": ball("near", "crank.end", "coupler.a"),
        "far": ball("far", "coupler.b", "rocker.end"),
    }
    joints = [
        hinge("motor", "ground.O", "crank.foot", UP),
        hinge("bearing", "ground.Q", "rocker.foot", SKEW),
        *(balls[name] for name in order),
    ]
    scene = spatial(bodies, joints, points={"Q": point(Q)}, gravity=(2.0, -3.0, -9.0))
    return scene, start


REACTIONS = [f"{name}.f{axis}" for name in ("near", "far", "bearing") for axis in "xyz"]


def test_a_spatial_four_bar_moves_alike_wherever_it_is_cut() -> None:
    """The last ball closes it: its force by `connect` is the one through the tree.

    At 5e-4: 3e-7 m, rad, m/s and rad/s apart, forces of 15 N to 1e-3, gap 1e-8 m.
    """
    times = np.linspace(0.0, 0.4, 5)
    found = []
    for order in (("near", "far"), ("far", "near")):
        scene, start = rssr(order)
        motion = simulated(scene, start, times, 5e-4, REACTIONS)
        assert gap(scene, motion, "near") < 1e-7
        assert gap(scene, motion, "far") < 1e-7
        found.append(motion)
    one, other = found
    assert np.ptp(one.states["rocker"][:, 2]) > 0.02  # it moves
    for name, rows in one.states.items():
        assert np.max(np.abs(rows - other.states[name])) < 1e-5
    for name in REACTIONS:
        assert np.max(np.abs(one.reactions[name][1:] - other.reactions[name][1:])) < 5e-3


def square(last: SpatialJoint) -> tuple[SpatialScene, Start]:
    """A double swing of two bars about parallel hinges, whose outer end a third joint holds."""
    bodies = [
        rigid(name, 1.0, (0.01, 0.04, 0.045), {"a": (-0.2, 0, 0), "b": (0.2, 0, 0)})
        for name in ("left", "top", "right")
    ]
    axis = (0.0, 1.0, 0.0)
    joints = [
        hinge("A", "ground.O", "left.a", axis), hinge("B", "left.b", "top.a", axis),
        hinge("C", "top.b", "right.a", axis), last,
    ]  # fmt: skip
    begun = {"left": ((0.0, 0.0, -0.2), math.pi / 2), "top": ((0.2, 0.0, -0.4), 0.0)}
    begun["right"] = ((0.4, 0.0, -0.2), -math.pi / 2)
    start = {
        name: state(
            at, Rotation.from_rotvec([0, angle, 0]).as_quat(scalar_first=True), STILL, STILL
        )
        for name, (at, angle) in begun.items()
    }
    return spatial(
        bodies, joints, points={"D": point((0.4, 0.0, 0.0))}, gravity=(3.0, 0.0, -9.0)
    ), start


def test_a_hinge_closes_a_loop_as_a_ball_does_in_a_plane() -> None:
    """Its two points hold the axis too, where the other hinges hold it already."""
    axis = (0.0, 1.0, 0.0)
    names = [f"D.{letter}{a}" for letter in "fm" for a in "xyz"]
    found = {}
    for last in (hinge("D", "right.b", "ground.D", axis), ball("D", "right.b", "ground.D")):
        scene, start = square(last)
        found[last.kind] = simulated(scene, start, TIMES, 5e-4, names)
    rows = [motion.states["right"] for motion in found.values()]
    assert np.ptp(rows[0][:, 0]) > 0.1
    assert np.max(np.abs(rows[0] - rows[1])) < 1e-6
    for name in ("D.fx", "D.fz", "D.my"):
        assert np.max(np.abs(np.diff([m.reactions[name] for m in found.values()], axis=0))) < 1e-2


ENDS = {"l": (-0.3, 0.0, 0.0), "r": (0.3, 0.0, 0.0)}
AT = {"L": point(ENDS["l"]), "R": point(ENDS["r"])}
BAR = rigid("b", 1.0, (0.02, 0.03, 0.04), ENDS)
ALONG = (1.0, 0.0, 0.0)


def test_two_hinges_on_one_axis_let_it_turn() -> None:
    joints = [hinge("one", "ground.L", "b.l", ALONG), hinge("two", "b.r", "ground.R", ALONG)]
    start = {"b": state(STILL, (1, 0, 0, 0), STILL, (2.0, 0, 0))}
    motion = simulated(spatial([BAR], joints, points=AT), start, TIMES, 1e-3)
    turned = angle_between(motion.states["b"][:, 3:7], np.array([1.0, 0, 0, 0]))
    assert np.max(np.abs(turned - 2.0 * TIMES)) < 1e-9


def test_a_weld_closes_a_loop_and_its_moment_is_read() -> None:
    """With what the other joint holds it keeps the balance; the bar does not move."""
    turns = [Freedom("turn", axis) for axis in (ALONG, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    joints = [
        joint("guide", "freedoms", "ground.L", "b.l", Freedom("shift", ALONG), *turns),
        joint("held", "weld", "b.r", "ground.R"),
    ]
    start = {"b": state(STILL, (1, 0, 0, 0), STILL, STILL)}
    names = [f"{name}.{letter}{a}" for name in ("guide", "held") for letter in "fm" for a in "xyz"]
    gravity = np.array([1.0, 2.0, -9.0])
    scene = spatial([BAR], joints, points=AT, gravity=vector(gravity))
    motion = simulated(scene, start, TIMES, 1e-3, names)
    assert np.max(np.abs(motion.states["b"] - motion.states["b"][0])) < 1e-7
    row = np.array([motion.reactions[name][-1] for name in names]).reshape(2, 2, 3)
    (force, moment), (back, back_moment) = row
    assert np.max(np.abs(force - back + gravity)) < 1e-6
    arms = np.cross(ENDS["l"], force) - np.cross(ENDS["r"], back)
    assert np.max(np.abs(moment - back_moment + arms)) < 1e-6
    assert np.linalg.norm(back_moment) > 0.1


def test_what_cannot_move_is_refused() -> None:
    """MuJoCo drops such a constraint, and with it the force that would be read."""
    joints = [joint("one", "weld", "ground.L", "b.l"), joint("two", "weld", "b.r", "ground.R")]
    start = {"b": state(STILL, (1, 0, 0, 0), STILL, STILL)}
    (refusal,) = MuJoCo("tuned").plans(spatial([BAR], joints, points=AT), start)
    assert isinstance(refusal, Refusal)
    assert "leaves out two" in refusal.because


@pytest.mark.parametrize(
    ("kind", "freedoms"),
    [
        ("slide", (Freedom("shift", (1.0, 0.0, 0.0), "shift"),)),
        ("universal", (Freedom("turn", (1.0, 0.0, 0.0)), Freedom("turn", (0.0, 1.0, 0.0)))),
    ],
)
def test_what_connect_cannot_close_is_refused(kind: str, freedoms: tuple[Freedom, ...]) -> None:
    body = rigid("b", 1.0, (0.02, 0.03, 0.04), {"l": (-0.3, 0, 0), "r": (0.3, 0, 0)})
    joints = [joint(name, kind, "ground.O", f"b.{end}", *freedoms) for name, end in ("sl", "tr")]
    start = {"b": state((0.3, 0, 0), (1, 0, 0, 0), STILL, STILL)}
    (refusal,) = MuJoCo("tuned").plans(spatial([body], joints), start)
    assert isinstance(refusal, Refusal)
    assert refusal.because == f"engine: MuJoCo has no constraint that closes a loop by the {kind} t"
