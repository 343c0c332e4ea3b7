"""As much of JSON Schema as the case files' schema uses: whether data is valid, and where not."""

import re
from collections.abc import Iterator
from typing import Any

TYPES = {
    "object": dict,
    "array": list,
    "string": str,
    "number": (int, float),
    "integer": int,
    "boolean": bool,
}
KNOWN = {
    *("$defs", "$schema", "$ref", "title", "description", "type", "if", "then", "else", "default"),
    *("anyOf", "oneOf", "enum", "const", "pattern", "minimum", "maximum", "exclusiveMinimum"),
    *("properties", "required", "additionalProperties", "patternProperties", "propertyNames"),
    *("prefixItems", "items", "minItems", "maxItems", "minProperties", "maxProperties"),
}


def wrong(data: Any, schema: Any, root: Any, path: str = "") -> Iterator[str]:
    """Where the data is not valid, and by which word of the schema."""
    assert set(schema) <= KNOWN, set(schema) - KNOWN
    if "$ref" in schema:
        yield from wrong(data, root["$defs"][schema["$ref"].rpartition("/")[2]], root, path)
    yield from (f"{path}: {word}" for word in _plain(data, schema))
    for word, least, most in (("anyOf", 1, 9), ("oneOf", 1, 1)):
        if word in schema:
            fit = [not any(wrong(data, one, root)) for one in schema[word]]
            if not least <= sum(fit) <= most:
                yield f"{path}: {word}"
    if "if" in schema:
        branch = "else" if any(wrong(data, schema["if"], root)) else "then"
        yield from wrong(data, schema.get(branch, {}), root, path)
    if isinstance(data, dict):
        yield from _keys(data, schema, root, path)
    if isinstance(data, list):
        each = schema.get("prefixItems", [])
        for i, item in enumerate(data):
            one = each[i] if i < len(each) else schema.get("items", {})
            yield from wrong(item, one, root, f"{path}.{i}")


def _plain(data: Any, schema: Any) -> Iterator[str]:
    kind = schema.get("type")
    # To Python true is a number, too.
    fits = kind is None or isinstance(data, TYPES[kind])
    if not fits or (kind is not None and isinstance(data, bool) != (kind == "boolean")):
        yield "type"
        return
    number = isinstance(data, int | float) and not isinstance(data, bool)
    rules = {
        "enum": lambda value: data in value,
        "const": lambda value: data == value,
        "pattern": lambda value: not isinstance(data, str) or re.search(value, data),
        "minimum": lambda value: not number or data >= value,
        "maximum": lambda value: not number or data <= value,
        "exclusiveMinimum": lambda value: not number or data > value,
        "required": lambda value: not isinstance(data, dict) or set(value) <= set(data),
        "minItems": lambda value: not isinstance(data, list) or len(data) >= value,
        "maxItems": lambda value: not isinstance(data, list) or len(data) <= value,
        "minProperties": lambda value: not isinstance(data, dict) or len(data) >= value,
        "maxProperties": lambda value: not isinstance(data, dict) or len(data) <= value,
    }
    yield from (word for word, rule in rules.items() if word in schema and not rule(schema[word]))


def _keys(data: dict[str, Any], schema: Any, root: Any, path: str) -> Iterator[str]:
    patterns = schema.get("patternProperties", {})
    for key, value in data.items():
        place = f"{path}.{key}"
        found = [one for pattern, one in patterns.items() if re.search(pattern, key)]
        found += [schema["properties"][key]] if key in schema.get("properties", {}) else []
        if not found and "additionalProperties" in schema:
            if schema["additionalProperties"] is False:
                yield f"{place}: additionalProperties"
                continue
            found = [schema["additionalProperties"]]
        for one in found:
            yield from wrong(value, one, root, place)
        if "propertyNames" in schema:
            yield from wrong(key, schema["propertyNames"], root, place)
