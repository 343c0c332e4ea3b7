"""cases/README.md and the JSON Schema of editors say what the grammar and the quantities say."""

import json
import re
from contextlib import nullcontext
from dataclasses import replace
from inspect import signature
from pathlib import Path

import pytest
from given.command.json_schema import wrong
from given.scenes.spatial_case import SOUND as SOUND_IN_SPACE

from textmech.cases import find
from textmech.cases.fields.friction_grammar import Coefficients, DryFriction
from textmech.cases.fields.number import amount
from textmech.cases.fields.part import written
from textmech.cases.find import models, shipped
from textmech.cases.language.document import read
from textmech.cases.language.grammar import file as grammar
from textmech.cases.language.grammar import joint
from textmech.cases.language.grammar import scene as words
from textmech.cases.language.grammar.contact import Contact as ContactSpec
from textmech.cases.language.grammar.contact import Rolling
from textmech.cases.language.grammar.file import File
from textmech.cases.language.grammar.model_file import ModelFile
from textmech.cases.language.grammar.scene import Scene
from textmech.cases.language.grammar.scene import SpatialScene as SpatialWords
from textmech.cases.language.grammar.schema import SCHEMA, text
from textmech.cases.language.grammar.start import Initial, SpatialStart, Turn
from textmech.cases.load import load
from textmech.cases.load_model import load_model
from textmech.cases.mistake import CaseError
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
    frame,
    planar_joint,
    shape,
    solid,
)
from textmech.cases.scene import DryFriction as Dry
from textmech.cases.scene import Scene as Resolved
from textmech.cases.scene import Scene as SpatialNouns
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.forces.limit import Rope, Stops
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.quantity import event_quantities, table

# cases/README.md says what the grammar and the table of quantities say, but for space.

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


# cases/README.md says of space what its grammar and its table of quantities say.

GROUND_O, BODY_POINT = Anchor("ground", "O"), Anchor("body", "point")


def test_the_example_in_space_loads(tmp_path: Path) -> None:
    path = tmp_path / "example.yaml"
    path.write_text(re.findall(r"```yaml\n(.*?)```", SPACE, flags=re.DOTALL)[0])
    (case,) = load(path)
    assert case.scene.frame.dimension == 3


def test_every_key_of_space_is_explained() -> None:
    code = re.findall(r"```yaml\n(.*?)```|`([^`]+)`", WHOLE, flags=re.DOTALL)
    said = set(re.findall(r"[a-zA-Z_]+", " ".join(block + word for block, word in code)))
    models = [SpatialWords, Rolling, SpatialStart, Turn, joint.FreeShift, joint.FreeTurn]
    for kinds in (
        words.BODY_KINDS[3],
        joint.KINDS[3],
        words.CONSTRAINT_KINDS[3],
        words.FORCE_KINDS[3],
    ):
        models += kinds.values()
    for model in models:
        assert set(model.model_fields) <= said, model
    for noun in solid.SHAPES.values():
        assert set(signature(noun).parameters) - {"name"} <= said, noun


def test_quantities_of_space() -> None:
    tensor = (1.0, 1.0, 1.0, 0.0, 0.0, 0.0)
    freedoms = (
        Freedom.shift((1.0, 0.0, 0.0), "s"),
        Freedom.turn((0.0, 0.0, 1.0), "theta"),
    )
    body = solid.rigid(name="body", mass=1, inertia=tensor, points={"point": (0.0, 0.0, 0.0)})
    one = Signal("constant", (1.0,))
    scene = SpatialNouns(
        frame=frame.SPACE,
        gravity=(0.0, 0.0, 0.0),
        points={},
        bodies={"body": body},
        joints={
            "joint": Joint("joint", "freedoms", GROUND_O, BODY_POINT, freedoms, frame=frame.SPACE)
        },
        contacts={"contact": spatial_contact("contact", Anchor("body", "center"), 1.0, rim=True)},
        forces={
            "line": Spring("line", GROUND_O, BODY_POINT, 1.0, 1.0),
            "torsion": Torsion("torsion", "joint.theta", 1.0, 0.0),
        },
        constraints={
            "constraint": Edge(
                "constraint", BODY_POINT, (1.0, 0.0, 0.0), kept=True, frame=frame.SPACE
            )
        },
        drives={"joint.s_dot": one, "joint.theta_dot": one},
    )
    rows = re.findall(r"^\| (`[a-z]+\..*?) \| (.*?) \|", SPACE, flags=re.MULTILINE)
    said = {name: unit for names, unit in rows for name in re.findall(r"`(.*?)`", names)}
    known = {name: q.unit for name, q in table(scene).items() if ".center." not in name}
    assert said == known


# The JSON Schema that editors use is the grammar's.


def test_current() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == text(), (
        "run `python -m textmech.cases.language.grammar.schema`"
    )


@pytest.mark.slow
def test_says_every_key() -> None:
    schema = json.loads(text())
    for branch, file in (("then", ModelFile), ("else", File)):
        assert set(schema[branch]["properties"]) == set(file.model_fields)
        assert schema[branch]["additionalProperties"] is False
    assert "null" not in text()


def found(path: Path) -> list[str]:
    """Where the file is not valid by the schema."""
    data = json.loads(json.dumps(read(path).data))  # with lists for tuples
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    return [*wrong(data, schema, schema)]


def test_shipped_files_are_valid() -> None:
    files = (shipped() | models()).values()
    assert {path.name: places for path in files if (places := found(path))} == {}


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ("control: {a: 1, b: {held: {times: [0, 1], values: [0, 2]}}, table: 3}", []),
        ("control: {table: policy.csv, between: lines}", []),
        ("initial: {joints: {a: 30 deg, b: [1, 0, 0, 0]}, random_rates: {seed: 3}}", []),
        ("allow: 1.0e-3\nvariants: {far: {duration: 3}}", []),
        ("scene: {}", [".scene: additionalProperties"]),
        ("intial: {}", [".intial: additionalProperties"]),
        ("initial: {keyfram: home}", [".initial.keyfram: additionalProperties"]),
        ("control: {a: {sinus: {amplitude: 1}}}", [".control: anyOf"]),
        ("contacts: maybe", [".contacts: enum"]),
        ("duration: -1", [".duration: anyOf"]),
        ("variants: {far: {title: x}}", [".variants.far.title: enum"]),
    ],
)
def test_a_model_has_its_own_words(tmp_path: Path, text: str, said: list[str]) -> None:
    """Which `load_model` takes and refuses too."""
    path = tmp_path / "own.yaml"
    path.write_text(f"model: robot.xml\n{text}\n", encoding="utf-8")
    (tmp_path / "policy.csv").write_text("time,a\n0,1\n1,2\n")
    assert found(path) == said
    with nullcontext() if not said else pytest.raises(CaseError):
        load_model(path)


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        ("space: 3", "space: 3", []),
        ("space: 3", "space: 2", [".scene.space: const"]),
        ("O: [0, 0, 0]", "O: [0, 0]", [".scene.points.O: oneOf"]),
        ("  drive:", "  drives:", [".scene.drives: additionalProperties"]),
        ("axis: [0, 0, 2]", "axes: [0, 0, 2]", [".scene.joints.q1: oneOf"]),
        ("size: [0.1, 0.2, 0.3]", "width: 0.1", [".scene.bodies.box: oneOf"]),
        ("globe: {x: 1.0", "globe: {x: [1.0]", [".initial.globe.x: oneOf"]),
        ("attitude: {axis", "attitude: {axle", [".initial.globe.attitude: oneOf"]),
    ],
)
def test_space_has_its_own_words(tmp_path: Path, old: str, new: str, said: list[str]) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(SOUND_IN_SPACE.replace(old, new), encoding="utf-8")
    assert found(path) == said


def test_the_plane_keeps_its_words(tmp_path: Path) -> None:
    """What is sound in space is not without `space: 3`."""
    path = tmp_path / "own.yaml"
    path.write_text(SOUND_IN_SPACE.replace("  space: 3\n", ""), encoding="utf-8")
    places = {place.partition(":")[0] for place in found(path)}
    assert {".scene.joints.q1", ".initial.top.P"} <= places


# cases/GLOSSARY.md has few words, each of them in the code or at the head of a table.

ROOT = Path(__file__).parents[2]
GLOSSARY = (ROOT / "cases/GLOSSARY.md").read_text("utf-8")
EXPLAINED = re.findall(r"^\| (\w+) \| .+ \|.*\|$", GLOSSARY, re.M)[1:]
MOST = 40


def lacking(explained: list[str]) -> list[str]:
    """The words that are in no module, and name no column of a table."""
    rooms = [ROOT / room for room in ("cases", "reference", "engines", "reports")]
    texts = [file.read_text("utf-8") for room in rooms for file in room.rglob("*.py")]
    heads = [
        file.read_text("utf-8").partition("\n")[0] for file in (ROOT / "reports").glob("*.csv")
    ]
    text = " ".join(texts + heads)
    return [word for word in explained if not re.search(rf"\b{word}\b", text)]


def test_the_glossary_has_few_words_and_all_are_ours() -> None:
    assert 30 <= len(EXPLAINED) == len({*EXPLAINED}) <= MOST
    assert lacking(EXPLAINED) == []
    assert lacking(["case", "hyperparameter"]) == ["hyperparameter"]
