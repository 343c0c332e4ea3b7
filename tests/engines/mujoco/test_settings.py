"""MuJoCo's settings: recipes, a user's own options, and what MuJoCo itself does not take."""

from pathlib import Path
from typing import Any
from xml.etree import ElementTree as ET

import pytest
from given.planning import planned

from textmech.cases.scene import Anchor, Contact, GroundPoint, Scene, planar_joint
from textmech.cases.scene.shape import bar, disk
from textmech.engines.engine import Start
from textmech.engines.mujoco import MuJoCo

WHEEL = Scene(
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
    root = ET.fromstring(engine.script(WHEEL, START, 1e-3, planned(engine, WHEEL, START)))
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
    plan = planned(MuJoCo("tuned"), WHEEL, START)
    for step in (1e-4, 8e-4):
        numbers = {choice.name: choice.value for choice in plan.choices(step)}
        assert numbers["connect.solref"] == [8 * step, 1.0]
        assert numbers["pair.solref"] == [2 * step, 1.0]
        assert plan.held_at(8e-4).choices(step) == plan.choices(8e-4)
    assert all(choice.because for choice in plan.choices(1e-4))
    assert plan.following is not None
    assert planned(MuJoCo("shipped"), WHEEL, START).following is None


def test_a_driven_points_mass_must_not_stop_the_solver() -> None:
    hook = GroundPoint((1.0, 1.0), (0.1, 0.0))
    towed = Scene(WHEEL.gravity, {**WHEEL.points, "Q": hook}, WHEEL.bodies, WHEEL.joints, {}, {})
    for engine, tolerance in (
        (MuJoCo("shipped"), 0.0),
        (MuJoCo("tuned"), 0.0),
        (MuJoCo("own", {"tolerance": 1e-6}), 1e-6),
    ):
        numbers = {
            choice.name: choice.value for choice in planned(engine, towed, START).choices(1e-3)
        }
        assert numbers["option.tolerance"] == tolerance
    names = [choice.name for choice in planned(MuJoCo("shipped"), WHEEL, START).choices(1e-3)]
    assert "option.tolerance" not in names


def test_exponents() -> None:
    pinned = Scene(WHEEL.gravity, WHEEL.points, WHEEL.bodies, WHEEL.joints, {}, {})
    tuned, rk4 = MuJoCo("tuned"), MuJoCo("own", {"integrator": "RK4"})
    assert planned(tuned, pinned, START).held_at(1e-3).exponents == (4, 5)
    assert planned(tuned, pinned, START).exponents == (2, 3)
    assert planned(tuned, WHEEL, START).exponents == (1, 2)
    assert planned(rk4, pinned, START).exponents == (4, 5)
    assert planned(MuJoCo("shipped"), pinned, START).exponents == (1, 2)
