"""The shipped case files, and what becomes of the words of the language."""

from dataclasses import fields
from math import cos, pi, radians, sin
from pathlib import Path

import pytest

from textmech.cases.case import Case, Deviation
from textmech.cases.fields.number import Names, amount, number
from textmech.cases.find import find, shipped
from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene import (
    STANDARD_GRAVITY,
    Anchor,
    GroundPoint,
    Push,
    Signal,
    Torque,
    planar_joint,
)
from textmech.reference.systems import SYSTEMS
from textmech.reference.systems.states.stated import STATED

PARAMETERS = {
    name: tuple(f.name for f in fields(system))  # type: ignore[arg-type]
    for name, system in {**SYSTEMS, **STATED}.items()
}


def cases_of(name: str) -> list[Case]:
    return load(*find([name]), systems=PARAMETERS)


@pytest.mark.parametrize("name", shipped())
def test_shipped(name: str) -> None:
    for case in cases_of(name):
        assert case.name.split(".")[0] == name
        assert case.origin.equations
        assert case.times[-1] == pytest.approx(case.duration, rel=1e-15)


def test_four_bar() -> None:
    (case,) = cases_of("four_bar")
    assert case.name == "four_bar"
    assert case.system == "four_bar"
    assert case.parameters["crank0"] == radians(70)
    assert str(case.origin) == "figure 2.3, (2.14), (2.60)"
    scene = case.scene
    assert list(scene.bodies) == ["crank", "coupler", "rocker"]
    assert scene.gravity == (0.0, -STANDARD_GRAVITY)
    assert scene.points == {"O": GroundPoint((0.0, 0.0)), "Q": GroundPoint((0.9, 0.0))}
    assert scene.bodies["coupler"].points["end"] == (0.4, 0.0)
    assert scene.joints["C"] == planar_joint(
        "C", "pin", Anchor("coupler", "end"), Anchor("rocker", "end")
    )
    assert case.initial["crank"].given == {"angle": radians(70)}
    assert case.near["rocker"].given == {"angle": pytest.approx(radians(96), rel=1e-15)}
    assert case.reach == {
        "mujoco": {"crank.angle": 1e-6},
        "pymunk": {"crank.angle": 4e-5},
        "pymunk.limit": {"crank.angle": 1e-8},
    }
    assert case.deviates["mujoco.shipped"]["crank.angle"].limit == 0.27


def test_what_every_variant_replaces_is_read_too(tmp_path: Path) -> None:
    """No variant shows it; what one of them leaves as it is, is said once and as its own."""
    path = tmp_path / "fall.yaml"
    path.write_text(
        """title: A fall
source: {section: "2"}
scene: {bodies: {ball: {particle: {mass: banana}}}}
initial: {ball: {x: 0, y: 1 kg}}
duration: soon
samples: 11
allow: {ball.y: 1e-3 kg}
variants:
  light: {scene: {bodies: {ball: {particle: {mass: 1}}}}, initial: {ball: {y: 1}}, duration: 1}
  heavy: {scene: {bodies: {ball: {particle: {mass: 2}}}}, initial: {ball: {y: 1}}}
"""
    )
    with pytest.raises(CaseError) as caught:
        load(path)
    found = {(m.line, m.where): m.what for m in caught.value.mistakes}
    hidden = {
        field
        for (_, field), what in found.items()
        if what.endswith("(the base's; each variant replaces it)")
    }
    assert hidden == {"scene.bodies.ball.particle.mass", "initial.ball.y"}
    assert "variant 'heavy'" in found[5, "duration"]


def test_variants() -> None:
    pushed, downhill = cases_of("rolling_wheel")
    assert (pushed.name, downhill.name) == ("rolling_wheel.pushed", "rolling_wheel.downhill")
    assert (pushed.parameters["F"], downhill.parameters["F"]) == (2.5, 0.0)
    assert pushed.scene.forces["hand"] == Push(
        "hand", Anchor("wheel", "center"), Signal("constant", (2.5, 0.0))
    )
    assert downhill.scene.gravity == pytest.approx(
        (STANDARD_GRAVITY * sin(pi / 9), -STANDARD_GRAVITY * cos(pi / 9)), rel=1e-15
    )
    assert downhill.initial["wheel"].given["omega"] == -1.6
    assert downhill.scene.contacts["touch"].friction == 0.5
    beta = downhill.mistake(("parameters", "beta"), "steep")
    assert beta.text.strip() == "parameters: {beta: 20 deg}"  # the variant's, not line 4's
    assert downhill.mistake(("parameters", "m"), "heavy").line == 4


def test_forces() -> None:
    (crank,) = cases_of("slider_crank")
    assert crank.system is None
    assert crank.scene.forces["motor"] == Torque(
        "motor", "crank", Signal("sine", (1.5,), 5.0, pi / 2)
    )
    (towed,) = cases_of("towed_pendulum")
    assert towed.scene.points["hook"] == GroundPoint((0.4, 0.0), (0.3, 0.0))
    assert towed.scene.forces["wind"] == Push(
        "wind", Anchor("bob", "end"), Signal("ramp", (1.5, 0.0))
    )


EVERYTHING = """\
title: Every word that no shipped case uses
scene:
  gravity: none
  bodies:
    plate: {rigid: {mass: 2.0, inertia: 0.5}, points: {P: [-0.1, 0.2]}}
    box: {block: {mass: 300 g, width: 10 cm, height: 0.2}}
  joints:
    fast: {weld: [plate.P, box.center], angle: 0.5 turn}
initial: {plate: {P: [1.0, 2], omega: 60 rpm}}
duration: 1.0
samples: 3
step: {mujoco: 1.0e-3}
allow: {plate.angle: 1 deg, fast.torque: unknown, box.x: 1.0e-3}
deviates:
  pymunk.tuned:
    plate.angle: {limit: 2 deg, because: soft}
    box.x: {by: [2 mm, 4 mm], because: softer}
rests: true
"""


def test_other_words(tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(EVERYTHING)
    (case,) = load(path)
    assert case.scene.gravity == (0.0, 0.0)
    assert case.scene.bodies["plate"].moment == 0.5
    assert case.scene.bodies["box"].mass == pytest.approx(0.3, rel=1e-15)
    assert case.scene.joints["fast"].angle == pytest.approx(pi, rel=1e-15)
    assert case.initial["plate"].points == {"P": (1.0, 2.0)}
    assert case.initial["plate"].given == {"omega": pytest.approx(2 * pi, rel=1e-15)}
    assert case.allow == {"plate.angle": radians(1), "fast.torque": None, "box.x": 1e-3}
    assert case.deviates["pymunk.tuned"] == {
        "plate.angle": Deviation("soft", limit=radians(2)),
        "box.x": Deviation("softer", by=(0.002, 0.004)),
    }
    assert case.rests


@pytest.mark.parametrize(
    ("words", "gravity"),
    [
        ("gravity: 1.62 m/s^2", (0, -1.62)),
        ("gravity: 1.62\n  incline: 30 deg", (0.81, -1.62 * cos(pi / 6))),
        ("gravity: [0.3, -1.62 m/s^2]", (0.3, -1.62)),
    ],
)
def test_other_gravity(tmp_path: Path, words: str, gravity: tuple[float, float]) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(EVERYTHING.replace("gravity: none", words))
    (case,) = load(path)
    assert case.scene.gravity == pytest.approx(gravity, rel=1e-15)


def test_a_ring_touches_with_its_rim(tmp_path: Path) -> None:
    """A rigid body with a radius rolls as a disk does, with an inertia of its own."""
    path = tmp_path / "own.yaml"
    ring = EVERYTHING.replace("inertia: 0.5}", "inertia: 0.5, radius: 0.5}")
    touch = "  contacts: {touch: {between: [plate, ground.floor], friction: 1.0, ideal: rolling}}\n"
    path.write_text(ring.replace("initial:", f"{touch}initial:"))
    (case,) = load(path)
    assert case.scene.bodies["plate"].radius == 0.5
    assert case.scene.bodies["plate"].moment == 0.5
    assert case.scene.contacts["touch"].at == Anchor("plate", "center")
    path.write_text(EVERYTHING.replace("initial:", f"{touch}initial:"))
    with pytest.raises(CaseError, match="'plate' is a rigid and touches with one point"):
        load(path)


def test_a_direction_is_a_unit_vector(tmp_path: Path) -> None:
    """A groove `along: [3, 4]` is not five times as long, nor its friction five times as strong."""
    path = tmp_path / "own.yaml"
    slide = "slide: [plate.P, box.center], along: [3, -4]"
    path.write_text(EVERYTHING.replace("weld: [plate.P, box.center], angle: 0.5 turn", slide))
    (case,) = load(path)
    assert case.scene.joints["fast"].along == pytest.approx((0.6, -0.8), rel=1e-15)


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("30 deg", "rad", pi / 6),
        ("-30 deg", "rad", -pi / 6),
        ("30°", "rad", pi / 6),
        ("20 rpm", "rad/s", 2 * pi / 3),
        ("1.5 turn/s", "rad/s", 3 * pi),
        ("80 cm", "m", 0.8),
        ("36 km/h", "m/s", 10.0),
        ("1.2 kN/m", "N/m", 1200.0),
        ("3 N s/m", "N s/m", 3.0),
        ("3 N*s/m", "N s/m", 3.0),
        ("2 kg m^2", "kg m²", 2.0),
        ("2 kg·m²", "kg m²", 2.0),
        ("1e-3 J", "N m", 1e-3),
        ("250 ms", "s", 0.25),
        (3, "kg", 3.0),
        ("l", "m", 0.8),
        ("-l", "m", -0.8),
    ],
)
def test_number(text: object, unit: str, value: float) -> None:
    found = number(text, unit, Names({"l": amount("80 cm")}))
    assert found is not None
    assert found.value == pytest.approx(value, rel=1e-15)
