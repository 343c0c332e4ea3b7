"""The JSON Schema that editors use is the grammar's."""

import json

from textmech.cases.language.grammar.file import File
from textmech.cases.language.grammar.schema import SCHEMA, text


def test_current() -> None:
    assert SCHEMA.read_text(encoding="utf-8") == text(), (
        "run `python -m textmech.cases.language.grammar.schema`"
    )


def test_says_every_key() -> None:
    schema = json.loads(text())
    assert set(schema["properties"]) == set(File.model_fields)
    assert "null" not in text()
    assert schema["additionalProperties"] is False
