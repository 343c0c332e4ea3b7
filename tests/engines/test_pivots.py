"""Spokes that pivot on the floor in turn: when they strike, where the wheel is, and its forces.

The wheel is known in closed form, to rounding.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import pytest
from given.planning import TUNED, begun, planned

from textmech.cases.scene.shape import spokes
from textmech.cases.trajectory import ANGLE, Array, Trajectory
from textmech.engines.engine import Choice, Plan
from textmech.engines.mujoco.model import contact
from textmech.engines.mujoco.settings.settings import at_step
from textmech.reference.systems.walkers.rimless_wheel import SpokeSteps
from textmech.reports.compare.events.times import falls

L, M = 0.3, 2.0
RATE = 3.3  # rad/s
STEPS = (1e-3, 1e-4)  # s
TIMES = np.linspace(0.0, 1.2, 31)
NORMAL = "feet.normal"
HEAVY_RIM, LIGHT_RIM = 0.09, 0.03  # kg m²: ρ = 1/2, and 1/6, which keeps 3/4 of the speed


@dataclass(frozen=True)
class Near:
    """How near a tuned engine comes with each of STEPS; measured values stand beside."""

    strikes: tuple[float, float]  # s
    angle: tuple[float, float]  # rad


NEAR = {
    ("mujoco", HEAVY_RIM): Near(strikes=(6e-3, 2e-4), angle=(1.7e-2, 8e-4)),  # 2.0e-3, 6.3e-5
    ("mujoco", LIGHT_RIM): Near(strikes=(1.1e-2, 4e-4), angle=(3e-2, 1.2e-3)),  # 3.6e-3, 1.3e-4
    ("pymunk", HEAVY_RIM): Near(strikes=(2e-3, 1.1e-4), angle=(5e-3, 4.5e-4)),  # 6.3e-4, 3.7e-5
    ("pymunk", LIGHT_RIM): Near(strikes=(7e-3, 3.5e-4), angle=(2e-2, 1.1e-3)),  # 2.4e-3, 1.1e-4
}


def known(inertia: float) -> tuple[Array, Array]:
    """The strikes, and the angle of the wheel at TIMES."""
    steps = SpokeSteps(8, L, inertia / (M * L**2), 0.1)
    struck = steps.strikes(RATE, 1.2)
    rows = [steps.after(RATE, t) for t in TIMES.tolist()]
    assert struck is not None
    return np.array(struck), -np.array([row[0] for row in rows if row is not None])


def moved(name: str, inertia: float, step: float, *own: Choice) -> Trajectory:
    """The wheel of the case with another inertia, and some numbers of one's own."""
    scene, start = begun("rimless_wheel")
    wheel = spokes(name="wheel", number=8, length=L, mass=M, inertia=inertia, points={})
    scene = replace(scene, bodies={"wheel": wheel})
    plan = planned(TUNED[name], scene, start)
    if own:
        plan = _with(plan, own)
    return TUNED[name].run(scene, start, TIMES, step, plan, reactions=(NORMAL,), record=True)


def _with(plan: Plan, own: Sequence[Choice]) -> Plan:
    names = [choice.name for choice in own]

    def numbers(step: float) -> Sequence[Choice]:
        return [*(c for c in plan.choices(step) if c.name not in names), *own]

    return replace(plan, numbers=numbers)


def late(run: Trajectory, struck: Array) -> float:
    """The largest error [s] of the strikes; inf if there are others."""
    assert run.record is not None
    body = begun("rimless_wheel")[0].bodies["wheel"]
    heights = np.sort(
        [body.point(run.record.states["wheel"], tip)[:, 1] for tip in body.tips], axis=0
    )
    found = falls(run.record.times, heights[1])
    return float(np.abs(found - struck).max()) if len(found) == len(struck) else np.inf


@pytest.mark.slow
@pytest.mark.parametrize("inertia", [HEAVY_RIM, LIGHT_RIM])
@pytest.mark.parametrize("name", TUNED)
@pytest.mark.parametrize("k", range(len(STEPS)))
def test_a_wheel_walks_on_its_spokes(k: int, name: str, inertia: float) -> None:
    struck, angle = known(inertia)
    run, near = moved(name, inertia, STEPS[k]), NEAR[name, inertia]
    assert late(run, struck) < near.strikes[k]
    assert np.abs(run.states["wheel"][:, ANGLE] - angle).max() < near.angle[k]


@pytest.mark.slow
def test_the_carrying_recipe_throws_a_tip_back() -> None:
    """MuJoCo's for a tip that only stands: 20 times later in three strikes."""
    struck, _ = known(HEAVY_RIM)
    scene, _ = begun("rimless_wheel")
    tip = at_step(contact.recipes(scene)["tip"](scene), 1e-4)
    assert late(moved("mujoco", HEAVY_RIM, 1e-4, *tip), struck) > 1e-3


def carried(t: float) -> float:
    """m g cos γ + m ÿ_c [N] before the first strike, by (2.23); θ = s − α."""
    s, rate = SpokeSteps(8, L, 0.5, 0.1).after(RATE, t) or (0.0, 0.0)
    lean, g = s - np.pi / 8, 9.80665
    turning = g / L / 1.5 * np.sin(lean + 0.1)
    return M * (g * np.cos(0.1) - L * (turning * np.sin(lean) + rate**2 * np.cos(lean)))


@pytest.mark.slow
def test_a_seed_that_is_too_small_leaves_no_force_at_the_start() -> None:
    """pymunk: 1e-9 m are less than the tip's path rises in half a step."""
    for seed, opens in ((1e-6, False), (1e-9, True)):
        run = moved("pymunk", HEAVY_RIM, 1e-4, Choice("start.seed", seed, ""))
        assert (abs(run.reactions[NORMAL][0] - carried(0.0)) > 0.1) == opens


@pytest.mark.slow
@pytest.mark.parametrize("name", TUNED)
def test_the_floor_carries_the_sum_of_all_tips(name: str) -> None:
    """At the start, and 45 ms before the first strike; measured 4e-3 N of 12."""
    run = moved(name, HEAVY_RIM, 1e-4)
    for at in (0, 5):
        assert run.reactions[NORMAL][at] == pytest.approx(carried(float(TIMES[at])), abs=2e-2)


@pytest.mark.slow
def test_too_few_sweeps_keep_another_part_of_the_speed() -> None:
    """pymunk, one sweep in place of 120, where two tips touch at once."""
    few = [Choice(f"{of}.iterations", 1, "") for of in ("space", "start")]
    struck, _ = known(LIGHT_RIM)
    assert late(moved("pymunk", LIGHT_RIM, 1e-4, *few), struck) > 3e-3
