"""Reads a case file into plain dictionaries with numbers in SI units."""

import copy
import math
import re
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

# Numbers with units become floats in SI: a table of its own, after the README's list.

PREFIXES = {
    "n": 1e-9, "u": 1e-6, "µ": 1e-6, "μ": 1e-6, "m": 1e-3, "c": 1e-2, "d": 1e-1,
    "h": 1e2, "k": 1e3, "M": 1e6, "G": 1e9,
}  # fmt: skip
UNITS = {
    "m": 1.0, "kg": 1.0, "g": 1e-3, "s": 1.0, "min": 60.0, "h": 3600.0, "rad": 1.0,
    "deg": math.pi / 180, "°": math.pi / 180, "rev": 2 * math.pi, "rpm": 2 * math.pi / 60,
    "Hz": 1.0, "N": 1.0, "J": 1.0, "W": 1.0, "A": 1.0, "C": 1.0, "T": 1.0,
}  # fmt: skip
NUMBER = re.compile(r"\s*([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)\s*(.*)")
FACTOR = re.compile(r"([*/ ]*)([A-Za-zµμ°]+)(?:\^|\*\*)?(-?\d+|[²³])?")


def factor(name: str) -> float:
    """The size of a unit in SI, which may have a prefix."""
    if name in UNITS:
        return UNITS[name]
    return PREFIXES[name[0]] * UNITS[name[1:]]


def unit(text: str) -> float:
    """The size in SI of units joined by a space, `*` or `/`, read from the left."""
    size = 1.0
    for joined, name, power in FACTOR.findall(text):
        exponent = {"": 1, "²": 2, "³": 3}.get(power) or int(power)
        size *= factor(name) ** (-exponent if "/" in joined else exponent)
    return size


def number(told: object, parameters: Mapping[str, float]) -> float:
    """The value of a literal, of a parameter's name, of its negative, or of a quantity."""
    if isinstance(told, (int, float)):
        return float(told)
    text = str(told)
    if text in parameters:
        return parameters[text]
    if text.startswith("-") and text[1:] in parameters:
        return -parameters[text[1:]]
    found = NUMBER.fullmatch(text)
    if found is None:
        raise ValueError(f"{text!r} is no number")
    return float(found[1]) * unit(found[2])


# A case file becomes plain dictionaries, one for each variant, with all its numbers in SI.

WORDS = {
    "title", "source", "system", "between", "on", "only", "ideal", "ahead_of", "pin",
    "slide", "slot", "weld", "distance", "hinge", "ball", "universal", "of", "edge", "spring",
    "damper", "rope", "push", "torque", "couple", "torsion", "torsion_damper", "motor", "stops",
    "drag", "viscous", "magnetic", "muscle", "linear_muscle", "seen", "drops_out",
    "rests", "stays",
}  # fmt: skip
"""Keys whose value is a name where it is no map: there a parameter of that name is not meant."""


def overlaid(base: Any, over: Any) -> Any:
    """The base with the keys of `over` in place of its own; maps merge to any depth."""
    if not (isinstance(base, dict) and isinstance(over, dict)):
        return copy.deepcopy(over)
    merged = dict(base)
    for key, value in over.items():
        merged[key] = overlaid(base[key], value) if key in base else copy.deepcopy(value)
    return merged


def valued(told: Any, parameters: dict[str, float]) -> Any:
    """The same structure with every number in SI, however it was written."""
    if isinstance(told, dict):
        return {
            key: value
            if key in WORDS and (isinstance(value, str) or names(value))
            else valued(value, parameters)
            for key, value in told.items()
        }
    if isinstance(told, list):
        return [valued(each, parameters) for each in told]
    if isinstance(told, bool) or told is None:
        return told
    try:
        return number(told, parameters)
    except (ValueError, KeyError):
        return told


def names(told: Any) -> bool:
    """Whether this is a list of parts, as `[ground.O, rod.start]`."""
    return isinstance(told, list) and all(
        isinstance(each, str) and ("." in each or each.isidentifier()) for each in told
    )


def settled(told: dict[str, Any]) -> dict[str, Any]:
    """One variant, with its numbers in place of the names of its parameters."""
    parameters = {key: number(value, {}) for key, value in (told.get("parameters") or {}).items()}
    return {
        key: valued(value, parameters)
        for key, value in told.items()
        if key in ("scene", "initial", "near", "events", "duration", "samples", "tube", "states")
    } | {"allow": list(told.get("allow") or {})}


def cases(told: dict[str, Any], name: str) -> dict[str, dict[str, Any]]:
    """Every variant by its name: `file.variant`, or `file` where there is none."""
    base = {key: value for key, value in told.items() if key != "variants"}
    variants = told.get("variants") or {}
    if not variants:
        return {name: settled(base)}
    return {f"{name}.{each}": settled(overlaid(base, over)) for each, over in variants.items()}


def text(told: str) -> dict[str, Any]:
    """What a YAML text says."""
    return YAML(typ="safe").load(told)


def file(path: Path) -> dict[str, dict[str, Any]]:
    """Every variant of a file, by its name."""
    return cases(text(path.read_text(encoding="utf-8")), path.stem)
