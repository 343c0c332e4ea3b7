"""The JSON Schema of a case file, for editors.

`python -m textmech.cases.language.grammar.schema` writes it.
"""

import json
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from pydantic.json_schema import GenerateJsonSchema, models_json_schema
from pydantic_core import core_schema

from .file import File, SpatialFile
from .model_file import ModelFile

FILES: tuple[Any, ...] = (File, SpatialFile, ModelFile)
SCHEMA = Path(__file__).parents[2] / "case.schema.json"


class _Plain(GenerateJsonSchema):
    """Without the nulls of absent keys, which a case file cannot write, and without titles."""

    def nullable_schema(self, schema: core_schema.NullableSchema) -> dict[str, Any]:
        return self.generate_inner(schema["schema"])

    def default_schema(self, schema: core_schema.WithDefaultSchema) -> dict[str, Any]:
        return self.generate_inner(schema["schema"])

    def dict_schema(self, schema: core_schema.DictSchema) -> dict[str, Any]:
        """Names that do not fit the pattern are mistakes."""
        result = super().dict_schema(schema)
        return result | {"additionalProperties": False} if "patternProperties" in result else result


_OF_STATES = {"required": ["states"]}
_MOVES = ("initial", "duration", "samples")  # what only a claim about a motion has to say
_IN_SPACE = {"required": ["scene"], "properties": {"scene": {"required": ["space"]}}}


def text() -> str:
    """The schema as it stands in cases/case.schema.json.

    What may stand in a file depends on whether it has a `model`, and else on whether its scene says
    `space: 3`, and what has to on whether it claims states.
    """
    head = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "textmech case"}
    schemas, definitions = models_json_schema(
        [(file, "validation") for file in FILES], schema_generator=_Plain
    )
    known = _without_titles(definitions["$defs"])
    plane, space, model = (known.pop(_name(schemas[file, "validation"])) for file in FILES)
    vary = [key for key, value in plane["properties"].items() if value != space["properties"][key]]
    both = {key: {} if key in vary else value for key, value in plane["properties"].items()}
    of_plane, of_space = (
        {"properties": {key: kind["properties"][key] for key in vary}} for kind in (plane, space)
    )
    choice = {"if": _IN_SPACE, "then": of_space, "else": of_plane}
    required = [key for key in plane["required"] if key not in _MOVES]
    moves = {"anyOf": [_OF_STATES, {"required": [*_MOVES]}]}
    scene = {**plane, "properties": both, "required": required, **choice, **moves}
    schema = {"$defs": known, "if": {"required": ["model"]}, "then": model, "else": scene}
    return json.dumps(head | schema, indent=1, ensure_ascii=False) + "\n"


def _name(reference: Mapping[str, Any]) -> str:
    return str(reference["$ref"]).rpartition("/")[2]


def _without_titles(schema: Any) -> Any:
    """`title` is a key of a case too: only the text that pydantic puts there is dropped."""
    if isinstance(schema, dict):
        return {
            key: _without_titles(value)
            for key, value in schema.items()
            if not (key == "title" and isinstance(value, str))
        }
    return [_without_titles(v) for v in schema] if isinstance(schema, list) else schema


if __name__ == "__main__":
    SCHEMA.write_text(text(), encoding="utf-8")
