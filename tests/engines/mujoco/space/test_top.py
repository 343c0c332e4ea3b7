"""MuJoCo's ball joint, gimbals and force elements against equations that are written here."""

from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from given.engine_space import (
    LOPSIDED,
    STILL,
    G,
    attitude,
    ball,
    joint,
    particle,
    point,
    rigid,
    simulated,
    spatial,
    state,
)  # fmt: skip
from scipy.integrate import solve_ivp

from textmech.cases.scene import Anchor, Damper, Push, Signal, Spring, Torque
from textmech.cases.scene.joint import Freedom
from textmech.cases.scene.rotation import angle_between, inverse, product, turned
from textmech.cases.trajectory import Array

J, MASS = np.array(LOPSIDED), 1.3
WEIGHT = np.array([0.0, 0.0, -MASS * G])
Moment = Callable[[float, Array, Array, Array, Array], tuple[Any, Any]]
"""Of t, r, q, v, ω in body axes: force in ground axes and moment about the centre in body axes."""


def flown(begun: tuple[float, ...], times: Array, acting: Moment) -> Array:
    """(N, 13) of one free body by Newton and Euler."""

    def rates(t: float, y: Array) -> Any:
        r, q, v, w = np.split(y, [3, 7, 10])
        force, moment = acting(t, r, q / np.linalg.norm(q), v, w)
        q_dot = 0.5 * product(q, np.array([0.0, *w]))
        w_dot = np.linalg.solve(J, moment - np.cross(w, J @ w))
        return np.concatenate([v, q_dot, force / MASS, w_dot])

    found = solve_ivp(rates, (0.0, times[-1]), begun, "DOP853", times, rtol=1e-12, atol=1e-13)
    return found.y.T


def apart(found: Array, given: Array) -> float:
    """The largest of all differences, of attitudes the angle."""
    turned = np.max(angle_between(found[:, 3:7], given[:, 3:7]))
    return max(float(turned), float(np.max(np.abs(np.delete(found - given, range(3, 7), axis=1)))))


Q, OMEGA = attitude((0.9, 0.2, -0.1, 0.3)), (3.0, -2.0, 25.0)
FOOT = np.array([0.02, -0.01, -0.15])


@pytest.mark.parametrize("back", [False, True])
def test_a_lopsided_top_on_a_ball_joint(back: bool) -> None:
    """Euler about the foot, and the foot's force by Newton. Reached: 1e-10, and 2e-9 of 52 N."""
    tensor = J + MASS * (FOOT @ FOOT * np.eye(3) - np.outer(FOOT, FOOT))
    times = np.linspace(0.0, 0.5, 6)

    def omega_dot(q: Array, w: Array) -> Any:
        weight = turned(inverse(q), [0.0, 0.0, -MASS * G])
        return np.linalg.solve(tensor, np.cross(-FOOT, weight) - np.cross(w, tensor @ w))

    def rates(t: float, y: Array) -> Any:
        q = y[:4] / np.linalg.norm(y[:4])
        return np.concatenate([0.5 * product(y[:4], np.array([0.0, *y[4:]])), omega_dot(q, y[4:])])

    found = solve_ivp(rates, (0.0, 0.5), (*Q, *OMEGA), "DOP853", times, rtol=1e-12, atol=1e-13)
    q, w = found.y[:4].T, found.y[4:].T
    centre = turned(q, -FOOT), turned(q, np.cross(w, -FOOT))
    begun = {"top": state(centre[0][0], Q, centre[1][0], OMEGA)}
    ends = ("top.foot", "ground.O") if back else ("ground.O", "top.foot")
    scene = spatial([rigid("top", MASS, J, {"foot": FOOT})], [ball("pivot", *ends)])
    names = [f"pivot.f{axis}" for axis in "xyz"]
    motion = simulated(scene, begun, times, 5e-4, names)
    rows = np.column_stack([centre[0], q, centre[1], w])
    assert apart(motion.states["top"], rows) < 1e-9
    w_dot = np.array([omega_dot(*pair) for pair in zip(q, w, strict=True)])
    gained = turned(q, np.cross(w_dot, -FOOT) + np.cross(w, np.cross(w, -FOOT)))
    force = MASS * (gained + np.array([0.0, 0.0, G]))
    felt = np.column_stack([motion.reactions[name] for name in names])
    assert np.max(np.abs(felt * (-1 if back else 1) - force)) < 2e-8


def test_a_gyroscope_in_gimbals_is_a_free_body() -> None:
    """Massless gimbals about the centre hold nothing: the rotor turns as without them.

    Of order 4 (2e-9 at half the step), for MuJoCo integrates angles and Euler's equations do not.
    """
    times = np.linspace(0.0, 0.5, 6)
    turns = [Freedom.turn(axis, name) for axis, name in _GIMBALS]
    scene = spatial([rigid("rotor", MASS, J)], [joint("mount", "freedoms", *_ENDS, *turns)])
    begun = state(STILL, attitude((0.7, 0.6, -0.1, 0.2)), STILL, (1.0, 2.0, 20.0))
    names = ["mount.fz", *(f"mount.m{axis}" for axis in "xyz")]
    motion = simulated(scene, {"rotor": begun}, times, 5e-4, names)
    given = flown(begun, times, lambda t, r, q, v, w: (np.zeros(3), np.zeros(3)))
    assert apart(motion.states["rotor"], given) < 1e-7
    assert np.max(np.abs(motion.reactions["mount.fz"] - MASS * G)) < 1e-10
    assert max(np.max(np.abs(motion.reactions[name])) for name in names[1:]) < 1e-9


_ENDS = ("ground.O", "rotor.center")
_GIMBALS = (
    ((0.0, 0.0, 1.0), "outer"), ((0.8, 0.6, 0.0), "inner"), ((0.0, 0.0, 1.0), "spin"),
)  # fmt: skip


_AXES = [(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.6, 0.8)]
SHIFTS = [Freedom.shift(axis, name) for axis, name in zip(_AXES, "xyz", strict=True)]
TURNS = [Freedom.turn(axis, name) for axis, name in _GIMBALS]


@pytest.mark.parametrize("back", [False, True])
@pytest.mark.parametrize("turns", [TURNS, [Freedom("ball")]], ids=["gimbals", "ball"])
def test_a_joint_that_leaves_everything_holds_nothing(turns: list[Freedom], back: bool) -> None:
    """Whichever part it names first: the other order undoes the freedoms from the last one on."""
    times, at = np.linspace(0.0, 0.3, 4), (0.1, 0.2, -0.1)
    ends = ("top.tip", "ground.O") if back else ("ground.O", "top.tip")
    scene = spatial(
        [rigid("top", MASS, J, {"tip": at})], [joint("loose", "freedoms", *ends, *SHIFTS, *turns)]
    )
    q = attitude((0.7, 0.6, -0.1, 0.2))
    begun = state((0.3, -0.2, 0.5), q, (1.0, 2.0, -1.0), (1.0, -2.0, 3.0))
    names = [f"loose.{letter}{axis}" for letter in "fm" for axis in "xyz"]
    motion = simulated(scene, {"top": begun}, times, 5e-4, names)
    given = flown(begun, times, lambda t, r, q, v, w: (WEIGHT, np.zeros(3)))
    assert apart(motion.states["top"], given) < 1e-9
    assert max(np.max(np.abs(values)) for values in motion.reactions.values()) < 1e-9


@pytest.mark.slow
def test_pushes_and_torques_keep_the_axes_of_the_ground() -> None:
    times = np.linspace(0.0, 1.0, 5)
    at = np.array([0.1, -0.2, 0.05])
    push, torque = np.array([1.0, -2.0, 3.0]), np.array([0.3, 0.1, -0.2])
    scene = spatial(
        [rigid("top", MASS, J, {"tip": at})],
        forces=[
            Push("push", Anchor("top", "tip"), Signal("sine", tuple(push.tolist()), 4.0, 0.3)),
            Torque("twist", "top", Signal("ramp", tuple(torque.tolist()))),
        ],
    )

    def acting(t: float, r: Array, q: Array, v: Array, w: Array) -> tuple[Any, Any]:
        force, back = push * np.sin(4.0 * t + 0.3), inverse(q)
        moment = np.cross(at, turned(back, force)) + turned(back, torque * t)
        return force + WEIGHT, moment

    begun = state(STILL, Q, STILL, (1.0, 2.0, 3.0))
    found = simulated(scene, {"top": begun}, times, 1e-3).states["top"]
    assert apart(found, flown(begun, times, acting)) < 1e-9


@pytest.mark.slow
def test_a_spring_and_a_damper_pull_along_their_line() -> None:
    """Against a driven point, which moves on as it is told. Of order 4: 1e-9 at half the step."""
    times = np.linspace(0.0, 1.0, 5)
    at, hook = np.array([0.1, -0.2, 0.05]), np.array([0.3, 0.2, 1.0])
    drift = np.array([0.1, -0.3, 0.2])
    ends = Anchor("top", "tip"), Anchor("ground", "H")
    scene = spatial(
        [rigid("top", MASS, J, {"tip": at})],
        forces=[Spring("spring", *ends, 40.0, 0.5), Damper("damper", *ends, 2.0)],
        points={"H": point(hook, drift)},
    )

    def acting(t: float, r: Array, q: Array, v: Array, w: Array) -> tuple[Any, Any]:
        d = hook + drift * t - r - turned(q, at)
        d_dot = drift - v - turned(q, np.cross(w, at))
        length = np.linalg.norm(d)
        force = (40.0 * (length - 0.5) + 2.0 * (d @ d_dot) / length) * d / length
        return force + WEIGHT, np.cross(at, turned(inverse(q), force))

    begun = state(STILL, Q, STILL, (1.0, 2.0, 3.0))
    found = simulated(scene, {"top": begun}, times, 1e-3).states["top"]
    assert apart(found, flown(begun, times, acting)) < 5e-8


def test_what_hangs_on_a_particle_hangs_freely() -> None:
    """A joint holds no axes of a particle: a bob between two bodies is a ball joint to both."""
    bodies = [rigid("top", MASS, J, {"foot": FOOT}), particle("bob", 0.5)]
    joints = [
        ball("pivot", "ground.O", "top.foot"),
        joint("hold", "weld", "top.center", "bob.center"),
    ]
    q, w = np.array(Q), np.array([1.0, 2.0, 3.0])
    r, v = turned(q, -FOOT), turned(q, np.cross(w, -FOOT))
    begun = {"top": state(r, q, v, w), "bob": state(r, (1, 0, 0, 0), v, STILL)}
    times = np.linspace(0.0, 0.3, 4)
    names = [f"hold.f{axis}" for axis in "xyz"]
    motion = simulated(spatial(bodies, joints), begun, times, 1e-3, names)
    heavier = rigid("top", MASS + 0.5, J, {"foot": FOOT})
    alone = simulated(spatial([heavier], joints[:1]), {"top": begun["top"]}, times, 1e-3)
    assert apart(motion.states["top"], alone.states["top"]) < 1e-12
    assert np.max(np.abs((motion.states["top"] - motion.states["bob"])[:, :3])) < 1e-14
