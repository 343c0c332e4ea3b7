"""The JSON Schema that editors use is the grammar's."""

import json
from pathlib import Path

import pytest
from given.json_schema import wrong
from given.spatial_case import SOUND as SPATIAL

from textmech.cases.find import shipped
from textmech.cases.language.document import read
from textmech.cases.language.grammar.file import File
from textmech.cases.language.grammar.schema import SCHEMA, text


def test_current() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == text(), (
        "run `python -m textmech.cases.language.grammar.schema`"
    )


@pytest.mark.slow
def test_says_every_key() -> None:
    schema = json.loads(text())
    assert set(schema["properties"]) == set(File.model_fields)
    assert "null" not in text()
    assert schema["additionalProperties"] is False


def found(path: Path) -> list[str]:
    """Where the file is not valid by the schema."""
    data = json.loads(json.dumps(read(path).data))  # with lists for tuples
    schema = json.loads(SCHEMA.read_text(encoding="utf-8"))
    return [*wrong(data, schema, schema)]


@pytest.mark.parametrize("path", shipped().values(), ids=shipped())
def test_shipped_files_are_valid(path: Path) -> None:
    assert found(path) == []


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
    path.write_text(SPATIAL.replace(old, new), encoding="utf-8")
    assert found(path) == said


def test_the_plane_keeps_its_words(tmp_path: Path) -> None:
    """What is sound in space is not without `space: 3`."""
    path = tmp_path / "own.yaml"
    path.write_text(SPATIAL.replace("  space: 3\n", ""), encoding="utf-8")
    places = {place.partition(":")[0] for place in found(path)}
    assert {".scene.joints.q1", ".initial.top.P"} <= places
