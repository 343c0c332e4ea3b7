"""Tuned is no privilege: its recipe, pasted as a user's own options, gives the same numbers."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.planning import NATIVE, begun, pair, planned
from given.scenes import SHIPPED

from textmech import engines
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Engine, Plan, Tunable
from textmech.engines.knobs import Options, as_text, merged
from textmech.reports.own_settings import read_settings
from textmech.reports.trial.ladder import judged_step, wanted_reactions

RUNS = [
    (name, engine)
    for name, engine in NATIVE
    if engine.setting == "tuned" and SHIPPED[name].states is None
]
SAMPLES = 6  # of a run's first: a number that differs shows at once


def options(name: str, tuned: Engine) -> dict[str, Any]:
    """The tuned recipe at the judged step."""
    assert isinstance(tuned, Tunable)
    return merged(tuned.recipe(*begun(name)), {"step": judged_step(SHIPPED[name], tuned)})


def pasted(folder: Path, tuned: Engine, told: Options) -> Engine:
    """As a user does it: the text of `show`, in a file of settings."""
    file = folder / "mine.yaml"
    file.write_text(f"{tuned.name}: {as_text(told)}\n", encoding="utf-8")
    return read_settings(file, ())[tuned.name]


def run(name: str, engine: Engine, plan: Plan, step: float) -> Trajectory:
    scene, start = begun(name)
    case = SHIPPED[name]
    reactions = wanted_reactions(scene, tuple(case.allow))
    return engine.run(scene, start, case.times[:SAMPLES], step, plan, reactions=reactions)


def same(one: Trajectory, other: Trajectory) -> bool:
    """Bit for bit, the forces too."""
    both = [{**t.states, **t.reactions} for t in (one, other)]
    return both[0].keys() == both[1].keys() and all(
        np.array_equal(both[0][name], both[1][name], equal_nan=True) for name in both[0]
    )


@pytest.mark.whole
@pytest.mark.parametrize(("name", "tuned"), RUNS, ids=pair)
def test_the_tuned_recipe_as_own_options_is_the_same_run(
    name: str, tuned: Engine, tmp_path: Path
) -> None:
    told = options(name, tuned)
    own, step = pasted(tmp_path, tuned, told), told["step"]
    assert own.own_step == step
    plan, mine = planned(tuned, *begun(name)), planned(own, *begun(name))
    assert same(run(name, tuned, plan, step), run(name, own, mine, step))
    assert (mine.held, mine.following, mine.withheld) == (plan.held, plan.following, plan.withheld)
    for h in (step, 4 * step):  # numbers follow the step alike, and the held ladder's stay
        chosen = {c.name: c.value for c in plan.choices(h)}
        if not SHIPPED[name].scene.joints:
            chosen.pop("constraint.error_bias", None)  # nothing has it
        assert chosen.items() <= {c.name: c.value for c in mine.choices(h)}.items()


# A scene for each way in which a recipe reaches a run, and the option that must matter there.
NEEDED: list[tuple[str, str, str]] = [
    ("mujoco", "bar_pendulum", "integrator"),
    ("mujoco", "four_bar", "connect"),
    ("mujoco", "sliding_block.braking", "pair"),
    ("mujoco", "sliding_block.braking", "cone"),
    ("mujoco", "sliding_block.braking", "noslip_iterations"),
    ("mujoco", "rolling_wheel.downhill", "settled"),
    ("mujoco", "rolling_wheel.downhill", "impratio"),
    ("mujoco", "tipping_block", "diagexact"),
    ("mujoco", "dynamometer", "joint"),
    ("mujoco", "driven_wheel.circle", "pair"),
    ("mujoco", "driven_wheel.circle", "settled"),
    ("mujoco", "spatial_four_bar", "connect"),
    ("pymunk", "bar_pendulum", "midpoint"),
    ("pymunk", "bar_pendulum", "error_bias"),
    ("pymunk", "four_bar", "iterations"),
    ("pymunk", "four_bar", "start_iterations"),
    ("pymunk", "rolling_wheel.downhill", "seed"),
    ("pymunk", "bouncing_disk.plastic", "collision_bias"),
    ("pymunk", "sliding_ladder", "reflects"),
]


@pytest.mark.parametrize(("engine", "name", "option"), NEEDED, ids=" ".join)
def test_it_is_not_the_same_run_without(engine: str, name: str, option: str) -> None:
    """What the comparison above would miss if it could not fail."""
    case, tuned = SHIPPED[name], engines.make(engine, "tuned")
    told = options(name, tuned)
    step = told["step"]
    less = engines.make(engine, "mine", {k: v for k, v in told.items() if k != option})
    scene, start = begun(name)
    reactions, times = wanted_reactions(scene, tuple(case.allow)), case.times[: case.samples // 2]
    one, other = (
        e.run(scene, start, times, step, planned(e, scene, start), reactions=reactions)
        for e in (tuned, less)
    )
    assert not same(one, other)
