"""What MuJoCo's joints in space hold and what drives exert, where a line of algebra tells it."""

import math
from typing import Any

import numpy as np
import pytest
from given.engine_space import (
    LOPSIDED,
    STILL,
    G,
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

from textmech.cases.scene import Anchor, Push, Scene, Signal, Torque
from textmech.cases.scene.body import Body
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.rotation import about, angle_between, turned
from textmech.cases.trajectory import Array, Trajectory
from textmech.engines.engine import Plan, Start
from textmech.engines.mujoco import MuJoCo

LEVEL = (1.0, 0.0, 0.0, 0.0)
UP = (0.0, 0.0, 1.0)
TIMES = np.linspace(0.0, 0.5, 6)


def wrench(motion: Any, name: str) -> Array:
    """(N, 6): force and moment of a joint."""
    names = [f"{name}.{letter}{axis}" for letter in "fm" for axis in "xyz"]
    return np.column_stack([motion.reactions[name] for name in names])


def wanted(name: str) -> list[str]:
    """Both by their quantities."""
    return [f"{name}.{letter}{axis}" for letter in "fm" for axis in "xyz"]


def protocol(scene: Scene, start: Start) -> str:
    """What the tuned plan says of its start and readout."""
    (plan,) = MuJoCo("tuned").plans(scene, start)
    assert isinstance(plan, Plan)
    return plan.protocol(1e-3)


@pytest.mark.parametrize("back", [False, True])
def test_a_hinge_holds_what_is_pushed_and_twisted(back: bool) -> None:
    """MuJoCo counts pushes as done through joints: they are taken out again. Nothing moves."""
    tip, force, torque = np.array([0.1, 0.2, 0.3]), np.array([2.0, 4.0, 7.0]), np.array([1.0, 2, 0])
    body = rigid("b", 1.5, (0.02, 0.03, 0.04), {"tip": tip, "axle": (0.0, 0.0, -0.1)})
    forces = [
        Push("push", Anchor("b", "tip"), Signal("constant", vector(force))),
        Torque("twist", "b", Signal("constant", vector(torque))),
    ]
    ends = ("b.axle", "ground.O") if back else ("ground.O", "b.axle")
    pin = hinge("pin", *ends, UP)
    centre = (0.0, 0.0, 0.1)
    start = {"b": state(centre, LEVEL, STILL, STILL)}
    motion = simulated(spatial([body], [pin], forces=forces), start, TIMES, 1e-3, wanted("pin"))
    # The push goes through the axis, or the hinge would turn: tip and force are parallel in x, y.
    assert np.max(np.abs(motion.states["b"] - motion.states["b"][0])) < 1e-14
    held = -(force - (0.0, 0.0, 1.5 * G))
    moment = -(torque + np.cross(tip + centre, force))
    given = np.concatenate([held, moment]) * (-1 if back else 1)
    assert np.max(np.abs(wrench(motion, "pin") - given)) < 1e-12


def test_a_pendulum_on_a_driven_point_swings_as_on_a_fixed_one() -> None:
    """Seen from the point; and is held by the same force."""
    drift = np.array([0.3, -0.2, 0.1])
    body = rigid("b", 1.5, LOPSIDED, {"top": (0.1, 0.2, 0.3)})
    q, w = np.array(about((1.0, 2.0, 3.0), 0.7)), np.array([1.0, -2.0, 3.0])
    r, v = -turned(q, (0.1, 0.2, 0.3)), -turned(q, np.cross(w, (0.1, 0.2, 0.3)))
    pivots = {"fixed": point(STILL), "driven": point(STILL, drift)}
    found, words = {}, ""
    for name in pivots:
        start = {"b": state(r, q, v + pivots[name].velocity, w)}
        scene = spatial([body], [ball("pin", f"ground.{name}", "b.top")], points=pivots)
        found[name] = simulated(scene, start, TIMES, 1e-3, wanted("pin")[:3])
        words = protocol(scene, start)
    rows = {name: motion.states["b"] for name, motion in found.items()}
    moved = rows["driven"].copy()
    moved[:, SPACE.place] -= np.outer(TIMES, drift)
    moved[:, SPACE.velocity] -= drift
    assert np.max(np.abs(moved - rows["fixed"])) < 1e-11
    for name in wanted("pin")[:3]:
        one, other = (motion.reactions[name] for motion in found.values())
        assert np.max(np.abs(one - other)) < 1e-10
    assert "driven points are masses of 1e+15 kg" in words


@pytest.mark.parametrize("back", [False, True])
def test_a_driven_slide_and_turn_tell_force_and_torque(back: bool) -> None:
    """x = (1 − cos 3t)/3 along an axis, about which it turns at t: m ẍ along it, and J about it."""
    axis = np.array([0.6, 0.0, 0.8])
    freedoms = (Freedom.shift(vector(axis), "x"), Freedom.turn(vector(axis), "theta"))
    ends = ("b.center", "ground.O") if back else ("ground.O", "b.center")
    rail = joint("rail", "freedoms", *ends, *freedoms)
    drives = {"rail.x_dot": Signal("sine", (1.0,), 3.0), "rail.theta_dot": Signal("ramp", (2.0,))}
    scene = spatial([rigid("b", 1.5, LOPSIDED)], [rail], drives=drives)
    start = {"b": state(STILL, LEVEL, STILL, STILL)}
    names = ["rail.x_force", "rail.theta_torque"]
    motion = simulated(scene, start, TIMES, 1e-3, names)
    sign = -1 if back else 1
    x = (1 - np.cos(3 * TIMES)) / 3
    assert np.max(np.abs(motion.states["b"][:, :3] - sign * np.outer(x, axis))) < 1e-12
    assert np.max(np.abs(omega(motion, "b") - sign * 2 * np.outer(TIMES, axis))) < 1e-12
    # The engine's second part is the body, or the ground, which feels the opposite along −u.
    force = 1.5 * (3 * np.cos(3 * TIMES) + sign * G * 0.8)
    assert np.max(np.abs(motion.reactions["rail.x_force"] - force)) < 1e-10
    torque = 2 * axis @ np.array(LOPSIDED) @ axis
    assert np.max(np.abs(motion.reactions["rail.theta_torque"] - torque)) < 1e-10


@pytest.mark.parametrize("back", [False, True])
def test_a_pair_on_a_ball_joint_starts_as_given_and_keeps_its_momentum(back: bool) -> None:
    """Both turn; joint coordinates hold what one does against the other."""
    bodies = [
        rigid("front", 1.0, LOPSIDED, {"j": (0.2, 0.0, 0.0)}),
        rigid("back", 1.5, (0.03, 0.02, 0.04), {"j": (-0.2, 0.05, 0.0)}),
    ]
    ends = ("back.j", "front.j") if back else ("front.j", "back.j")
    scene = spatial(bodies, [ball("neck", *ends)], gravity=STILL)
    turns = [((1.0, 2.0, 3.0), 0.7), ((2.0, -1.0, 0.5), 1.9)]
    spins = np.array([[1.0, -2.0, 3.0], [-3.0, 1.0, 2.0]])
    q = [np.array(about(axis, angle)) for axis, angle in turns]
    arms = [np.array(body.points["j"]) for body in bodies]
    r = [-turned(*pair) for pair in zip(q, arms, strict=True)]
    v = [-turned(q[i], np.cross(spins[i], arms[i])) for i in range(2)]
    start = {body.name: state(r[i], q[i], v[i], spins[i]) for i, body in enumerate(bodies)}
    motion = simulated(scene, start, TIMES, 1e-3)
    for name, given in start.items():
        assert np.max(np.abs(motion.states[name][0] - given)) < 1e-14
    momentum, angular = momenta(motion, bodies)
    assert np.max(np.ptp(momentum, axis=0)) < 1e-10
    assert np.max(np.ptp(angular, axis=0)) < 1e-10


def momenta(motion: Trajectory, bodies: list[Body]) -> tuple[Array, Array]:
    """(N, 3) each, about the origin."""
    momentum, angular = np.zeros((2, len(motion.times), 3))
    for body in bodies:
        rows = motion.states[body.name]
        momentum += body.mass * rows[:, SPACE.velocity]
        angular += np.cross(rows[:, SPACE.place], body.mass * rows[:, SPACE.velocity])
        angular += turned(rows[:, SPACE.attitude], omega(motion, body.name) @ body.tensor)
    return momentum, angular


def test_a_free_pair_turns_by_a_drive_and_keeps_its_momentum() -> None:
    """As a cat does: without a moment from outside, with angular momentum zero throughout."""
    bodies = [
        rigid("front", 1.0, (0.02, 0.03, 0.035), {"j": (0.2, 0.0, 0.0)}),
        rigid("back", 1.5, (0.03, 0.02, 0.04), {"j": (-0.2, 0.05, 0.0)}),
    ]
    joints = [
        joint(
            "waist", "universal", "front.j", "back.j",
            Freedom.turn((0.0, 1.0, 0.0), "bend"), Freedom.turn((1.0, 0.0, 0.0), "twist"),
        )
    ]  # fmt: skip
    drives = {
        "waist.bend_dot": Signal("sine", (3.0,), 6.0),
        "waist.twist_dot": Signal("sine", (4.0,), 9.0),
    }
    scene = spatial(bodies, joints, gravity=STILL, drives=drives)
    start = {
        "front": state(STILL, LEVEL, STILL, STILL),
        "back": state((0.4, -0.05, 0.0), LEVEL, STILL, STILL),
    }
    times = np.linspace(0.0, 1.0, 11)
    motion = simulated(scene, start, times, 1e-3)
    momentum, angular = momenta(motion, bodies)
    assert np.max(np.abs(momentum)) < 1e-10
    assert np.max(np.abs(angular)) < 1e-10
    assert np.max(angle_between(motion.states["front"][:, SPACE.attitude], np.array(LEVEL))) > 0.3


def test_a_slender_bars_own_axis_has_the_least_inertia_mujoco_takes() -> None:
    """Where joints hold it, it makes no difference; and the protocol says so."""
    times = np.linspace(0.0, 1.0, 5)
    axis = (math.sin(0.3), math.cos(0.3), 0.0)
    pin: Joint = hinge("pin", "ground.O", "bar.end", axis)
    found, words = [], []
    for own in (0.0, 1e-12):
        bar = rigid("bar", 1.0, (own, 1 / 12, 1 / 12), {"end": (-0.5, 0.0, 0.0)})
        scene = spatial([bar], [pin])
        start = {"bar": state((0.5, 0.0, 0.0), LEVEL, STILL, STILL)}
        words.append(protocol(scene, start))
        found.append(simulated(scene, start, times, 1e-3).states["bar"])
    assert np.max(np.abs(found[0] - found[1])) < 1e-11
    assert words == ["bar has 1e-15 kg m² about its own axis", ""]
