"""What a plan promises: it is pickled, has reasons, keeps what is held, and names its ways."""

import pickle
import re
from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import numpy as np
import pytest
from given.adapters.engine_scenes import (
    BLOCK,
    DRAWN,
    GROWING,
    RESTS,
    SIX,
    WHEEL,
    guided,
    incline,
    launched,
    touching,
)
from given.adapters.planning import (
    COVERING,
    NAMES,
    SETTINGS,
    SHIPPED,
    TUNED,
    begun,
    builds,
    own,
    planned,
    ways,
    words,
)

from textmech import engines
from textmech.cases.scene import (
    Anchor,
    Bounds,
    Contact,
    GroundPoint,
    Push,
    Scene,
    Signal,
    planar_joint,
)
from textmech.cases.scene.shape import bar, disk
from textmech.engines.engine import Engine, Plan, Refusal, Start
from textmech.engines.mujoco import MuJoCo
from textmech.reports.compare.trial.trial import NOTHING_OF_ITS_OWN
from textmech.reports.compare.trial.trial import ways as tried


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
@pytest.mark.parametrize("name", COVERING)
def test_a_plan_crosses_into_a_process(name: str, engine: Engine) -> None:
    scene, start = begun(name)
    for plan in tried(engine, scene, start):
        if not builds(engine, scene) or (not own(engine, scene) and plan.realised == "native"):
            assert isinstance(plan, Refusal)
            continue
        assert isinstance(plan, Plan)
        other = pickle.loads(pickle.dumps(plan))
        for each in (plan, plan.held_at(2e-3)):
            assert all(choice.because for choice in each.choices(1e-3))
        assert other.choices(1e-3) == plan.choices(1e-3)
        assert other.protocol(1e-3) == plan.protocol(1e-3)
        assert (other.exponents, other.withheld) == (plan.exponents, plan.withheld)


ROUNDING = 1e-9  # m, rad, m/s: what a stop that differs in its last digits may leave


@pytest.mark.slow
@pytest.mark.parametrize("name", ["anisotropic_drift", "dynamometer", "dynamometer_smooth"])
def test_tied_numbers_that_are_said_to_make_no_difference_make_none(name: str) -> None:
    """Under our law MuJoCo's friction holds what lies still: how softly is all one."""
    ours = [plan for plan in TUNED["mujoco"].plans(*begun(name)) if plan.realised != "native"]
    for plan in ours:
        assert isinstance(plan, Plan)
        assert plan.alike
        assert softened(name, plan) < ROUNDING


@pytest.mark.slow
def test_a_difference_of_tied_numbers_would_be_seen() -> None:
    plan = planned(TUNED["mujoco"], *begun("four_bar"))
    assert not plan.alike
    assert softened("four_bar", plan) > 1e3 * ROUNDING


def softened(name: str, plan: Plan) -> float:
    """How far the motion is another with the numbers of a ladder's largest step, two above."""
    times, step = np.arange(0, 1.6, 0.016), 4e-4
    one, other = (
        TUNED["mujoco"].run(*begun(name), times, step, each, reactions=())
        for each in (plan, plan.held_at(4 * step))
    )
    return max(float(np.max(np.abs(one.states[b] - other.states[b]))) for b in one.states)


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_what_is_held_stays_and_what_follows_goes(engine: Engine) -> None:
    plan = planned(engine, *begun("four_bar"))
    held = plan.held_at(8e-4)
    assert held.exponents == plan.held
    assert held.choices(1e-4) == plan.choices(8e-4)
    assert held.held_at(2e-4).choices(1e-4) == plan.choices(2e-4)
    if words(engine) == "mujoco.tuned":  # its pins' stiffness follows the step
        assert plan.following == plan.exponents != held.exponents
        assert held.choices(1e-4) != plan.choices(1e-4)
    else:
        assert plan.following is None
        assert plan.choices(1e-4) == plan.choices(8e-4)


def test_a_refusal_stands_where_nothing_is_native() -> None:
    scene, start = begun("four_bar")

    class Law:
        """An engine that is told everything."""

        def plans(self, scene: object, start: object) -> list[Plan]:
            return [Plan("law", (1, 2))]

    found = tried(Law(), scene, start)  # type: ignore[arg-type]
    assert found == (Refusal("native", NOTHING_OF_ITS_OWN), Plan("law", (1, 2)))


DRY = guided(GROWING), RESTS
PULSE = Push("pull", Anchor("block", "center"), Signal("pulse", (8.0, 0.0), times=(0.2, 0.5)))
PULSED = guided(PULSE), RESTS
FLOOR = incline(WHEEL, touching("wheel", 0.3)), launched(0.0)
TWO = incline(BLOCK, touching("block", 0.3, static=0.4), slope=0.1), RESTS
OILED, FREE = begun("spring_mass_damper.critical"), begun("spring_mass_damper.free")
# Scene → engine → ways of the tuned setting, each with its exponents (of held numbers).
# MuJoCo's damper is exact in RK4; its floor, and dry friction held over a step, are of the first
# order. pymunk's damper and friction act after the kick; by our law they act at its middle.
WAYS: dict[str, tuple[tuple[Scene, Start], dict[str, dict[str, tuple[int, int]]]]] = {
    "a damper that does nothing": (
        FREE,
        {"mujoco": {"native": (4, 5)}, "pymunk": {"native": (2, 3), "law": (2, 3)}},
    ),
    "a damper": (
        OILED,
        {"mujoco": {"native": (4, 5)}, "pymunk": {"native": (1, 2), "law": (2, 3)}},
    ),
    "dry friction": (
        DRY,
        {
            "mujoco": {"native": (1, 2), "law": (1, 2)},
            "pymunk": {"native": (1, 2), "law": (2, 3)},
        },
    ),
    "dry friction under a pulse": (
        PULSED,
        {
            "mujoco": {"native": (1, 2), "law": (1, 2)},
            "pymunk": {"native": (1, 2), "law": (1, 2)},
        },
    ),
    "a floor": (FLOOR, {"mujoco": {"native": (1, 2)}, "pymunk": {"native": (1, 2)}}),
    "a floor with two coefficients": (
        TWO,
        {
            "mujoco": {"native": (1, 2), "law": (1, 2)},
            "pymunk": {"native": (1, 2), "law": (2, 3)},
        },
    ),
}


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("what", WAYS)
def test_ways_and_declared_expansions(what: str, name: str) -> None:
    scene, expected = WAYS[what]
    assert ways(TUNED[name], *scene) == tuple(expected[name])
    assert ways(SHIPPED[name], *scene) == ("native",)
    assert planned(SHIPPED[name], *scene).held == (1, 2)
    for way, exponents in expected[name].items():
        assert planned(TUNED[name], *scene, way).held == exponents  # type: ignore[arg-type]


# What is done to start and readout of a rolling wheel at 1e-3 s.
PROTOCOL = {
    "mujoco": r"wheel started \d\.\de-09 m in the floor",
    "pymunk": (
        r"started 0\.0005 s back, positions read 0\.0005 s ahead; "
        r"wheel started 1e-09 m in the floor"
    ),
}


@pytest.mark.parametrize("name", NAMES)
def test_the_protocol_says_what_is_done(name: str) -> None:
    scene = begun("rolling_wheel.pushed")
    assert planned(SHIPPED[name], *scene).protocol(1e-3) == ""
    assert re.fullmatch(PROTOCOL[name], planned(TUNED[name], *scene).protocol(1e-3))


UNEVEN = guided(GROWING, SIX, Bounds(1.0, 3.0)), RESTS
SAYS = {
    "two coefficients": (
        TWO,
        "one number for friction: touch by its kinetic 0.3 (static 0.4)",
    ),
    "uneven": (UNEVEN, "one number for friction: guide, where there are several"),
}


@pytest.mark.parametrize("setting", ["shipped", "tuned"])
@pytest.mark.parametrize("what", SAYS)
def test_mujoco_says_where_it_knows_one_number_of_friction(what: str, setting: str) -> None:
    """In the row, and at the head of its file; our law needs no such words."""
    engine = engines.make("mujoco", setting)
    (scene, start), says = SAYS[what]
    plan = planned(engine, scene, start)
    assert says in plan.protocol(1e-3)
    assert says in engine.script(scene, start, 1e-3, plan)
    if setting == "tuned":
        assert "one number" not in planned(engine, scene, start, "law").protocol(1e-3)
    assert "one number" not in planned(engine, *FLOOR).protocol(1e-3)


# pymunk tells the size of a joint's impulse.
WITHHELD = {
    "mujoco": {},
    "pymunk": dict.fromkeys(
        ("main.fx", "main.fy", "bore.fy", "bore.torque"),
        "engine: pymunk reports a joint's impulse as a magnitude only",
    ),
}


@pytest.mark.parametrize("engine", SETTINGS, ids=words)
def test_what_cannot_be_read_is_withheld_and_nothing_else(engine: Engine) -> None:
    withheld = planned(engine, *begun("slider_crank")).withheld
    assert WITHHELD[engine.name].items() <= withheld.items()
    assert bool(withheld) == bool(WITHHELD[engine.name])
    assert not {"main.force", "crank.angle"} & set(withheld)
    friction = planned(engine, *DRY).withheld.get("guide.friction", "")
    assert ("magnitude only" in friction) == bool(WITHHELD[engine.name])


@pytest.mark.parametrize("name", NAMES)
def test_friction_is_measured_where_the_engine_has_the_number(name: str) -> None:
    """It knows the kinetic one; of two bounds a mean, or a larger one, would be neither."""
    engine = TUNED[name]
    measured = engine.measure(guided(DRAWN), RESTS)
    assert measured["guide.friction_forward"] == measured["guide.friction_backward"] == 3.0
    uneven = engine.measure(guided(DRAWN, SIX, Bounds(1.0, 3.0)), RESTS)
    assert not {"guide.friction_forward", "guide.friction_backward"} & set(uneven)
    assert engine.measure(incline(BLOCK, touching("block", 0.3)), RESTS)["touch.friction"] == 0.3


def test_engines_are_found_sorted_and_know_their_settings() -> None:
    assert list(engines.names()) == sorted(engines.names())
    assert engines.Known()["mujoco"] == ("shipped", "recommended", "tuned")
    with pytest.raises(KeyError):
        engines.make("nobody", "tuned")


# MuJoCo's settings: recipes, a user's own options, and what MuJoCo itself does not take.


DISK = Scene(
    (0.0, -9.8),
    {"O": GroundPoint((0.0, 1.0)), "Q": GroundPoint((1.0, 1.0))},
    {
        "wheel": disk(name="wheel", mass=1.0, radius=0.2, points={}),
        "rod": bar(name="rod", mass=1.0, length=1.0, points={}),
        "other": bar(name="other", mass=1.0, length=1.0, points={}),
    },
    {
        "A": planar_joint("A", "pin", Anchor("ground", "O"), Anchor("rod", "start")),
        "B": planar_joint("B", "pin", Anchor("rod", "center"), Anchor("other", "center")),
        "C": planar_joint("C", "pin", Anchor("other", "end"), Anchor("ground", "Q")),
    },
    {"touch": Contact("touch", Anchor("wheel", "center"), 0.5, 0.5, ideal="rolling")},
    {},
)
START: Start = {
    "wheel": (0.0, 0.2, 0.0, 0.0, 0.0, 0.0),
    "rod": (0.5, 1.0, 0.0, 0.0, 0.0, 0.0),
    "other": (0.5, 1.0, 0.0, 0.0, 0.0, 0.0),
}
OPTIONS: dict[str, Any] = {
    "integrator": "implicit",
    "cone": "elliptic",
    "jacobian": "sparse",
    "solver": "CG",
    "iterations": 51,
    "ls_iterations": 21,
    "noslip_iterations": 3,
    "tolerance": 1e-9,
    "ls_tolerance": 2e-3,
    "noslip_tolerance": 3e-7,
    "impratio": 7.0,
    "solref": [0.03, 0.9],
    "solimp": [0.8, 0.9, 0.002],
}


def attributes(options: dict[str, Any]) -> dict[str, set[str]]:
    """Where each attribute of the model stands, with its value."""
    engine = MuJoCo("own", options)
    root = ET.fromstring(engine.script(DISK, START, 1e-3, planned(engine, DISK, START)))
    found: dict[str, set[str]] = {}
    for element in (*root.iter("option"), *root.iter("pair"), *root.iter("connect")):
        for name, value in element.attrib.items():
            found.setdefault(f"{element.tag}.{name}", set()).add(value)
    return found


@pytest.mark.parametrize("name", OPTIONS)
def test_every_option_takes_effect(name: str) -> None:
    value = OPTIONS[name]
    text = " ".join(map(str, value)) if isinstance(value, list) else str(value)
    before, after = attributes({}), attributes({name: value})
    places = ("pair", "connect") if isinstance(value, list) else ("option",)
    changed = {key for key in after if after[key] != before.get(key)}
    assert changed == {f"{place}.{name}" for place in places}
    assert all(after[key] == {text} for key in changed)


def test_whole_numbers_may_be_written_as_reals() -> None:
    assert attributes({"iterations": 50.0})["option.iterations"] == {"50"}


@pytest.mark.parametrize("options", [{"solref": [0.02, -1.0]}], ids=str)
def test_what_mujoco_refuses_is_said(
    options: dict[str, Any], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(ValueError, match="mujoco: "):
        MuJoCo("own", options)
    assert not list(tmp_path.iterdir())


def test_tuned_numbers_follow_the_step_and_say_why() -> None:
    plan = planned(MuJoCo("tuned"), DISK, START)
    for step in (1e-4, 8e-4):
        numbers = {choice.name: choice.value for choice in plan.choices(step)}
        assert numbers["connect.solref"] == [8 * step, 1.0]
        assert numbers["pair.solref"] == [2 * step, 1.0]
        assert plan.held_at(8e-4).choices(step) == plan.choices(8e-4)
    assert all(choice.because for choice in plan.choices(1e-4))
    assert plan.following is not None
    assert planned(MuJoCo("shipped"), DISK, START).following is None


def test_a_driven_points_mass_must_not_stop_the_solver() -> None:
    hook = GroundPoint((1.0, 1.0), (0.1, 0.0))
    towed = Scene(DISK.gravity, {**DISK.points, "Q": hook}, DISK.bodies, DISK.joints, {}, {})
    for engine, tolerance in (
        (MuJoCo("shipped"), 0.0),
        (MuJoCo("tuned"), 0.0),
        (MuJoCo("own", {"tolerance": 1e-6}), 1e-6),
    ):
        numbers = {
            choice.name: choice.value for choice in planned(engine, towed, START).choices(1e-3)
        }
        assert numbers["option.tolerance"] == tolerance
    names = [choice.name for choice in planned(MuJoCo("shipped"), DISK, START).choices(1e-3)]
    assert "option.tolerance" not in names


def test_exponents() -> None:
    pinned = Scene(DISK.gravity, DISK.points, DISK.bodies, DISK.joints, {}, {})
    tuned, rk4 = MuJoCo("tuned"), MuJoCo("own", {"integrator": "RK4"})
    assert planned(tuned, pinned, START).held_at(1e-3).exponents == (4, 5)
    assert planned(tuned, pinned, START).exponents == (2, 3)
    assert planned(tuned, DISK, START).exponents == (1, 2)
    assert planned(rk4, pinned, START).exponents == (4, 5)
    assert planned(MuJoCo("shipped"), pinned, START).exponents == (1, 2)
