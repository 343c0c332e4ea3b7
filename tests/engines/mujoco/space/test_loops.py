"""MuJoCo's loops in space: what closes them, and what they hold."""

import math

import numpy as np
import pytest
from given.engine_space import (
    STILL,
    ball,
    hinge,
    joint,
    point,
    rigid,
    simulated,
    spatial,
    state,
    vector,
)  # fmt: skip
from scipy.spatial.transform import Rotation

from textmech.cases.scene import Scene
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.rotation import angle_between
from textmech.engines.engine import Refusal, Start
from textmech.engines.mujoco import MuJoCo

TIMES = np.linspace(0.0, 0.5, 6)


def square(last: Joint) -> tuple[Scene, Start]:
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
    turns = [Freedom.turn(axis) for axis in (ALONG, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]
    joints = [
        joint("guide", "freedoms", "ground.L", "b.l", Freedom.shift(ALONG), *turns),
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
        ("slide", (Freedom.shift((1.0, 0.0, 0.0), "shift"),)),
        ("universal", (Freedom.turn((1.0, 0.0, 0.0)), Freedom.turn((0.0, 1.0, 0.0)))),
    ],
)
def test_what_connect_cannot_close_is_refused(kind: str, freedoms: tuple[Freedom, ...]) -> None:
    body = rigid("b", 1.0, (0.02, 0.03, 0.04), {"l": (-0.3, 0, 0), "r": (0.3, 0, 0)})
    joints = [joint(name, kind, "ground.O", f"b.{end}", *freedoms) for name, end in ("sl", "tr")]
    start = {"b": state((0.3, 0, 0), (1, 0, 0, 0), STILL, STILL)}
    (refusal,) = MuJoCo("tuned").plans(spatial([body], joints), start)
    assert isinstance(refusal, Refusal)
    why = f"engine: MuJoCo has no constraint that closes a loop by the {kind} t"
    assert refusal.because == f"{why}: a loop needs a ball, a hinge or a weld that is not driven"
