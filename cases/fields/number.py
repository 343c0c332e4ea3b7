"""Numbers of a case: a literal, a parameter's name, `-name`, or a quantity with its unit."""

import math
import operator
import re
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cache
from typing import Any

from ..mistake import nearest

_NAME = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
_LITERAL = r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?"
_OPERAND = rf"({_LITERAL}|-?{_NAME.pattern})"
_OF_TWO = re.compile(rf"{_OPERAND}\s*([*/+-])\s*{_OPERAND}")
_OPERATORS = {"*": operator.mul, "/": operator.truediv, "+": operator.add, "-": operator.sub}
_FORMULA = re.compile(r"[A-Za-z0-9_.()^*/+ -]*[(^*/+][A-Za-z0-9_.()^*/+ -]*")
_TERM = r"(?:[A-Za-zµμ°]{1,12}(?:(?:\^|\*\*)-?[1-4]|[²³⁴])?)"
_QUANTITY = re.compile(rf"({_LITERAL})\s*({_TERM}(?:\s*[ */·]\s*{_TERM}){{0,5}})")

# The units a case can use. The angle is a dimension of its own here (to pint's own table it is
# none), so that an angle is no friction coefficient. So is what Hz counts: 2 Hz could mean 2 or
# 4π rad/s, and N m/Hz as many N m s/rad; no field takes it. A gram is a gramme by name: pint would
# read `kilogram` as kilo and gram, and the gram is defined by the kilogram.
_UNITS = """
nano- = 1e-9 = n-
micro- = 1e-6 = µ- = μ-
milli- = 1e-3 = m-
centi- = 1e-2 = c-
kilo- = 1e3 = k-
mega- = 1e6 = M-
giga- = 1e9 = G-
meter = [length] = m = metre
kilogram = [mass] = kg
second = [time] = s
radian = [angle] = rad
gramme = 1e-3 kilogram = g = gram
minute = 60 second = min
hour = 3600 second = h
degree = 3.141592653589793 / 180 radian = deg = °
revolution = 360 degree = rev = turn
rpm = revolution / minute
hertz = [frequency] = Hz
newton = kilogram * meter / second**2 = N
joule = newton * meter = J
watt = joule / second = W
ampere = [current] = A
coulomb = ampere * second = C
tesla = kilogram / ampere / second**2 = T
"""
# In SI: an electron has 9e-31 kg, a molecule 1e-46 kg m². Products of five within
# them are doubles, which go from 1e-308 to 1e308.
SMALLEST, LARGEST = 1e-60, 1e30
TURN = 2 * math.pi
SHORT = 60  # letters of a number: no search is long
_KNOWN = ("m", "mm", "cm", "kg", "g", "s", "ms", "rad", "deg", "rpm", "N", "kN", "J", "W")


class NumberMistake(ValueError):
    """Raised for a number that is wrong; its text says in words what is wrong."""


@dataclass(frozen=True)
class Amount:
    """A value in SI. `dimension` is None for a plain literal, which fits every field."""

    value: float
    dimension: str | None = None
    text: str = ""


@dataclass(frozen=True)
class Names:
    """The parameters that numbers may name; None is one that is itself mistaken."""

    amounts: Mapping[str, Amount | None] = field(default_factory=dict)


def shown(value: object) -> str:
    """A value of the file as a message shows it: `text 'abc'`, `the number 3`, `a map`."""
    if isinstance(value, bool):
        return str(value).lower()
    if isinstance(value, str):
        return f"text {value if len(value) <= 40 else value[:40] + '…'!r}"
    if isinstance(value, int | float):
        return f"the number {value}"
    return "a map" if isinstance(value, dict) else "a list"


NONE = Names()
MISTAKEN = object()
"""What stands in a file's data for a number that is wrong, and has been said to be."""


def names(parameters: object) -> Names:
    """The amounts of a file's parameters; their mistakes are found by the grammar."""
    amounts: dict[str, Amount | None] = {}
    for name, value in parameters.items() if isinstance(parameters, dict) else ():
        try:
            amounts[name] = amount(value)
        except NumberMistake:
            amounts[name] = None
    return Names(amounts)


def amount(value: object, known: Names = NONE) -> Amount:
    """Reads a literal or a quantity with its unit, in SI; `known` serves a formula's refusal."""
    if isinstance(value, int | float) and not isinstance(value, bool):
        return Amount(_check_size(float(value), value))
    short = isinstance(value, str) and len(value) <= SHORT
    if short and (match := _QUANTITY.fullmatch(str(value))):
        return _amount_with_unit(float(match[1]), match[2], str(value))
    if isinstance(value, str) and re.fullmatch(_LITERAL, value):
        raise NumberMistake(f"should be a number, is {shown(value)}; remove the quotes")
    text = str(value).strip() if short else ""
    if _is_formula(text) and all(word == "pi" or word in known.amounts for word in _words(text)):
        raise NumberMistake(f"{value!r} is not computed: write {_suggestion(text, known)}")
    raise NumberMistake(f"should be a number, is {shown(value)}")


def parameters_in(text: str, parameters: Collection[str]) -> set[str]:
    """The parameters that a text names: as a number, as `-name`, or in a formula."""
    whole = not _is_formula(text) or _QUANTITY.fullmatch(text)
    words = [text.removeprefix("-")] if whole else _words(text)
    return {word for word in words if word in parameters}


def _is_formula(text: str) -> bool:
    return len(text) <= SHORT and bool(_FORMULA.fullmatch(text))


def _words(formula: str) -> list[str]:
    parts = re.findall(rf"{_NAME.pattern}|{_LITERAL}", formula)
    return [part for part in parts if _NAME.fullmatch(part)]


def _suggestion(formula: str, known: Names) -> str:
    """The value to write in place of a formula, in words; only of two numbers is it computed."""
    of_two = _OF_TWO.fullmatch(formula)
    x, y = (_operand(word, known) for word in of_two.group(1, 3)) if of_two else (None, None)
    if of_two is None or x is None or y is None or (of_two[2] == "/" and not y):
        return "the number"
    result = _OPERATORS[of_two[2]](x, y)
    if not math.isfinite(result):
        return "the number"
    angle = f", or {math.degrees(result):g} deg" if "pi" in of_two.group(1, 3) else ""
    return f"{result:.10g}{angle}"


def _operand(word: str, known: Names) -> float | None:
    """The value of a number, a parameter or pi; None of a parameter that is itself mistaken."""
    if not (words := _words(word)):
        return float(word)
    operand = Amount(math.pi) if words == ["pi"] else known.amounts[words[0]]
    return None if operand is None else -operand.value if word.startswith("-") else operand.value


def number(value: object, unit: str | None, known: Names) -> Amount | None:
    """Returns a number in SI; None if its mistake, or its parameter's, is already reported."""
    if value is MISTAKEN:
        return None
    if not isinstance(value, str) or not _NAME.fullmatch(name := value.removeprefix("-")):
        return check_angle(check_unit(amount(value, known), unit), unit)
    if not known.amounts:
        raise NumberMistake(f"should be a number, is {shown(value)}")
    if name not in known.amounts:
        raise NumberMistake(f"unknown parameter {name!r}{nearest(name, known.amounts)}")
    entry = known.amounts[name]
    if entry is None:
        return None
    sign = -1.0 if value.startswith("-") else 1.0
    as_typed = entry.text or f"{entry.value:g}"
    if sign < 0.0:
        as_typed = as_typed[1:] if as_typed.startswith("-") else f"-{as_typed}"
    text = f"{value} = {as_typed}"
    return check_angle(check_unit(Amount(sign * entry.value, entry.dimension, text), unit), unit)


def check_angle(given: Amount, unit: str | None) -> Amount:
    """Return the amount. Raises NumberMistake for a plain angle of more than one turn."""
    if unit == "rad" and given.dimension is None and abs(given.value) > TURN:
        raise NumberMistake(
            f"is {given.text or f'{given.value:g}'} rad, which is {given.value / TURN:.2g} turns: "
            f"write {given.value:g} deg, or {given.value:g} rad"
        )
    return given


def check_unit(given: Amount, unit: str | None) -> Amount:
    """Return the amount. Raises NumberMistake unless `unit` (None: any) fits it."""
    if unit is None or given.dimension is None or given.dimension == _dimension(unit):
        return given
    if given.dimension == _without_angle(_dimension(unit)):  # a radian is 1: N m for N m/rad
        return given
    wanted = "a plain number" if unit == "1" else unit
    turns = "[angle]" in _dimension(unit) or unit == "1"
    counts = turns and "[frequency]" in given.dimension
    hint = "; Hz may count turns or radians: write rpm or rad/s" if counts else ""
    raise NumberMistake(f"is {given.text!r}, but {wanted} was expected{hint}")


def per_second(unit: str, times: int) -> str:
    """The unit's rate: N once is N/s, m/s once is m/s²."""
    if not times:
        return unit
    exponent = times + unit.endswith("/s")
    raised = "" if exponent == 1 else str(exponent).translate(_RAISED)
    return f"{unit.removesuffix('/s')}/s{raised}"


_RAISED = str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹")


def _amount_with_unit(value: float, unit: str, text: str) -> Amount:
    converted = _quantity(value, unit)
    size = _check_size(float(converted.magnitude), repr(text))
    return Amount(size, str(converted.dimensionality), text)


def _check_size(value: float, text: object) -> float:
    """Return the value. Raises NumberMistake unless it is finite and of a sensible size."""
    if not math.isfinite(value):
        raise NumberMistake(f"must be finite, is {text}")
    if value and not SMALLEST <= abs(value) <= LARGEST:
        raise NumberMistake(f"must be 0 or from {SMALLEST:g} to {LARGEST:g} in SI, is {text}")
    return value


def _without_angle(dimension: str) -> str:
    """The dimension without its angle if it has a mass; else empty, as 1/s may count turns."""
    return re.sub(r" [*/] \[angle\]", "", dimension) if "[mass]" in dimension else ""


@cache
def _dimension(unit: str) -> str:
    return str(_quantity(1.0, unit).dimensionality) if unit != "1" else "dimensionless"


def _quantity(value: float, unit: str) -> Any:
    try:
        registry = _registry()
        return registry.Quantity(value, registry.parse_units(unit)).to_base_units()
    except (AttributeError, ValueError):  # pint's UndefinedUnitError, and its word for `nan`
        words = re.findall(r"[A-Za-zµμ°]+", unit)
        units = _split_units(words[0]) if len(words) == 1 else ()
        # grams come first: kgg is a slip
        hint = f"; did you mean {' '.join(units)!r}?" if units and "g" not in units[1:] else ""
        hint = hint or (nearest(words[0], _KNOWN) if len(words) == 1 else "")
        raise NumberMistake(f"unknown unit {unit!r}{hint}") from None


def _split_units(word: str) -> tuple[str, ...]:
    """Split a word such as Nm into its units; empty if it is not made of known units."""
    for known in sorted(_KNOWN, key=len):
        if word == known:
            return (known,)
        if word.startswith(known) and (rest := _split_units(word.removeprefix(known))):
            return known, *rest
    return ()


@cache
def _registry() -> Any:
    """pint, imported only when a unit is met."""
    import pint

    registry = pint.UnitRegistry(None)  # type: ignore[arg-type]  # no table of its own
    registry.load_definitions(_UNITS.strip().splitlines())
    return registry
