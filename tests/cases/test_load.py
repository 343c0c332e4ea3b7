"""The shipped case files, and what becomes of the words of the language."""

from dataclasses import fields, replace
from math import cos, pi, radians, sin
from pathlib import Path

import pytest
from given import scenes
from given.otherwise import otherwise
from given.scenes import cases_of, mistakes_of

from textmech.cases import theme
from textmech.cases import titled as listing
from textmech.cases.case import Case, Deviation, Event
from textmech.cases.fields.number import Names, amount, number
from textmech.cases.find import find, is_shipped, shipped
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
from textmech.cases.scene.quantity import event_quantities
from textmech.cases.theme import THEMES, themes
from textmech.cases.titled import titled
from textmech.reference.systems import SYSTEMS
from textmech.reference.systems.states.stated import STATED

PARAMETERS = {
    name: tuple(f.name for f in fields(system))  # type: ignore[arg-type]
    for name, system in {**SYSTEMS, **STATED}.items()
}


def shipped_cases(name: str) -> list[Case]:
    return load(*find([name]), systems=PARAMETERS)


def test_four_bar() -> None:
    (case,) = shipped_cases("four_bar")
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


def test_what_every_variant_replaces_is_read_too() -> None:
    """No variant shows it; what one of them leaves as it is, is said once and as its own."""
    told = mistakes_of(
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
    found = {(m.line, m.where): m.what for m in told}
    hidden = {
        field
        for (_, field), what in found.items()
        if what.endswith("(the base's; each variant replaces it)")
    }
    assert hidden == {"scene.bodies.ball.particle.mass", "initial.ball.y"}
    assert "variant 'heavy'" in found[5, "duration"]


def test_variants() -> None:
    pushed, downhill = shipped_cases("rolling_wheel")
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
    (crank,) = shipped_cases("slider_crank")
    assert crank.system is None
    assert crank.scene.forces["motor"] == Torque(
        "motor", "crank", Signal("sine", (1.5,), 5.0, pi / 2)
    )
    (towed,) = shipped_cases("towed_pendulum")
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


def test_other_words() -> None:
    (case,) = cases_of(EVERYTHING)
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
def test_other_gravity(words: str, gravity: tuple[float, float]) -> None:
    (case,) = cases_of(EVERYTHING.replace("gravity: none", words))
    assert case.scene.gravity == pytest.approx(gravity, rel=1e-15)


def test_a_ring_touches_with_its_rim() -> None:
    """A rigid body with a radius rolls as a disk does, with an inertia of its own."""
    ring = EVERYTHING.replace("inertia: 0.5}", "inertia: 0.5, radius: 0.5}")
    touch = "  contacts: {touch: {between: [plate, ground.floor], friction: 1.0, ideal: rolling}}\n"
    (case,) = cases_of(ring.replace("initial:", f"{touch}initial:"))
    assert case.scene.bodies["plate"].radius == 0.5
    assert case.scene.bodies["plate"].moment == 0.5
    assert case.scene.contacts["touch"].at == Anchor("plate", "center")
    (mistake,) = mistakes_of(EVERYTHING.replace("initial:", f"{touch}initial:"))
    assert mistake.what.startswith("'plate' is a rigid and touches with one point")


def test_a_direction_is_a_unit_vector() -> None:
    """A groove `along: [3, 4]` is not five times as long, nor its friction five times as strong."""
    slide = "slide: [plate.P, box.center], along: [3, -4]"
    weld = "weld: [plate.P, box.center], angle: 0.5 turn"
    (case,) = cases_of(EVERYTHING.replace(weld, slide))
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


# Case files with contacts that open, slide and stick, with dry friction, and with events.

BACKSPIN = """\
title: Disk thrown up an incline with backspin slides, then rolls
source: {equations: ["2.16", "2.23", "2.34", "2.87"]}
parameters: {m: 1.3, R: 0.25, mu: 0.4, beta: 10 deg, v0: 3.0, w0: 20.0}
drops_out: [m]
scene:
  incline: beta
  bodies: {wheel: {disk: {mass: m, radius: R}}}
  contacts:
    touch: {between: [wheel, ground.floor], friction: mu}
initial: {wheel: {x: 0, y: R, vx: -v0, omega: -w0}}
events: {rolls: {touch.slip: stays zero}}
duration: 2.0
samples: 51
step: {mujoco: 1.0e-4, pymunk: 1.0e-4}
allow: {wheel.x: 1.0e-3, touch.slip: 1.0e-3, rolls.time: 1 ms, rolls.count: 0.5}
reach:
  mujoco: {wheel.x: 5.0e-6, rolls.time: 5.0e-6}
"""


def test_a_variant_changes_the_friction_alone() -> None:
    variants = "variants:\n  rough: {scene: {contacts: {touch: {friction: 0.9}}}}\n"
    variants += "  bare: {events: {rolls: {touch.slip: leaves zero}}}\n"
    rough, bare = cases_of(BACKSPIN + variants)
    assert rough.scene.contacts["touch"].static == 0.9
    assert rough.events == {"rolls": Event("touch.slip", "stays zero")}
    assert bare.events == {"rolls": Event("touch.slip", "leaves zero")}


@pytest.mark.parametrize(
    ("old", "new", "places"),
    [
        ("touch.slip: stays", "touch.slip: stay", ["events.rolls.touch.slip"]),
        ("events: {rolls: {touch.slip: stays zero}}", "events: 3", ["events"]),
        ("friction: mu}", "friction: -1}", ["scene.contacts.touch.friction"]),
    ],
)
def test_a_mistaken_part_drags_nothing_along(old: str, new: str, places: list[str]) -> None:
    """Neither the bounds of a mistaken event nor the event of a mistaken contact are mistakes."""
    text = BACKSPIN.replace(old, new).replace("drops_out: [m]\n", "system: any\n")
    assert [m.where for m in mistakes_of(text)] == places


def test_event_quantities() -> None:
    found = event_quantities({"rolls": Event("touch.slip", "stays zero")})
    assert [(q.name, q.part, q.unit, q.kind) for q in found.values()] == [
        ("rolls.time", "rolls", "s", "event"),
        ("rolls.count", "rolls", "1", "event"),
    ]


# A list says of each case what the case says of itself, though it reads less of the file.


def said(file: Path) -> list[tuple[object, ...]]:
    return [(one.name, one.title, one.origin, one.file) for one in titled(file)]


@pytest.mark.mutant("a list of a file reads no variants")
@pytest.mark.slow
def test_a_list_says_what_the_cases_say(monkeypatch: pytest.MonkeyPatch) -> None:
    for file in shipped().values():
        assert said(file) == [(c.name, c.title, c.origin, c.source.file) for c in load(file)]
    monkeypatch.setattr(listing, "SAID", ("title", "source", ""))
    many = shipped()["rolling_wheel"]
    assert len(said(many)) == 1 < len(load(many))


@pytest.mark.parametrize(
    ("head", "key"),
    [
        ("title: [a]\nsource: {figure: 3}", "title"),
        ("title: a\nsource: {figure: 3}", "source.figure"),
        ("title: a\nsource: {example: {}}", "source.example"),
        ("title: a\nsource: a", "source"),
        ("title: a\nsource: {example: '2.1'}\nvariants: [b]", "variants"),
    ],
)
def test_a_list_of_a_mistaken_file_says_where(head: str, key: str, tmp_path: Path) -> None:
    file = tmp_path / "case.yaml"
    file.write_text(f"scene: {{bodies: {{}}}}\n{head}\n", encoding="utf-8")
    with pytest.raises(CaseError) as caught:
        titled(file)
    assert key in {m.where for m in caught.value.mistakes}


def test_a_shipped_file_is_told_by_its_place(tmp_path: Path) -> None:
    assert all(map(is_shipped, shipped().values()))
    mine = tmp_path / "four_bar.yaml"
    mine.write_bytes(shipped()["four_bar"].read_bytes())
    (tmp_path / "cases").symlink_to(shipped()["four_bar"].parent)
    assert not is_shipped(mine)
    assert is_shipped(tmp_path / "cases" / "four_bar.yaml")
    assert not is_shipped(shipped()["four_bar"].with_name("no_such_case.yaml"))


# Themes are told from the scene alone: some cases, as a person would sort them.


@pytest.fixture
def every_case() -> list[Case]:
    """All shipped cases."""
    return [*scenes.EVERY.values()]


@pytest.mark.parametrize(
    ("name", "about"),
    [
        ("bar_pendulum", {"pins"}),
        ("double_pendulum", {"pins"}),
        ("four_bar", {"loops"}),
        ("slider_crank", {"loops", "springs", "driven"}),
        ("rolling_wheel.downhill", {"rolling", "driven"}),
        ("sliding_block.braking", {"friction"}),
        ("bouncing_disk.elastic", {"friction", "impacts"}),
        ("rimless_wheel", {"friction", "impacts"}),
        ("growing_force", {"friction", "driven"}),
        ("sleigh.spin", {"rolling"}),
        ("falling_drag", {"drag"}),
        ("spatial_four_bar", {"loops", "space"}),
        ("heavy_top.cusp", {"pins", "space"}),
        ("robot_states", {"space", "states"}),
        ("muscle_load", {"springs"}),
    ],
)
def test_a_case_is_about(name: str, about: set[str], every_case: list[Case]) -> None:
    (case,) = [case for case in every_case if case.name == name]
    assert set(themes(case)) == about


def test_every_case_is_about_something_that_has_a_meaning(every_case: list[Case]) -> None:
    for case in every_case:
        assert set(themes(case)) & (set(THEMES) - {"driven", "space"}), case.name


@pytest.mark.mutant("every contact is one with friction")
@pytest.mark.parametrize(
    ("friction", "about"), [(0.0, {"impacts"}), (0.3, {"impacts", "friction"})]
)
def test_a_smooth_contact_has_no_friction(
    friction: float, about: set[str], every_case: list[Case]
) -> None:
    (case,) = [case for case in every_case if case.name == "bouncing_disk.elastic"]
    ((name, contact),) = case.scene.contacts.items()
    other = replace(contact, static=friction, kinetic=friction)
    smooth = replace(case, scene=replace(case.scene, contacts={name: other}))
    assert set(themes(smooth)) == about
    blind = otherwise(theme, "c.switches and c.static > 0.0", "c.switches")
    assert set(blind.themes(smooth)) == {"impacts", "friction"}
