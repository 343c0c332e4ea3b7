"""The kinds of value a case file is made of, as annotations that pydantic understands.

Each says itself what is wrong, in words for the person who wrote the file, and describes itself
in the JSON Schema for that person's editor.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from cases.number import Amount, Names, NumberMistake, amount, number, shown
from cases.quantity import RESERVED, nearest
from cases.words import wrong

IDENTIFIER = "[A-Za-z_][A-Za-z0-9_]*"
LITERAL_OR_UNIT = "a number in SI, or a quantity with its unit as text (`30 deg`)"
NUMBER = "a number in SI, a parameter's name, `-name`, or a quantity with its unit (`30 deg`)"


class _Plain:
    """A value checked by a function of ours alone."""

    def check(self, value: object, known: Names) -> object:
        raise NotImplementedError

    def schema(self) -> dict[str, Any]:
        raise NotImplementedError

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        def check(value: object, info: core_schema.ValidationInfo) -> object:
            try:
                return self.check(value, info.context or Names())
            except NumberMistake as mistake:
                raise wrong(str(mistake)) from None

        return core_schema.with_info_plain_validator_function(check)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return self.schema()


@dataclass(frozen=True)
class In(_Plain):
    """A number in a unit ("1": none), resolved to SI; nan stands for a mistaken parameter."""

    unit: str
    above: float | None = None
    least: float | None = None

    def check(self, value: object, known: Names) -> float:
        found = number(value, self.unit, known)
        if found is None:
            return float("nan")
        by_name = f" ({value})" if isinstance(value, str) else ""
        if self.above is not None and not found.value > self.above:
            raise NumberMistake(f"must be positive, is {found.value:g}{by_name}")
        if self.least is not None and not found.value >= self.least:
            raise NumberMistake(f"must not be negative, is {found.value:g}{by_name}")
        return found.value

    def schema(self) -> dict[str, Any]:
        literal: dict[str, Any] = {"type": "number"}
        if self.above is not None:
            literal["exclusiveMinimum"] = self.above
        if self.least is not None:
            literal["minimum"] = self.least
        unit = "" if self.unit == "1" else f" [{self.unit}]"
        return {"anyOf": [literal, {"type": "string"}], "description": NUMBER + unit}


@dataclass(frozen=True)
class Literal(_Plain):
    """A parameter's value: a literal or a quantity with its unit, never a name."""

    def check(self, value: object, known: Names) -> Amount:
        return amount(value)

    def schema(self) -> dict[str, Any]:
        return {"anyOf": [{"type": "number"}, {"type": "string"}], "description": LITERAL_OR_UNIT}


@dataclass(frozen=True)
class Bound(_Plain):
    """A positive number whose unit is that of the quantity it bounds, or a word for None."""

    word: str | None = None

    def check(self, value: object, known: Names) -> Amount | None:
        if self.word is not None and value == self.word:
            return None
        found = number(value, None, known) or Amount(float("nan"))
        if found.value <= 0:
            raise NumberMistake(f"must be positive, is {found.value:g}")
        return found

    def schema(self) -> dict[str, Any]:
        what = "in the quantity's unit" + (f", or `{self.word}`" if self.word else "")
        return {
            "anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"type": "string"}],
            "description": f"{NUMBER}, {what}",
        }


@dataclass(frozen=True)
class Text(_Plain):
    """Text that is not empty; `rule` says what else is wrong with it, or nothing."""

    rule: Callable[[str], str | None] = lambda _: None
    pattern: str | None = None
    description: str | None = None

    def check(self, value: object, known: Names) -> str:
        if not isinstance(value, str) or not value.strip():
            raise wrong(f"should be text, is {shown(value)}")
        if what := self.rule(value):
            raise wrong(what)
        return value

    def schema(self) -> dict[str, Any]:
        extra = {"pattern": self.pattern, "description": self.description}
        return {"type": "string", **{k: v for k, v in extra.items() if v is not None}}


@dataclass(frozen=True)
class Place(Text):
    """A number of a place in the book: text, because 2.10 as a number is 2.1."""

    def check(self, value: object, known: Names) -> str:
        if isinstance(value, int | float) and not isinstance(value, bool):
            raise wrong('should be text in quotes, as "2.10": as a number it would be 2.1')
        return super().check(value, known)


@dataclass(frozen=True)
class Word(_Plain):
    """One of a few words."""

    kind: str
    words: tuple[str, ...]

    def check(self, value: object, known: Names) -> str:
        if isinstance(value, str) and value in self.words:
            return value
        if not isinstance(value, str):
            raise wrong(f"should be {' or '.join(self.words)}, is {shown(value)}")
        raise wrong(f"unknown {self.kind} {value!r}{nearest(value, self.words)}")

    def schema(self) -> dict[str, Any]:
        return {"enum": list(self.words)}


def label(word: str) -> str | None:
    """What is wrong with the name of a parameter."""
    if not re.fullmatch(IDENTIFIER, word):
        return f"{word!r} is not a name: letters, digits and _, not starting with a digit"
    return "the name 'unknown' is taken" if word == "unknown" else None


def name(word: str) -> str | None:
    """What is wrong with the name of a part."""
    return f"the name {word!r} is taken" if word in RESERVED else label(word)


def equation(number: str) -> str | None:
    """What is wrong with the number of an equation."""
    if re.fullmatch(r"2\.([1-9]|[1-8][0-9]|9[0-8])", number):
        return None
    return f"no equation {number!r}: the chapter has 2.1 to 2.98"


def reference(word: str) -> str | None:
    """What is wrong with the form of a reference to a point."""
    if re.fullmatch(rf"{IDENTIFIER}\.{IDENTIFIER}", word):
        return None
    return f"should be body.point or ground.point, is {word!r}"
