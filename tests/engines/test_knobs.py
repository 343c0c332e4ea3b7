"""Knobs: a closed list, in which each value is a user's option that does something."""

from pathlib import Path
from typing import Any

import pytest
from given.adapters.planning import NATIVE, begun, pair, planned
from given.scenes import SHIPPED
from ruamel.yaml import YAML

from textmech import engines
from textmech.engines.engine import Engine, Plan, Tunable
from textmech.engines.knobs import Knob, as_text, merged, short_value
from textmech.reports.tables.user_settings import read_settings

TUNED = [
    (name, engine)
    for name, engine in NATIVE
    if engine.setting == "tuned" and SHIPPED[name].states is None
]
INERT = {"jacobian", "tolerance"}  # of MuJoCo: in no case do they matter, so nobody turns them
OF_FRICTION = {"cone", "impratio"}
STEP = 1e-3  # s; at the shipped 2 ms a time constant of 10 h is the shipped one


def knobs(name: str, engine: Engine) -> list[Knob]:
    assert isinstance(engine, Tunable)
    return list(engine.knobs(*begun(name)))


@pytest.mark.parametrize(("name", "engine"), TUNED, ids=pair)
def test_together_they_are_what_tuned_does(name: str, engine: Engine) -> None:
    """Between the shipped setting and the tuned one nothing else is turned."""
    assert isinstance(engine, Tunable)
    found = knobs(name, engine)
    turned = merged(*(knob.tuned.options for knob in found if knob.tuned))
    scene, start = begun(name)
    recipe, touching = (
        engine.recipe(scene, start),
        (*scene.contacts.values(), *scene.pairs.values()),
    )
    rubs = any(contact.friction for contact in touching)
    inert = INERT if rubs else INERT | OF_FRICTION
    assert turned == {key: value for key, value in recipe.items() if key not in inert}
    assert len({knob.name for knob in found}) == len(found)
    for knob in found:
        assert knob.values or knob.tuned
        assert knob.tuned is None or knob.kind != "bundle"
        words = [value.words for value in knob.values]
        assert len(set(words)) == len(words)


# Scenes with all kinds of knobs.
SCENES = [
    ("mujoco", "bar_pendulum"),
    ("mujoco", "four_bar"),
    ("mujoco", "dynamometer"),
    ("mujoco", "sliding_block.below"),
    ("mujoco", "tipping_block"),
    ("mujoco", "bouncing_disk.elastic"),
    ("mujoco", "driven_wheel.circle"),
    ("pymunk", "four_bar"),
    ("pymunk", "sliding_ladder"),
    ("pymunk", "bouncing_disk.plastic"),
]


def decided(engine: Engine, name: str) -> tuple[Any, ...]:
    """What an engine takes its steps with."""
    plan = planned(engine, *begun(name))
    return {c.name: c.value for c in plan.choices(STEP)}, plan.protocol(STEP)


@pytest.mark.slow
@pytest.mark.parametrize(("engine", "name"), SCENES, ids=str)
def test_each_value_can_be_pasted_and_does_something(
    engine: str, name: str, tmp_path: Path
) -> None:
    shipped = engines.make(engine, "shipped")
    before = decided(shipped, name)
    for knob in knobs(name, shipped):
        for value in (*knob.values, *([knob.tuned] if knob.tuned else [])):
            file = tmp_path / "mine.yaml"
            file.write_text(f"{engine}: {as_text(value.options)}\n", encoding="utf-8")
            assert decided(read_settings(file, ())[engine], name) != before, value


@pytest.mark.slow
@pytest.mark.parametrize(
    "name", ["sliding_block.braking", "tipping_block", "bouncing_disk.elastic", "rolling_sphere"]
)
def test_a_bundle_is_the_recipe_of_its_word(name: str) -> None:
    shipped = engines.make("mujoco", "shipped")
    (bundle,) = [knob for knob in knobs(name, shipped) if knob.kind == "bundle"]
    assert bundle.values
    for value in bundle.values:
        word = value.words.removeprefix("the recipe for contacts that ")
        spelled, called = (
            decided(engines.make("mujoco", "mine", options), name)
            for options in (value.options, {"contacts": word})
        )
        assert spelled == called


@pytest.mark.parametrize("name", ["mujoco", "pymunk"])
def test_steps_and_costs(name: str) -> None:
    """A coarser step is cheaper; four stages cost what four steps do; the shipped step is there."""
    engine = engines.make(name, "shipped")
    assert isinstance(engine, Tunable)
    assert engine.own_step in engine.steps
    assert list(engine.steps) == sorted(engine.steps, reverse=True)
    cost = engine.cost(*begun("bar_pendulum"))
    assert [cost({}, h) for h in (0.01, 0.005)] == [100.0, 200.0]
    # a call, a body and a joint: 106 and its sweeps, ten of them as shipped
    dearer = {"mujoco": ({"integrator": "RK4"}, 4.0), "pymunk": ({"iterations": 68}, 1.5)}
    options, times = dearer[name]
    assert cost(options, 0.01) == pytest.approx(100.0 * times)


def test_sweeps_cost_by_what_they_sweep_over() -> None:
    """As many as the scene needs cost what that number does, and a contact what two joints do."""
    scene, start = begun("heavy_on_light")
    tuned, engine = (engines.make("pymunk", setting) for setting in ("tuned", "shipped"))
    assert isinstance(engine, Tunable)
    (way,) = (one for one in tuned.plans(scene, start) if one.realised == "native")
    assert isinstance(way, Plan)
    needed = next(c.value for c in way.choices(0.01) if c.name == "space.iterations")
    cost = engine.cost(scene, start)
    assert needed > 100
    assert cost({"iterations": "scene"}, 0.01) == cost({"iterations": needed}, 0.01)
    # a call, two bodies, and four contacts: 112 and eight for each sweep
    assert cost({"iterations": 34}, 0.01) == pytest.approx(200.0)
    assert cost({"start_iterations": "scene"}, 0.01) == 100.0


def test_groups_are_merged_key_by_key() -> None:
    one, other = {"pair": {"solref": [1, 2]}, "cone": "elliptic"}, {"pair": {"solimp": [3]}}
    both = merged(one, other, {"cone": "pyramidal"})
    assert both == {"pair": {"solref": [1, 2], "solimp": [3]}, "cone": "pyramidal"}
    assert one == {"pair": {"solref": [1, 2]}, "cone": "elliptic"}
    assert merged({"pair": {"solref": [1, 2]}}, {"pair": {"solref": [3, 4]}}) == {
        "pair": {"solref": [3, 4]}
    }


def test_text() -> None:
    """With a point in every real number, and no number that is a word."""
    options = {"pair": {"solref": ["2h", 1e-9]}, "settled": True, "max_bias": float("inf"), "n": 3}
    assert (
        as_text(options) == "{pair: {solref: [2h, 1.0e-09]}, settled: true, max_bias: .inf, n: 3}"
    )
    assert short_value([1e6, 1e-9, "-1/h", 0.0]) == "1e6 1e-9 -1/h 0"


@pytest.mark.mutant("1.25e-05 is pasted as 1.25.0e-05")
@pytest.mark.parametrize("value", [1.25e-05, 1e-05, 2e22, 0.5, 3.0, float("inf"), -float("inf")])
def test_a_pasted_number_is_read_as_the_same(value: float) -> None:
    (name, text) = as_text({"softness": value}).strip("{}").split(": ")
    assert (name, YAML(typ="safe", pure=True).load(text)) == ("softness", value)
