"""What rolls on MuJoCo's floor without slip: a sphere, a coin that leans, an upright wheel."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from typing import Any

import mujoco
import numpy as np
import pytest
from given.engine_space import (
    STILL,
    G,
    attitude,
    joint,
    simulated,
    spatial,
    state,
    vector,
)  # fmt: skip
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation

from textmech.cases.scene import Anchor, Signal
from textmech.cases.scene.body import Body
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.rotation import about, angle_between, inverse, product, turned
from textmech.cases.trajectory import Array
from textmech.engines.engine import Plan, Start
from textmech.engines.mujoco import MuJoCo

CENTRE = {"center": STILL}
TIMES = np.linspace(0.0, 0.5, 6)
FELT = ["touch.fx", "touch.fy", "touch.normal"]
UP = np.array([0.0, 0.0, 1.0])


def felt(motion: Any) -> Array:
    """(N, 3) the floor's force."""
    return np.column_stack([motion.reactions[name] for name in FELT])


R, M = 0.2, 1.5
J = 0.4 * M * R * R
SPHERE = Body("ball", "sphere", M, (J, J, J, 0.0, 0.0, 0.0), CENTRE, R, frame=SPACE)
SLOPE = np.array([0.3 * 0.8, 0.3 * 0.6, -0.95]) * G


def test_a_sphere_rolls_obliquely_down_an_incline() -> None:
    """5/7 of g along the floor, 2/7 of it by friction. Reached: 2e-9 m, 1e-7 N; at 1e-4 5e-11 m."""
    touch = spatial_contact("touch", Anchor("ball", "center"), 0.6, rim=False)
    scene = spatial([SPHERE], contacts=[touch], gravity=vector(SLOPE))
    v, q = np.array([0.3, -0.4, 0.0]), attitude((0.5, -0.3, 0.2, 0.7))
    begun = state((0.1, 0.2, R), q, v, turned(inverse(np.array(q)), np.cross(UP, v) / R))
    motion = simulated(scene, {"ball": begun}, TIMES, 1e-3, FELT)
    places = np.array([0.1, 0.2]) + v[:2] * TIMES[:, None] + np.outer(TIMES**2, SLOPE[:2]) * 5 / 14
    assert np.max(np.abs(motion.states["ball"][:, :2] - places)) < 1e-8
    force = -M * SLOPE * (2 / 7, 2 / 7, 1)
    assert np.max(np.abs(felt(motion) - force)[:, :2]) < 1e-6
    assert np.max(np.abs(felt(motion) - force)[:, 2]) < 1e-8
    around = Motion(scene.bodies, scene.points, motion)
    assert np.max(touch.observe(around, "slip")) < 1e-7
    assert np.max(np.abs(touch.observe(around, "gap"))) < 1e-8


RIM, MASS = 0.1, 0.3
A, C = MASS * RIM**2 / 4, MASS * RIM**2 / 2
COIN = Body(
    "coin", "disk", MASS, (A, A, C, 0.0, 0.0, 0.0), CENTRE, RIM, (0.0, 0.0, 1.0), frame=SPACE
)
ROLLS = spatial_contact("touch", Anchor("coin", "center"), 5.0, rim=True)
LEANING = spatial([COIN], contacts=[ROLLS])


def circling(lean: float, turning: float) -> tuple[Start, Any]:
    """A coin whose axle stands at an angle to the vertical, and which goes round at a rate.

    All turns about the vertical: Newton about the centre and Euler about the moving axes give the
    spin. The answer: places and forces (N, 3), and attitudes (N, 4), at times.
    """
    axle = np.array([math.sin(lean), 0.0, math.cos(lean)])
    steep = np.array([-math.cos(lean), 0.0, math.sin(lean)])
    arm, precession = -RIM * steep, turning * UP

    def round_(spin: float) -> tuple[float, Array, Array, Array]:
        omega = precession + spin * axle
        v = -np.cross(omega, arm)
        force = MASS * (np.cross(precession, v) + G * UP)
        L = A * omega + (C - A) * (omega @ axle) * axle
        return (np.cross(precession, L) - np.cross(arm, force))[1], omega, v, force

    spin = float(brentq(lambda spin: round_(spin)[0], -200.0, 200.0, xtol=1e-14))
    _, omega, v, force = round_(spin)
    axes = np.column_stack([-steep, np.cross(axle, -steep), axle])
    first = Rotation.from_matrix(axes)

    def exact(times: Array) -> tuple[Array, Array, Array]:
        turns = [Rotation.from_rotvec(turning * t * UP) for t in times]
        hub = np.cross(UP, v) / turning  # ω_p × (r − hub) = v
        forces = np.array([turn.apply(force) for turn in turns])
        places = np.array([hub - turn.apply(hub) for turn in turns])
        spun = [
            (turn * Rotation.from_rotvec(spin * t * axle) * first).as_quat(scalar_first=True)
            for turn, t in zip(turns, times, strict=True)
        ]
        return places, np.array(spun), forces

    return {"coin": state(-arm * UP, first.as_quat(scalar_first=True), v, axes.T @ omega)}, exact


def limit(rungs: list[Array]) -> Array:
    """Romberg's, of three steps that halve, with exponents 1, 2."""
    coarse, middle, fine = rungs
    return (4 * (2 * fine - middle) - (2 * middle - coarse)) / 3


@pytest.mark.slow
@pytest.mark.parametrize(
    ("lean", "turning", "seconds", "reached"),
    [(82.0, 2.0, 0.4, 1e-8), (60.0, 6.0, 0.4, 3e-8), (20.0, -14.0, 0.2, 5e-7)],
)
def test_a_coin_on_a_steady_circle(
    lean: float, turning: float, seconds: float, reached: float
) -> None:
    """Of first order, as MuJoCo's contact leaves out J̇ v, and of second, as it gives way; the
    limit is the textbook's.

    At 1e-4: 2e-6, 7e-6 and 1e-4 m; limits from (4, 2, 1)e-4 6e-9, 2e-8 and 2e-7 m. N is right
    to 4e-6, 1e-5 and 4e-4 of 3 N from the first sample on, for the start creeps.
    """
    start, exact = circling(math.radians(lean), turning)
    times = np.linspace(0.0, seconds, 5)
    places, attitudes, forces = exact(times)
    rungs = []
    for step in (4e-4, 2e-4, 1e-4):
        motion = simulated(LEANING, start, times, step, FELT)
        rungs.append(motion.states["coin"])
    off = np.max(np.abs(rungs[-1][:, :2] - places[:, :2]))
    assert np.max(np.abs(limit(rungs)[:, :2] - places[:, :2])) < reached
    assert np.max(angle_between(limit(rungs)[:, 3:7], attitudes)) < 10 * reached
    assert 0.8 < math.log2(np.max(np.abs(rungs[-2][:, :2] - places[:, :2])) / off) < 2.1
    assert off < 1e3 * reached
    assert np.max(np.abs(felt(motion) - forces)[:, 2]) < 1e4 * reached


def test_a_coin_starts_as_the_floor_carries_it() -> None:
    """Right on the floor it would fall, and its friction would be off by m J̇ v until it creeps."""
    start, exact = circling(math.radians(60.0), 6.0)
    once = np.zeros(1)
    _, _, forces = exact(once)
    motion = simulated(LEANING, start, once, 1e-3, FELT)
    assert np.max(np.abs(felt(motion) - forces)) < 1e-3
    (plan,) = MuJoCo("tuned").plans(LEANING, start)
    assert isinstance(plan, Plan)
    assert plan.held == plan.following == (1, 2)
    words = plan.protocol(1e-3)
    assert words.startswith("coin started ")
    assert "creeping" in words
    shipped = simulated(LEANING, start, once, 1e-3, FELT, setting="shipped")
    assert np.max(np.abs(felt(shipped) - forces)) > 1.0


WHEEL = Body(
    "wheel",
    "disk",
    1.3,
    (0.02, 0.04, 0.02, 0.0, 0.0, 0.0),
    CENTRE,
    0.3,
    (0.0, 1.0, 0.0),
    frame=SPACE,
)
UPRIGHT = joint(
    "upright", "freedoms", "ground.O", "wheel.center",
    *(Freedom.shift(vector(axis), name) for axis, name in zip(np.eye(3), "xyz", strict=True)),
    Freedom.turn((0.0, 0.0, 1.0), "theta"), Freedom.turn((0.0, 1.0, 0.0), "phi"),
)  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("driven", [False, True])
def test_an_upright_wheel_rolls_in_a_circle(driven: bool) -> None:
    """Freely, or with both rates prescribed, which takes no torque.

    Of first order: 4e-4 m at 4e-4; limit 8e-10 m. The couple that holds it upright turns the spin
    about the vertical, and keeps the side force from tilting it.
    """
    theta, rate, spin = 0.4, 1.5, 5.0
    q = product(np.array(about((0.0, 0.0, 1.0), theta)), np.array(about((0.0, 1.0, 0.0), 0.1)))
    ahead = np.array([math.cos(theta), math.sin(theta), 0.0])
    w = turned(inverse(q), rate * UP) + np.array([0.0, spin, 0.0])
    start = {"wheel": state((0.0, 0.0, 0.3), q, 0.3 * spin * ahead, w)}
    rates = {"theta_dot": (rate,), "phi_dot": (spin,)}
    drives = {f"upright.{k}": Signal("constant", v) for k, v in rates.items()} if driven else {}
    touch = spatial_contact("touch", Anchor("wheel", "center"), 5.0, rim=True)
    scene = spatial([WHEEL], [UPRIGHT], contacts=[touch], drives=drives)
    efforts = ["upright.theta_torque", "upright.phi_torque"] if driven else []
    names = [*FELT, "upright.mx", "upright.my", *efforts]
    rungs = []
    for step in (4e-4, 2e-4, 1e-4):
        motion = simulated(scene, start, TIMES, step, names)
        rungs.append(motion.states["wheel"])
    heading = theta + rate * TIMES
    radius, side = 0.3 * spin / rate, 1.3 * 0.3 * spin * rate
    places = radius * np.column_stack(
        [np.sin(heading) - math.sin(theta), math.cos(theta) - np.cos(heading)]
    )
    assert np.max(np.abs(limit(rungs)[:, :2] - places)) < 2e-9
    assert np.max(np.abs(felt(motion)[:, 2] - 1.3 * G)) < 1e-8
    left = np.column_stack([-np.sin(heading), np.cos(heading)])
    assert np.max(np.abs(felt(motion)[:, :2] - side * left)) < 1e-3  # of 3 N
    couple = 0.3 * side + 0.04 * spin * rate
    held = np.column_stack([motion.reactions[f"upright.m{a}"] for a in "xy"])
    along = np.column_stack([np.cos(heading), np.sin(heading)])
    assert np.max(np.abs(np.sum(held * along, axis=1) + couple)) < 1e-3
    for name in efforts:
        assert np.max(np.abs(motion.reactions[name])) < 1e-3


def test_every_step_is_kept_with_the_floors_forces() -> None:
    """The record's states are the samples, bit for bit; its forces, found from another guess of
    MuJoCo's solver, those that are read later."""
    start, _ = circling(math.radians(60.0), 6.0)
    times = np.array([0.0, 0.01, 0.02])
    motion = simulated(LEANING, start, times, 1e-3, FELT, record=True)
    record = motion.record
    assert record is not None
    assert len(record.times) == 21
    assert np.array_equal(record.states["coin"][::10], motion.states["coin"])
    assert np.allclose(felt(record)[::10], felt(motion), rtol=0, atol=1e-7)
    alone = simulated(LEANING, start, times, 1e-3, FELT)
    assert np.array_equal(alone.states["coin"], motion.states["coin"])


def test_the_script_starts_where_the_run_does() -> None:
    start, _ = circling(math.radians(60.0), 6.0)
    engine = MuJoCo("tuned")
    (plan,) = engine.plans(LEANING, start)
    assert isinstance(plan, Plan)
    model = mujoco.MjModel.from_xml_string(engine.script(LEANING, start, 1e-3, plan))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    first = data.qpos[2]
    mujoco.mj_step(model, data, 20)
    rows = simulated(LEANING, start, np.array([0.0, 0.02]), 1e-3).states["coin"]
    assert (first, data.qpos[0]) == (rows[0, 2], rows[1, 0])
    assert first < start["coin"][2]
