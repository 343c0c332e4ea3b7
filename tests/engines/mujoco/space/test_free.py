"""MuJoCo's free bodies in space: Euler's equations, and what the audit reads back."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from typing import Any

import mujoco
import numpy as np
import pytest
from given.adapters.engine_space import (
    LOPSIDED,
    attitude,
    hinge,
    particle,
    rigid,
    simulated,
    spatial,
    state,
)
from scipy.integrate import solve_ivp

from textmech.cases.scene import rotation
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.rotation import angle_between, inverse, product
from textmech.cases.trajectory import Array
from textmech.engines.engine import Plan
from textmech.engines.mujoco import MuJoCo
from textmech.engines.mujoco.model import start
from textmech.engines.mujoco.model.scene import principal
from textmech.engines.mujoco.read import poses

TIMES = np.linspace(0.0, 2.0, 11)
BODY = rigid("top", 1.3, LOPSIDED)
SCENE = spatial([BODY], gravity=(0.0, 0.0, 0.0))
Q, OMEGA = attitude((0.5, -0.3, 0.2, 0.7)), (3.0, -2.0, 4.0)
R, V = (1.0, 2.0, 3.0), (0.1, 0.2, 0.3)
START = {"top": state(R, Q, V, OMEGA)}


@pytest.fixture(scope="module")
def euler() -> Array:
    """(2.33) without a moment: quaternion and ω at the samples, (N, 7)."""
    J = np.array(LOPSIDED)

    def rates(t: float, y: Array) -> Any:
        q, w = y[:4], y[4:]
        q_dot = 0.5 * product(q, np.array([0.0, *w]))
        return np.concatenate([q_dot, np.linalg.solve(J, -np.cross(w, J @ w))])

    found = solve_ivp(
        rates, (0.0, TIMES[-1]), (*Q, *OMEGA), "DOP853", TIMES, rtol=1e-13, atol=1e-14
    )
    return found.y.T


def off(euler: Array, step: float = 1e-3) -> tuple[float, float, float]:
    """By how much attitude [rad], ω [rad/s] and place [m] miss Euler and Newton."""
    rows = simulated(SCENE, START, TIMES, step).states["top"]
    turned = angle_between(rows[:, SPACE.attitude], euler[:, :4])
    places = np.array(R) + np.array(V) * TIMES[:, None]
    return (
        float(np.max(turned)),
        float(np.max(np.abs(rows[:, SPACE.spin] - euler[:, 4:]))),
        float(np.max(np.abs(rows[:, SPACE.place] - places))),
    )


def test_a_free_body_turns_as_euler_has_it(euler: Array) -> None:
    """RK4, order 4. Reached: 3e-12 rad, 1e-12 rad/s and 4e-13 m, the sum of rounding."""
    assert max(off(euler)) < 1e-11


def test_the_sign_of_a_quaternion_goes_on_from_the_start() -> None:
    """A hinge's angle tells only one of both; a start may have the other."""
    axle = hinge("axle", "ground.O", "top.center", (0.0, 0.0, 1.0))
    scene = spatial([BODY], [axle])
    turns = np.array([math.cos(0.5), 0.0, 0.0, math.sin(0.5)])
    times = np.linspace(0.0, 2.0, 41)
    for sign in (1.0, -1.0):
        begun = {"top": state((0, 0, 0), sign * turns, (0, 0, 0), (0.0, 0.0, 9.0))}
        q = simulated(scene, begun, times, 1e-2).states["top"][:, SPACE.attitude]
        assert np.max(np.abs(q[0] - sign * turns)) < 1e-15
        assert np.min(np.sum(q[1:] * q[:-1], axis=1)) > 0.9


_SPIN = SPACE.spin


def _ground_axes_out(*args: Any) -> Any:
    found = read_before(*args)
    for rows in found.values():
        rows[:, _SPIN] = rotation.turned(rows[:, SPACE.attitude], rows[:, _SPIN])
    return found


def _ground_axes_in(*args: Any) -> Any:
    (q, (*v, a, b, c)) = free_before(*args)
    turned = rotation.turned(np.array(q[3:]), np.array([a, b, c]))
    return q, [*v, *turned.tolist()]


free_before, read_before = start._free, poses._in_space


def _back(tensor: Array) -> Any:
    moments, axes = principal(tensor)
    assert axes is not None
    return moments, tuple(inverse(np.array(axes)).tolist())


def _turned_back(*args: Any) -> Any:
    q, v = free_before(*args)
    return [*q[:3], *inverse(np.array(q[3:])).tolist()], v


@pytest.mark.mutant(
    "ω read in ground axes",
    "ω started in ground axes",
    "attitude transposed at the start",
    "J turned back from its principal axes",
)
@pytest.mark.parametrize(
    ("place", "wrong"),
    [
        ("read.poses._in_space", _ground_axes_out),
        ("model.start._free", _ground_axes_in),
        ("model.start._free", _turned_back),
        ("model.scene.principal", _back),
    ],
    ids=["ω read in ground axes", "ω started in ground axes", "R transposed", "J turned back"],
)  # fmt: skip
def test_a_wrong_convention_is_seen(
    monkeypatch: pytest.MonkeyPatch, euler: Array, place: str, wrong: Any
) -> None:
    monkeypatch.setattr(f"textmech.engines.mujoco.{place}", wrong)
    assert max(off(euler)) > 0.1


def test_the_audit_reads_the_tensor_back() -> None:
    """And kinetic energy and momentum, in which ω's axes count."""
    found = MuJoCo("tuned").measure(SCENE, START)
    for name, number in BODY.numbers().items():
        assert abs(found[f"top.{name}"] - number) < 1e-15
    w, J = np.array(OMEGA), np.array(LOPSIDED)
    assert abs(found["energy.kinetic"] - 0.5 * (w @ J @ w + 1.3 * np.dot(V, V))) < 1e-14
    assert np.allclose([found[f"momentum.{a}"] for a in "xyz"], 1.3 * np.array(V), atol=1e-15)
    assert [found[f"gravity.{a}"] for a in "xyz"] == [0.0, 0.0, 0.0]


@pytest.mark.slow
def test_thin_disks_and_bars_compile_in_any_attitude() -> None:
    """MuJoCo's `fullinertia` refuses a third of these disks, and a bar below 2e-14 kg m²."""
    random = np.random.default_rng(1)
    for moments in ((1.0, 1.0, 2.0), (1.0, 0.0, 1.0), (0.3, 0.4, 0.7)):
        for size in 10.0 ** random.uniform(-6, 2, 30):
            axes, _ = np.linalg.qr(random.normal(size=(3, 3)))
            axes *= np.linalg.det(axes)
            tensor = size * axes @ np.diag(moments) @ axes.T
            found = MuJoCo("tuned").measure(
                spatial([rigid("part", 1.0, tensor)]), {"part": START["top"]}
            )
            read = [found[f"part.inertia_{ik}"] for ik in ("11", "22", "33", "12", "13", "23")]
            given = [tensor[at] for at in ((0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2))]
            assert np.max(np.abs(np.array(read) - given)) < 1e-14 * size + 2e-15


def test_an_impossible_tensor_is_refused_by_mujoco() -> None:
    (refusal,) = MuJoCo("tuned").plans(
        spatial([rigid("b", 1.0, (1.0, 1.0, 2.1))]), {"b": START["top"]}
    )
    assert not isinstance(refusal, Plan)
    assert refusal.because.startswith("engine: MuJoCo does not take the scene")
    assert "inertia" in refusal.because


def test_a_particle_flies_a_parabola() -> None:
    """It has no attitude: its state holds the ground's axes."""
    scene_ = spatial([particle("bob", 0.7)], gravity=(1.0, -2.0, -3.0))
    times = np.linspace(0.0, 1.0, 3)
    begun = {"bob": state(R, (1, 0, 0, 0), V, (0, 0, 0))}
    rows = simulated(scene_, begun, times, 1e-2).states["bob"]
    places = np.array(R) + np.array(V) * times[:, None] + np.outer(times**2 / 2, [1, -2, -3])
    assert np.max(np.abs(rows[:, :3] - places)) < 1e-13
    assert np.array_equal(rows[:, 3:7], np.tile([1.0, 0, 0, 0], (3, 1)))


@pytest.mark.parametrize("setting", ["shipped", "tuned"])
def test_the_script_is_the_scene(setting: str) -> None:
    """Pasted, stepped by MuJoCo alone, it moves as the run does; its title is a comment."""
    engine = MuJoCo(setting)
    (plan,) = engine.plans(SCENE, START)
    assert isinstance(plan, Plan)
    text = engine.script(SCENE, START, 1e-3, plan, title="a --> b")
    model = mujoco.MjModel.from_xml_string(text)
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    mujoco.mj_step(model, data, 200)
    mujoco.mj_kinematics(model, data)
    rows = simulated(SCENE, START, np.array([0.0, 0.2]), 1e-3, setting=setting).states["top"]
    assert np.array_equal(data.xpos[1], rows[1, SPACE.place])
    assert math.isclose(abs(float(data.xquat[1] @ rows[1, SPACE.attitude])), 1.0, abs_tol=1e-15)


def test_shipped_is_of_first_order(euler: Array) -> None:
    """Euler's step: an error that halves with the step; the plan says so."""
    (plan,) = MuJoCo("shipped").plans(SCENE, START)
    assert isinstance(plan, Plan)
    assert plan.held == (1, 2)
    errors = []
    for step in (2e-3, 1e-3, 5e-4):
        rows = simulated(SCENE, START, TIMES, step, setting="shipped").states["top"]
        errors.append(np.max(angle_between(rows[:, SPACE.attitude], euler[:, :4])))
    assert 0.8 < math.log2(errors[1] / errors[2]) < 1.2
