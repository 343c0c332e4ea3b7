"""Tuned is no privilege: its recipe, pasted as a user's own options, gives the same numbers."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.adapters.planning import NATIVE, begun, pair, planned, refused
from given.scenes import SHIPPED

from textmech import engines
from textmech.cases.trajectory import Trajectory
from textmech.engines.engine import Engine, Plan, Tunable
from textmech.engines.knobs import Options, as_text, merged
from textmech.reports.compare.trial.ladder import judged_step, wanted_reactions
from textmech.reports.tables.user_settings import read_settings

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


@pytest.mark.slow
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
    ("mujoco", "growing_force", "joint"),
    ("mujoco", "driven_wheel.circle", "pair"),
    ("mujoco", "rolling_into_wall", "each"),
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


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "name", "option"), NEEDED, ids=str)
def test_it_is_not_the_same_run_without(engine: str, name: str, option: str) -> None:
    """What the comparison above would miss if it could not fail."""
    case, tuned = SHIPPED[name], engines.make(engine, "tuned")
    told = options(name, tuned)
    step = told["step"]
    less = engines.make(engine, "mine", {k: v for k, v in told.items() if k != option})
    scene, start = begun(name)
    reactions, times = wanted_reactions(scene, tuple(case.allow)), case.times[: case.samples // 3]
    one, other = (
        e.run(scene, start, times, step, planned(e, scene, start), reactions=reactions)
        for e in (tuned, less)
    )
    assert not same(one, other)


@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_show_prints_them(engine: str, tmp_path: Path) -> None:
    tuned = engines.make(engine, "tuned")
    scene, start = begun("four_bar")
    text = tuned.script(scene, start, 1e-4, planned(tuned, scene, start))
    (line,) = [line for line in text.splitlines() if "as your own settings: " in line]
    file = tmp_path / "mine.yaml"
    file.write_text(line.partition("settings: ")[2].removesuffix(" -->"), encoding="utf-8")
    own = read_settings(file, ())[engine]
    assert own.own_step == 1e-4
    for h in (1e-4, 1e-3):
        chosen, mine = (planned(e, scene, start).choices(h) for e in (tuned, own))
        wanted = {choice.name: choice.value for choice in chosen}
        found = {choice.name: choice.value for choice in mine}
        assert all(found[name] == value for name, value in wanted.items())
    shipped = engines.make(engine, "shipped")
    assert "own settings" not in shipped.script(scene, start, 1e-4, planned(shipped, scene, start))


# A recipe for contacts by its word, and what it has to say to other scenes.
UNFIT = [
    ("sliding_block.below", "bounce", "adapter: contacts: bounce, and no contact of this scene"),
    ("sliding_block.below", "rim", "no recipe for this scene's; known: roll, slide, tip"),
    ("driven_wheel.circle", "slide", "no recipe for this scene's; known: roll, rim, scene"),
]


@pytest.mark.parametrize(("name", "word", "why"), UNFIT, ids=str)
def test_a_recipe_that_does_not_fit_is_refused(name: str, word: str, why: str) -> None:
    told = refused(engines.make("mujoco", "mine", {"contacts": word}), *begun(name))
    assert told is not None
    assert why in told


@pytest.mark.parametrize(
    ("name", "word"),
    [
        ("rolling_wheel.downhill", "roll"),
        ("sliding_block.braking", "slide"),
        ("tipping_block", "tip"),
        ("bouncing_disk.plastic", "land"),
        ("bouncing_disk.elastic", "bounce"),
        ("driven_wheel.circle", "rim"),
        ("rolling_sphere", "roll"),
    ],
)
def test_a_recipe_by_its_word_is_what_tuned_chooses(name: str, word: str) -> None:
    """And numbers that are written out stand above it."""
    for chosen in (word, "scene"):
        own = engines.make("mujoco", "mine", {"contacts": chosen, "solref": [0.05, 1.0]})
        numbers = {c.name: c.value for c in planned(own, *begun(name)).choices(1e-3)}
        best = planned(engines.make("mujoco", "tuned"), *begun(name)).choices(1e-3)
        wanted = {c.name: c.value for c in best if c.name.startswith(("pair.", "flag."))}
        assert wanted.items() <= numbers.items()
        assert numbers["option.integrator"] == "Euler"
    own = engines.make("mujoco", "mine", {"contacts": word, "pair": {"solref": [0.05, 1.0]}})
    numbers = {c.name: c.value for c in planned(own, *begun(name)).choices(1e-3)}
    assert numbers["pair.solref"] == [0.05, 1.0]


def numbers(engine: str, name: str, told: Options) -> dict[str, Any]:
    own = engines.make(engine, "mine", told)
    return {c.name: c.value for c in planned(own, *begun(name)).choices(1e-3)}


def test_what_a_scene_has_nothing_of_does_nothing() -> None:
    soft = {"pair": {"solref": [0.05, 1.0]}, "joint": {"solreffriction": [0.05, 1.0]}}
    assert numbers("mujoco", "four_bar", soft) == numbers("mujoco", "four_bar", {})
    around = {"seed": 1e-9, "reflects": True, "across": True, "collision_slop": 1e-6}
    assert numbers("pymunk", "four_bar", around) == numbers("pymunk", "four_bar", {})


def test_a_flag_may_be_taken_back() -> None:
    tip = {"contacts": "tip"}
    assert numbers("mujoco", "tipping_block", tip)["flag.diagexact"] == "enable"
    less = numbers("mujoco", "tipping_block", {**tip, "diagexact": False})
    assert less["flag.diagexact"] == "disable"


def test_what_is_left_to_the_scene() -> None:
    """As tuned has it; 0 follows no step."""
    told = {"iterations": "scene", "error_bias": "scene"}
    found = numbers("pymunk", "four_bar", told)
    assert (found["space.iterations"], found["constraint.error_bias"]) == (30, 0.0)
    assert "start.iterations" not in found
    own = engines.make("pymunk", "mine", told)
    assert planned(own, *begun("four_bar")).following is None
    # nothing of a lone block is swept, and the shipped number stays
    assert numbers("pymunk", "sliding_block.below", told)["space.iterations"] == 10


# Options of pymunk, a case, and the order of its error.
ORDERS = [
    ("bar_pendulum", {"midpoint": True}, 1),
    ("bar_pendulum", {"error_bias": 0.0}, 1),
    ("bar_pendulum", {"midpoint": True, "error_bias": 0.0, "iterations": 30}, 2),
    ("rolling_wheel.downhill", {"midpoint": True}, 1),
    ("rolling_wheel.downhill", {"midpoint": True, "seed": 1e-9}, 2),
    ("spring_mass_damper.critical", {"midpoint": True}, 1),  # dampers act after the kick
]


@pytest.mark.parametrize(("name", "told", "order"), ORDERS, ids=str)
def test_the_order_that_own_options_declare(name: str, told: Options, order: int) -> None:
    plan = planned(engines.make("pymunk", "mine", told), *begun(name))
    assert plan.held == (order, order + 1)
