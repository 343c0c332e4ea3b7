"""cases/README.md says what the grammar and the table of quantities say, but for space."""

import re
from dataclasses import replace
from inspect import signature
from pathlib import Path

from textmech.cases import find
from textmech.cases.fields.friction_grammar import Coefficients, DryFriction
from textmech.cases.fields.number import amount
from textmech.cases.fields.part import written
from textmech.cases.language.grammar import file as grammar
from textmech.cases.language.grammar import joint
from textmech.cases.language.grammar import scene as words
from textmech.cases.language.grammar.contact import Contact as ContactSpec
from textmech.cases.language.grammar.file import File
from textmech.cases.language.grammar.scene import Scene
from textmech.cases.language.grammar.start import Initial
from textmech.cases.load import load
from textmech.cases.scene import (
    Anchor,
    Bounds,
    Contact,
    Drag,
    Edge,
    LinearMuscle,
    Signal,
    Smooth,
    Spring,
    Torsion,
    Viscous,
    planar_joint,
    shape,
)
from textmech.cases.scene import DryFriction as Dry
from textmech.cases.scene import Scene as Resolved
from textmech.cases.scene.forces.limit import Rope, Stops
from textmech.cases.scene.quantity import event_quantities, table

WHOLE = Path(find.__file__).with_name("README.md").read_text(encoding="utf-8")
PLANE, _, _rest = WHOLE.partition("## Space\n")
SPACE, _, _rest = _rest.partition("## Variants\n")
README = PLANE + _rest


def test_example_loads(tmp_path: Path) -> None:
    path = tmp_path / "example.yaml"
    path.write_text(re.findall(r"```yaml\n(.*?)```", README, flags=re.DOTALL)[0])
    assert [case.name for case in load(path)] == ["example.stiff", "example.soft"]


def test_every_key_is_explained() -> None:
    code = re.findall(r"```yaml\n(.*?)```|`([^`]+)`", README, flags=re.DOTALL)
    said = set(re.findall(r"[a-z_]+", " ".join(block + word for block, word in code)))
    models = [File, Scene, grammar.Source, grammar.Deviation, Initial]
    models += [ContactSpec, Coefficients, DryFriction]
    for kinds in (
        words.BODY_KINDS[2],
        joint.KINDS[2],
        words.CONSTRAINT_KINDS[2],
        words.FORCE_KINDS[2],
    ):
        models += kinds.values()
    for model in models:
        assert set(written(model)) <= said, model
    for noun in (Bounds, Smooth, *shape.SHAPES.values()):
        assert set(signature(noun).parameters) - {"name"} <= said, noun


def test_quantities() -> None:
    a, b = Anchor("ground", "O"), Anchor("body", "point")
    dry = Dry(Bounds(1.0, 1.0), Bounds(1.0, 1.0))
    scene = Resolved(
        gravity=(0.0, 0.0),
        points={},
        bodies={"body": shape.disk(name="body", mass=1, radius=1, points={"point": (0, 0)})},
        joints={"joint": planar_joint("joint", "slide", a, b, dry_friction=dry)},
        contacts={
            "contact": Contact("contact", Anchor("body", "center"), 1.0, 1.0, ideal="rolling")
        },
        forces={
            "line": Spring("line", a, b, 1.0, 1.0),
            "torsion": Torsion("torsion", "joint", 1.0, 0.0),
            "muscle": LinearMuscle("muscle", a, b, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0),
            "rope": Rope("rope", a, b, 1.0),
            "stops": Stops("stops", "joint", 0.0, 1.0),
            "drag": Drag("drag", b, 1.0, 2.0),
            "viscous": Viscous("viscous", "joint", Bounds(1.0, 1.0), 2.0),
        },
        constraints={"constraint": Edge("constraint", b, (1.0, 0.0), Signal("ramp", (1.0,)))},
    )
    rows = re.findall(r"^\| (`[a-z]+\..*?) \| (.*?) \|", PLANE, flags=re.MULTILINE)
    said = {name: unit for names, unit in rows for name in re.findall(r"`(.*?)`", names)}
    pinned = replace(scene, joints={"joint": planar_joint("joint", "pin", a, b)})
    driven = replace(scene, drives={"joint.speed": Signal("constant", (1.0,))})
    known = table(scene) | table(pinned) | table(driven)
    quantities = known | event_quantities(["event"])
    units = {name: q.unit for name, q in quantities.items() if ".center." not in name}
    assert said == units


def test_units() -> None:
    sentence = re.search(r"Units: (.*?), with the prefixes n to G", README, flags=re.DOTALL)
    assert sentence is not None
    for unit in re.findall(r"[\w°]+", sentence[1]):
        assert amount(f"1 {unit}").dimension is not None
