"""Numbers with units become floats in SI: a table of its own, after the README's list."""

import math
import re
from collections.abc import Mapping

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
