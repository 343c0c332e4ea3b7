"""pymunk's tuned recipe: each of its numbers is needed, for without it a bound is broken."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given.adapters.engine_scenes import (
    BLOCK,
    DRAWN,
    RESTS,
    chain,
    guided,
    incline,
    machine,
    pin,
    thrown,
    touching,
)
from given.adapters.planning import SHIPPED as SHIPPED_ENGINES
from given.adapters.planning import TUNED, begun, every, moved, planned
from given.machines.closed_motions import drawn, pendulum
from given.machines.swings import energy_drift, swing_error
from given.scenes import SHIPPED, tail, typed
from given.scenes.light_parts import CRANE, SCISSOR, WHITWORTH
from scipy.linalg import subspace_angles

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene import Bounds, DryFriction, Joint, Scene
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import bar
from textmech.cases.trajectory import ANGLE, Array, Trajectory, X, Y
from textmech.engines.engine import Choice, Diverged, Plan, Realised, Start
from textmech.engines.pymunk.callbacks import friction
from textmech.engines.pymunk.model.solver_contraction import halving
from textmech.engines.pymunk.model.world import World
from textmech.engines.pymunk.read.health import _left
from textmech.engines.pymunk.settings.options import Numbers
from textmech.engines.pymunk.stepping import scene as builder
from textmech.engines.pymunk.stepping.run import placed
from textmech.engines.pymunk.stepping.scene import build
from textmech.reference.solve import solve
from textmech.reports.compare.events.times import engine_events
from textmech.reports.compare.trial.start import assembled, first

ENGINE = TUNED["pymunk"]
STEP = 1e-4


def without(monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    """The tuned recipe without one of its numbers."""
    whole = Numbers.__call__
    monkeypatch.setattr(
        Numbers, "__call__", lambda self, h: [c for c in whole(self, h) if c.name != name]
    )


@pytest.mark.slow
@pytest.mark.parametrize("number", ["constraint.error_bias", "time.midpoint"])
def test_a_pendulum_misses_its_bar_without(monkeypatch: pytest.MonkeyPatch, number: str) -> None:
    without(monkeypatch, number)
    scene, start = begun("bar_pendulum")
    times = SHIPPED["bar_pendulum"].times
    run = moved(ENGINE, scene, start, times, STEP)
    error = np.abs(run.states["bar"][:, ANGLE] - pendulum(times)[0]).max()
    assert error > 10 * 2e-5  # rad, the case's reach


def test_a_wheel_that_only_touches_falls_for_one_step(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "start.seed")
    scene, start = begun("rolling_wheel.downhill")
    run = moved(ENGINE, scene, start, SHIPPED["rolling_wheel.downhill"].times, 1e-3)
    assert np.abs(observe(scene, run, "touch.gap")).max() > 1e-6


@pytest.mark.slow
@pytest.mark.parametrize(("seed", "often"), [(1e-8, 1), (1e-9, 3)])
def test_a_ladder_uses_up_a_smaller_seed(
    monkeypatch: pytest.MonkeyPatch, seed: float, often: int
) -> None:
    """Then its contacts open for a step on the way, and its event happens three times."""
    whole = Numbers.__call__

    def seeded(self: Numbers, h: float) -> list[Choice]:
        return [replace(c, value=seed) if c.name == "start.seed" else c for c in whole(self, h)]

    monkeypatch.setattr(Numbers, "__call__", seeded)
    case, (scene, start) = SHIPPED["sliding_ladder"], begun("sliding_ladder")
    times, wanted = np.linspace(0.0, 0.6, 7), ("top.normal",)
    run = moved(ENGINE, scene, start, times, STEP, reactions=wanted, record=True)
    found = engine_events(scene, every(run), case.events["leaves"])
    assert len(found) == often
    assert abs(found[-1] - 0.5175626) < 2 * STEP


def test_a_block_falls_for_one_step_without_the_seed(monkeypatch: pytest.MonkeyPatch) -> None:
    without(monkeypatch, "start.seed")
    scene, times = incline(BLOCK, touching("block", 0.4)), np.linspace(0.0, 2.0, 21)
    run = moved(ENGINE, scene, thrown(1.0), times, STEP)
    assert np.abs(run.states["block"][:, Y]).max() > 1e-8


def test_a_slide_is_worse_where_a_user_would_put_the_groove(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    def naive(world: builder.World, joint: Joint) -> tuple[tuple[float, float], ...]:
        (x, y), (ux, uy) = world.local(joint.a), joint.along
        return (x - 3 * ux, y - 3 * uy), (x + 3 * ux, y + 3 * uy), world.local(joint.b)

    monkeypatch.setattr(builder, "groove", naive)
    angle, force = swing_error(ENGINE, "slide")
    assert angle > 1e-4
    assert force > 0.1


def test_a_chain_with_the_default_iterations_gains_energy(monkeypatch: pytest.MonkeyPatch) -> None:
    whole = Numbers.__call__
    monkeypatch.setattr(
        Numbers,
        "__call__",
        lambda self, h: [replace(c, value=10) if "iter" in c.name else c for c in whole(self, h)],
    )
    assert energy_drift(ENGINE, 12) > 1.0


@pytest.mark.mutant("friction of a whole step where a block breaks loose")
@pytest.mark.slow
def test_a_whole_step_at_the_onset_is_of_first_order(monkeypatch: pytest.MonkeyPatch) -> None:
    def plain(law: DryFriction, middle: float, end: float) -> float:
        return friction.dry_friction(law, 0.0, middle)

    monkeypatch.setattr(friction, "_from_rest", plain)
    times = np.linspace(0.0, 10.0, 101)
    run = moved(ENGINE, guided(DRAWN), RESTS, times, STEP, realised="law")
    assert 1e-7 < np.abs(run.states["block"][:, X] - drawn(times)).max() < 2 * STEP


@pytest.mark.parametrize("bounds", [(Bounds(2, 4), Bounds(1, 3)), (Bounds(1, 3), Bounds(1, 3))])
@pytest.mark.parametrize("speed", [0.0, 2e-3, -2e-3, 0.5])
@pytest.mark.parametrize("force", [-6.0, -3.5, 0.0, 1.9, 6.0])
def test_mean_over_a_step_is_the_law_stepped_finely(
    bounds: tuple[Bounds, Bounds], speed: float, force: float
) -> None:
    law, h, n = DryFriction(*bounds), 1e-3, 5000
    v, rate = speed, 20.0  # N/s
    for i in range(n):
        applied = force + rate * (i + 0.5) * h / n
        after = v + (applied + friction.dry_friction(law, v, applied)) * h / n
        v = 0.0 if after * v < 0 else after
    mean = friction.mean_friction(law, speed, 1.0, lambda ahead: force + rate * ahead, h)
    assert speed + (force + rate * h / 2 + mean) * h == pytest.approx(v, abs=2e-5)


# Joints hold: sweeps as many as the scene needs, a share of the gap where that is too many.


HELD_STEP = 2e-4
END = tail(0.5, 26)


def number(plan: Plan, name: str, step: float = HELD_STEP) -> float:
    """A number of the plan."""
    (value,) = [choice.value for choice in plan.choices(step) if choice.name == name]
    return value


def errors(case: Case, exact: Trajectory, way: Realised, step: float) -> dict[str, float]:
    """Of all that the case allows, from the first sample on."""
    forces = tuple(name for name in case.allow if name.endswith(".force"))
    run = moved(ENGINE, case.scene, first(exact), case.times, step, realised=way, reactions=forces)
    return {
        name: float(np.abs(observe(case.scene, run, name) - observe(case.scene, exact, name)).max())
        for name in case.allow
    }


# Way, and what is left at 2e-4 s of the motion [m, rad] and of forces [N], the first included.
MACHINES: dict[str, tuple[str, Realised, tuple[float, float]]] = {
    # The arm swings back within 20 ms: measured 4e-4 and 0.6 N of 380.
    "a quick return": (WHITWORTH, "native", (1e-3, 1.5)),
    # Its damper is strong: at the start a force of 50 N is 0.036 off.
    "a scissor lift": (SCISSOR, "law", (3e-7, 0.1)),
    "a crane": (CRANE, "native", (6e-7, 6e-4)),
}


@pytest.mark.slow
@pytest.mark.parametrize("what", MACHINES)
def test_a_light_part_between_heavy_ones(what: str, tmp_path: Path) -> None:
    """With 30 sweeps the lift and the crane flew apart, at any step."""
    text, way, (place, force) = MACHINES[what]
    case = typed(tmp_path, text, tail=END)
    found = errors(case, solve(case).trajectory, way, HELD_STEP)
    for name, error in found.items():
        assert error < (force if name.endswith(".force") else place), name


@pytest.mark.slow
def test_a_share_of_the_gap_is_of_second_order_too(tmp_path: Path) -> None:
    """On a thread of 1 g whole gaps would need 12 000 sweeps: the bias follows the step."""
    text = CRANE.replace("mass: 0.1", "mass: 0.001")
    case = typed(tmp_path, text, tail=END)
    start = assembled(case)
    plan = planned(ENGINE, case.scene, start)
    assert (plan.held, plan.following) == ((1, 2), (2, 3))
    assert 0 < number(plan, "constraint.error_bias", 1e-5) < 1  # not 0, which would be unstable
    a, b, c = (
        moved(ENGINE, case.scene, start, case.times, h).states["rope"][:, ANGLE]
        for h in (8e-4, 4e-4, 2e-4)
    )
    assert np.abs(b - c).max() < 2e-5  # rad
    assert np.abs(a - b).max() / np.abs(b - c).max() == pytest.approx(4.0, rel=0.1)


@pytest.mark.parametrize("text", [CRANE, SCISSOR, WHITWORTH])
def test_so_many_sweeps_and_no_fewer(text: str, tmp_path: Path) -> None:
    """They are counted at a pose, so it is held: in 400 steps of 10 µs nothing falls far."""
    case = typed(tmp_path, text, tail=END)
    start: Start = {name: (*row[:3], 0.0, 0.0, 0.0) for name, row in assembled(case).items()}
    worst = halving(build(case.scene, start, {}, "native"))

    def fastest(share: float) -> float:
        numbers = {"constraint.error_bias": 0.0, "space.iterations": round(share * worst)}
        world = build(case.scene, start, numbers, "law")
        for _ in range(400):
            world.space.step(1e-5)
        return max(max(map(abs, body.velocity)) for body in world.bodies.values())

    assert fastest(1.2) < 0.1 < 10 < fastest(0.8)  # m/s; g t is 0.04


def test_the_worst_pose_counts(tmp_path: Path) -> None:
    """A quick return needs six times as many where its arm swings back."""
    case = typed(tmp_path, WHITWORTH, tail=END)
    start = assembled(case)
    here = halving(build(case.scene, start, {}, "native"))
    assert number(planned(ENGINE, case.scene, start), "space.iterations") > 50 * here


@pytest.mark.parametrize("step", [1e-3, 1e-4])
@pytest.mark.parametrize("text", [CRANE, SCISSOR])
def test_too_few_sweeps_are_told_as_such(text: str, step: float, tmp_path: Path) -> None:
    """Not as the engine's model, nor as an end of a floor or a rail."""
    case = typed(tmp_path, text, tail=END)
    options = {"iterations": 30, "error_bias": 0.0}
    with pytest.raises(Diverged, match="the sweeps were not enough: 30 a step"):
        moved(engines.make("pymunk", "own", options), case.scene, assembled(case), case.times, step)


@pytest.mark.parametrize("text", [CRANE, SCISSOR, WHITWORTH])
def test_enough_sweeps_are_not_blamed(text: str, tmp_path: Path) -> None:
    case = typed(tmp_path, text, tail=END)
    moved(SHIPPED_ENGINES["pymunk"], case.scene, assembled(case), case.times, 0.005)


def test_the_plan_says_why() -> None:
    scene, start = chain(5)
    reasons = {
        choice.name: choice.because for choice in planned(ENGINE, scene, start).choices(HELD_STEP)
    }
    assert "halved by 7 sweeps at the worst pose" in reasons["space.iterations"]


# What sweeps and health know of a slot that a pin joint holds: its line at every pose.


ARM = bar(name="arm", mass=0.9, length=1.0, points={})
ROD = bar(name="rod", mass=1.2, length=0.8, points={})
ALONG = (0.6, 0.8)  # of the slot, in the arm's axes, through its end
MILLI = 1e-3  # s


def scene() -> Scene:
    """An arm on a hinge, and a rod whose end shifts in the arm's slot."""
    guide = pin("guide", "arm.end", "rod.start", kind="slot", along=ALONG)
    return machine([ARM, ROD], [pin("hinge", "ground.O", "arm.start"), guide])


def directions(arm: float) -> tuple[Array, Array]:
    """Along the slot and across it, in ground axes."""
    cos, sin = math.cos(arm), math.sin(arm)
    u = np.array([0.6 * cos - 0.8 * sin, 0.6 * sin + 0.8 * cos])
    return u, np.array([-u[1], u[0]])


def start(arm: float, rod: float, shifted: float) -> Start:
    """At rest: two angles [rad], and how far the rod's end is along the slot [m]."""
    tip = np.array([math.cos(arm), math.sin(arm)])
    centre = tip + shifted * directions(arm)[0] + 0.4 * np.array([math.cos(rod), math.sin(rod)])
    middle = 0.5 * tip
    return {
        "arm": (*middle.tolist(), arm, 0.0, 0.0, 0.0),
        "rod": (*centre.tolist(), rod, 0.0, 0.0, 0.0),
    }


def world(at: Start) -> World:
    plan = planned(TUNED["pymunk"], scene(), at)
    numbers = {choice.name: choice.value for choice in plan.choices(MILLI)}
    return placed(scene(), at, MILLI, numbers, "native")


def by_angle(at: Start) -> float:
    """Two blocks, one after the other: an error keeps cos² of the angle between their rows."""
    (ax, ay, arm, *_), (bx, by, rod, *_) = at["arm"], at["rod"]
    n = directions(arm)[1]
    point = np.array([bx, by]) - 0.4 * np.array([math.cos(rod), math.sin(rod)])
    on_arm, on_rod = point - (ax, ay), point - (bx, by)
    turn = lambda r: n @ np.array([-r[1], r[0]])  # noqa: E731
    hinge = np.array([[1, 0, ay, 0, 0, 0], [0, 1, -ax, 0, 0, 0]])
    slot = np.array([[*-n, -turn(on_arm), *n, turn(on_rod)]])
    masses = [ARM.mass, ARM.mass, ARM.moment, ROD.mass, ROD.mass, ROD.moment]
    weights = 1 / np.sqrt(np.array(masses, float))
    angle = float(np.min(subspace_angles((hinge * weights).T, (slot * weights).T)))
    return max(1.0, math.log(2) / -math.log(math.cos(angle) ** 2))


POSES = [start(0.2, 2.9, -0.9), start(1.1, -2.0, 0.8), start(-0.4, 1.0, -0.9)]


@pytest.mark.parametrize("k", range(len(POSES)))
def test_sweeps_of_a_slot_and_a_hinge(k: int) -> None:
    assert by_angle(POSES[k]) > 1.1  # where fewer do, 1 is told
    assert halving(world(POSES[k])) == pytest.approx(by_angle(POSES[k]), rel=1e-4)


def test_sweeps_are_those_of_the_present_pose() -> None:
    made = world(POSES[0])
    for name, (x, y, angle, *_) in POSES[1].items():
        made.bodies[name].position, made.bodies[name].angle = (x, y), angle
    assert halving(made) == pytest.approx(by_angle(POSES[1]), rel=1e-4)


def test_health_sees_a_gap_across_the_slot_and_no_sliding_along_it() -> None:
    at = POSES[0]
    u, n = directions(at["arm"][2])

    def left(shift: Array, speed: Array) -> float:
        row = np.array([at["arm"], at["rod"]])
        row[1, :2] += shift
        row[1, 3:5] += speed
        return float(_left(world(at), row[None], np.zeros(1), MILLI)[1][0])

    assert left(0.01 * u, 2.0 * u) < 1e-9
    assert left(1e-4 * n, 0.0 * n) == pytest.approx(1e-4 / MILLI, rel=1e-6)
    assert left(0.0 * n, 0.3 * n) == pytest.approx(0.3, rel=1e-6)
