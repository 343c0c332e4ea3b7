"""Joints hold: sweeps as many as the scene needs, a share of the gap where that is too many."""

from pathlib import Path

import numpy as np
import pytest
from given.engine_scenes import chain
from given.light_parts import CRANE, SCISSOR, WHITWORTH
from given.planning import SHIPPED, TUNED, moved, planned
from given.scenes import tail, typed

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import ANGLE, Trajectory
from textmech.engines.engine import Diverged, Plan, Realised, Start
from textmech.engines.pymunk.model.solver_contraction import halving
from textmech.engines.pymunk.stepping.scene import build
from textmech.reference.solve import solve
from textmech.reports.compare.trial.start import assembled, first

ENGINE = TUNED["pymunk"]
STEP = 2e-4
END = tail(0.5, 26)


def number(plan: Plan, name: str, step: float = STEP) -> float:
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
    found = errors(case, solve(case).trajectory, way, STEP)
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
    moved(SHIPPED["pymunk"], case.scene, assembled(case), case.times, 0.005)


def test_the_plan_says_why() -> None:
    scene, start = chain(5)
    reasons = {
        choice.name: choice.because for choice in planned(ENGINE, scene, start).choices(STEP)
    }
    assert "halved by 7 sweeps at the worst pose" in reasons["space.iterations"]
