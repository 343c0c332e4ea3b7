"""Two shafts with a universal joint and a spatial four-bar: MuJoCo's loops in motion."""

import math

import numpy as np
from given.engine_space import (
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
)  # fmt: skip
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from textmech.cases.scene import Scene
from textmech.cases.scene.joint import Freedom
from textmech.cases.scene.motion import Motion
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Start

TIMES = np.linspace(0.0, 0.5, 6)
UP = np.array([0.0, 0.0, 1.0])
BEND = math.radians(30)
OUT = np.array([math.sin(BEND), 0.0, math.cos(BEND)])


def gap(scene: Scene, motion: Trajectory, name: str) -> float:
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


def shafts() -> tuple[Scene, Start]:
    """Two shafts at 30 degrees, joined by a universal joint; the far end is held by a ball."""
    joints = [
        hinge("first", "ground.F", "in.foot", UP),
        joint(
            "cross", "universal", "in.end", "out.foot",
            Freedom.turn((0.0, 1.0, 0.0)), Freedom.turn((1.0, 0.0, 0.0)),
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


def rssr(order: tuple[str, str]) -> tuple[Scene, Start]:
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

    At 5e-4 places are 6e-7 apart, rates 2e-5, forces of up to 50 N 5e-4; at 1e-4 1e-8, 9e-7, 2e-4.
    """
    times = np.linspace(0.0, 0.4, 5)
    found = []
    for order in (("near", "far"), ("far", "near")):
        scene, start = rssr(order)
        motion = simulated(scene, start, times, 5e-4, REACTIONS)
        assert gap(scene, motion, "near") < 3e-7
        assert gap(scene, motion, "far") < 3e-7
        found.append(motion)
    one, other = found
    assert np.ptp(one.states["rocker"][:, 2]) > 0.02  # it moves
    for name, rows in one.states.items():
        assert np.max(np.abs(rows - other.states[name])[:, :7]) < 2e-6
        assert np.max(np.abs(rows - other.states[name])[:, 7:]) < 6e-5
    for name in REACTIONS:
        assert np.max(np.abs(one.reactions[name] - other.reactions[name])) < 2e-3
