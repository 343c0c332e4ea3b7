"""MuJoCo's floor: how it settles, what keeps blocks from creeping, and the damper of a bounce."""

# MuJoCo's bindings are compiled and have no stubs.
# pyright: reportAttributeAccessIssue=false

import math
from dataclasses import replace
from pathlib import Path

import mujoco
import numpy as np
import pytest
from given import scenes
from given.adapters.engine_scenes import (  # fmt: skip
    BLOCK,
    RESTS,
    ROLLS,
    WHEEL,
    G,
    incline,
    launched,
    machine,
    touching,
)
from given.adapters.planning import SHIPPED, TUNED, begun, every, moved, planned
from scipy.integrate import solve_ivp

from textmech.cases.scene import Anchor, Push, Signal
from textmech.cases.scene.shape import rigid
from textmech.cases.trajectory import ANGLE, VX, VY, Array
from textmech.engines.mujoco.adapter.compilation import placed
from textmech.engines.mujoco.callbacks import settle
from textmech.engines.mujoco.model.bounce import damping_ratio, springy
from textmech.engines.mujoco.model.limit import BEAT as OF_STOPS
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import first


def test_a_disk_is_started_as_deep_as_it_is_carried() -> None:
    """Where it neither falls nor rises; the audit sees it before."""
    push = Push("push", Anchor("wheel", "center"), Signal("sine", (0.0, -30.0), 5.0, math.pi / 2))
    scene = machine([replace(WHEEL, mass=1.0)], contacts=[ROLLS], forces=[push])
    begin = launched(0.0)
    assert "in the floor" in planned(TUNED["mujoco"], scene, begin).protocol(1e-4)
    assert not planned(SHIPPED["mujoco"], scene, begin).protocol(1e-4)
    assert TUNED["mujoco"].measure(scene, begin)["momentum.y"] == 0.0


def test_noslip_needs_the_way_out_of_the_plane(monkeypatch: pytest.MonkeyPatch) -> None:
    scene = incline(BLOCK, touching("block", 0.4), slope=math.radians(15))

    def speed() -> float:
        run = moved(TUNED["mujoco"], scene, RESTS, np.linspace(0.0, 0.2, 21), 1e-4, record=True)
        return abs(every(run).states["block"][-1, VX])

    still = speed()
    monkeypatch.setattr(
        "textmech.engines.mujoco.model.scene._leaves_plane", lambda scene, numbers: False
    )
    assert still <= 1e-15 < 1e-9 <= speed()


@pytest.mark.parametrize("bounce", [1.0, 0.9, 0.3, 0.14, 0.13, 0.02])
def test_damper_throws_back(bounce: float) -> None:
    ratio = damping_ratio(bounce)

    def leaves(t: float, y: Array) -> float:
        return y[0] + 2 * ratio * y[1] if t else 1.0

    leaves.terminal = True  # type: ignore[attr-defined]
    leaves.direction = -1  # type: ignore[attr-defined]
    solution = solve_ivp(
        lambda t, y: [y[1], -y[0] - 2 * ratio * y[1]],
        (0, 100), [0.0, 1.0], events=leaves, rtol=1e-10, atol=1e-12,
    )  # fmt: skip
    assert -solution.y[1, -1] == pytest.approx(bounce, abs=1e-6)


@pytest.mark.mutant("a start's creep let go where rounding alone is left of its slip")
def test_what_friction_holds_is_held_whatever_rounding_says(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """At any step: at 10 µs rounding leaves 1e-6 m/s²."""
    scene, start = begun("leaning_ladder.above")
    plan = planned(TUNED["mujoco"], scene, start)

    def creep(step: float) -> float:
        return placed(scene, start, step, plan, settles=True)[2]["foot"][1]

    assert creep(1e-5) == pytest.approx(creep(1e-3) / 100, rel=1e-4)
    monkeypatch.setattr(settle, "HELD", 0.0)
    assert creep(1e-5) == 0.0


def settled(name: str, step: float) -> Array:
    """Depths and creeps by a plan whose numbers are held at 4 ms."""
    scene, start = begun(name)
    plan = planned(TUNED["mujoco"], scene, start).held_at(4e-3)
    return np.array([*placed(scene, start, step, plan, settles=True)[2].values()])


@pytest.mark.parametrize("name", ["stacked_blocks.thrown", "rimless_wheel", "tilting_disk.circle"])
def test_numbers_that_are_held_settle_alike_at_any_step(name: str) -> None:
    np.testing.assert_allclose(settled(name, 2.5e-4), settled(name, 4e-3), rtol=1e-2, atol=1e-6)


@pytest.mark.mutant("a start whose first guess does not carry on numbers of another step")
def test_a_first_guess_that_does_not_carry_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(settle, "DEEPEST", 0.0)
    assert not settled("rimless_wheel", 2.5e-4).any()


@pytest.mark.slow
@pytest.mark.parametrize("points", [2, 4, 6])
def test_a_block_lands_flat_on_several_points_and_lies(points: int) -> None:
    """Their dampers add up: six, each as strong as one alone, throw it back by 0.7 m/s of 2.4."""
    feet = {f"P{i}": (x, -0.1) for i, x in enumerate(np.linspace(-0.4, 0.4, points).tolist())}
    box = rigid(name="box", mass=2.0, inertia=0.1, points=feet)
    scene = incline(box, *[touching("box", 2.0, point=foot) for foot in feet])
    times, start = np.linspace(0.0, 1.0, 11), {"box": (0.0, 0.4, 0.0, 0.5, 0.0, 0.0)}
    wanted = tuple(f"touch_{foot}.normal" for foot in feet)
    run = moved(TUNED["mujoco"], scene, start, times, 1e-4, reactions=wanted, record=True)  # type: ignore[arg-type]
    assert every(run).states["box"][:, VY].max() < 0.12  # measured 0.042
    _, y, angle, *rates = run.states["box"][-1]
    assert (y, angle) == pytest.approx((0.1, 0.0), abs=5 * 1e-4)
    assert rates == pytest.approx([0.0] * 3, abs=1e-4)
    assert sum(run.reactions[each][-1] for each in wanted) == pytest.approx(2 * G, abs=1e-3)


# What is said of MuJoCo's bounces: how much of the speed they keep, wherever in a step.


H = 1e-4  # s
V = 2.0  # m/s
BALL = """\
<mujoco>
<option timestep="{h}" integrator="RK4" jacobian="dense" tolerance="1e-14" gravity="0 0 0">
<flag diagexact="enable"/></option>
<worldbody><geom name="wall" type="plane" size="0 0 1" zaxis="-1 0 0"/>
<body><joint type="slide" axis="1 0 0"/><inertial pos="0 0 0" mass="1.3" diaginertia="1 1 1"/>
<geom name="ball" size="0.1"/></body></worldbody>
<contact><pair geom1="wall" geom2="ball" condim="1" solimp="1.01e-4 1.01e-4 1e-3"
solref="{solref}"/></contact>
</mujoco>"""


def kept(e: float, beat: float) -> Array:
    """(40,) of the speed, where the ball meets the wall all over a step."""
    _, b, _ = springy(e, beat)
    text = BALL.format(h=H, solref=f"{-((beat / H) ** 2)} {-b / H}")
    model = mujoco.MjModel.from_xml_string(text)
    data, speeds = mujoco.MjData(model), []
    for part in np.arange(40) / 40:
        mujoco.mj_resetData(model, data)
        data.qpos[0], data.qvel[0] = -0.1 - (10 + part) * V * H, V
        mujoco.mj_step(model, data, 20 + math.ceil(4 * math.pi / beat))
        speeds.append(-data.qvel[0] / V)
    return np.array(speeds)


@pytest.mark.parametrize("beat", [0.2, OF_STOPS])
@pytest.mark.parametrize("e", [1.0, 0.9, 0.8, 0.5, 0.3, 0.1])
def test_it_keeps_as_much_as_is_said(e: float, beat: float) -> None:
    """About, of what is a rule of thumb: 0.85 to 1.3 of it was measured."""
    because = springy(e, beat)[2]
    said = float(because.partition("about ")[2].partition(" %")[0])
    share = kept(e, beat) / e - 1
    off = 100 * np.max(np.abs(share))
    assert np.mean(share) == pytest.approx(0.0, abs=0.15 * off + 1e-4)
    assert 0.7 * said < off < 1.5 * said


# What touches two planes and slides on both from rest: a start that friction cannot hold.


LADDER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {l: {bar: {mass: 5, length: 2}}}
  contacts:
    f: {between: [l.start, ground.floor], friction: 0.1}
    w: {between: [l.end, ground.wall], friction: 0.2}
initial: {l: {on: [start, end], angle: 120 deg}}
allow: {l.angle: 1.0e-2, w.normal: 1}
"""
DISK = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {l: {disk: {mass: 2, radius: 0.2}}}
  contacts:
    f: {between: [l, ground.floor], friction: 0.2}
    w: {between: [l, ground.wall], friction: 0.3}
  forces: {m: {torque: l, constant: 2}}
initial: {l: {x: 0.2, y: 0.2}}
allow: {l.angle: 1.0e-2, w.normal: 1}
"""


def off(folder: Path, text: str) -> tuple[float, float]:
    """rad of its angle, and N of the wall's force, at 0.1 ms."""
    case = scenes.typed(folder, text, tail=scenes.tail(0.4, 21))
    motion = solve(case)
    assert motion.holds
    known = motion.trajectory
    found = moved(
        TUNED["mujoco"], case.scene, first(known), case.times, 1e-4, reactions=("w.normal",)
    )
    turned = found.states["l"][:, ANGLE] - known.states["l"][:, ANGLE]
    forces = found.reactions["w.normal"] - known.reactions["w.normal"]
    return float(np.abs(turned).max()), float(np.abs(forces).max())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("text", "angle", "force"),
    [(LADDER, 3e-7, 1e-4), (DISK, 1e-5, 1e-8)],  # measured 9e-8 rad, 3e-5 N; 3e-6 rad, 4e-10 N
    ids=["ladder", "disk"],
)
def test_it_starts_where_its_planes_carry_it(
    tmp_path: Path, text: str, angle: float, force: float
) -> None:
    turned, pressed = off(tmp_path, text)
    assert turned < angle
    assert pressed < force


@pytest.mark.slow
@pytest.mark.mutant("a start that has not settled, between what sticks and what slides")
@pytest.mark.parametrize("text", [LADDER, DISK], ids=["ladder", "disk"])
def test_a_start_that_has_not_settled_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, text: str
) -> None:
    monkeypatch.setattr(settle, "HELD", math.inf)
    assert off(tmp_path, text)[1] > 1.0
