"""A case file becomes plain dictionaries, one for each variant, with all its numbers in SI."""

import copy
from pathlib import Path
from typing import Any

from ruamel.yaml import YAML

from second.units import number

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
