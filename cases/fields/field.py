"""The kinds of number a case file is made of, as annotations that pydantic understands.

Each says itself what is wrong, in words for the person who wrote the file, and describes itself
in the JSON Schema for that person's editor.
"""

from dataclasses import dataclass
from typing import Any

from pydantic import GetCoreSchemaHandler, GetJsonSchemaHandler
from pydantic_core import CoreSchema, core_schema

from .number import MISTAKEN, Amount, Names, NumberMistake, amount, number, per_second, shown
from .words import wrong

LITERAL_OR_UNIT = "a number in SI, or a quantity with its unit as text (`30 deg`)"
NUMBER = "a number in SI, a parameter's name, `-name`, or a quantity with its unit (`30 deg`)"


class Plain:
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
                raise wrong(str(mistake), number=True) from None

        return core_schema.with_info_plain_validator_function(check)

    def __get_pydantic_json_schema__(
        self, schema: CoreSchema, handler: GetJsonSchemaHandler
    ) -> dict[str, Any]:
        return self.schema()


@dataclass(frozen=True)
class In(Plain):
    """A number in a unit ("1": none), resolved to SI; nan stands for a mistaken parameter.

    why: what else to write where it would be 0, as the end of a sentence.
    """

    unit: str
    above: float | None = None
    least: float | None = None
    most: float | None = None
    why: str = ""

    def check(self, value: object, known: Names) -> float:
        amount = number(value, self.unit, known)
        if amount is None:
            return float("nan")
        by_name = f" ({value})" if isinstance(value, str) else ""
        if self.above is not None and not amount.value > self.above:
            why = "" if amount.value else self.why
            raise NumberMistake(f"must be positive, is {amount.value:g}{by_name}{why}")
        if self.least is not None and not amount.value >= self.least:
            what = f"must be at least {self.least:g}" if self.least else "must not be negative"
            raise NumberMistake(f"{what}, is {amount.value:g}{by_name}")
        if self.most is not None and not amount.value <= self.most:
            raise NumberMistake(f"must be at most {self.most:g}, is {amount.value:g}{by_name}")
        return amount.value

    def schema(self) -> dict[str, Any]:
        literal: dict[str, Any] = {"type": "number"}
        if self.above is not None:
            literal["exclusiveMinimum"] = self.above
        if self.least is not None:
            literal["minimum"] = self.least
        if self.most is not None:
            literal["maximum"] = self.most
        unit = "" if self.unit == "1" else f" [{self.unit}]"
        return {"anyOf": [literal, {"type": "string"}], "description": NUMBER + unit}


@dataclass(frozen=True)
class Literal(Plain):
    """A parameter's value: a literal or a quantity with its unit, never a name."""

    def check(self, value: object, known: Names) -> Amount:
        return amount(value)

    def schema(self) -> dict[str, Any]:
        return {"anyOf": [{"type": "number"}, {"type": "string"}], "description": LITERAL_OR_UNIT}


@dataclass(frozen=True)
class AnyUnit(Plain):
    """A number whose unit is known when the scene is: see where it is checked."""

    def check(self, value: object, known: Names) -> Amount:
        return number(value, None, known) or Amount(float("nan"))

    def schema(self) -> dict[str, Any]:
        return {"anyOf": [{"type": "number"}, {"type": "string"}], "description": NUMBER}


@dataclass(frozen=True)
class Coefficients(Plain):
    """Coefficients of a polynomial in time, as a list [c0, c1, …].

    The first is in `unit`, each next one "per second" once more (None: in any unit).
    """

    unit: str | None

    def check(self, value: object, known: Names) -> tuple[Any, ...]:
        if value is MISTAKEN:
            return (Amount(float("nan")) if self.unit is None else float("nan"),)
        if not isinstance(value, tuple | list):
            raise NumberMistake(f"should be a list [c0, c1, …], is {shown(value)}")
        if not value:
            raise NumberMistake("should not be empty")
        coefficients = []
        for k, entry in enumerate(value):
            unit = None if self.unit is None else per_second(self.unit, k)
            try:
                amount = number(entry, unit, known) or Amount(float("nan"))
            except NumberMistake as mistake:
                raise NumberMistake(f"coefficient {k} {mistake}") from None
            coefficients.append(amount if self.unit is None else amount.value)
        return tuple(coefficients)

    def schema(self) -> dict[str, Any]:
        literal = {"anyOf": [{"type": "number"}, {"type": "string"}], "description": NUMBER}
        return {"type": "array", "minItems": 1, "items": literal}


@dataclass(frozen=True)
class Space(Plain):
    """`space: 3`; a scene in the plane does not say it."""

    def check(self, value: object, known: Names) -> int:
        if type(value) is int and value == 3:
            return 3
        raise wrong(f"should be 3, is {shown(value)}; a scene in the plane has no `space`")

    def schema(self) -> dict[str, Any]:
        return {"const": 3}


@dataclass(frozen=True)
class Bound(Plain):
    """A positive number whose unit is that of the quantity it bounds, or a word for None."""

    word: str | None = None

    def check(self, value: object, known: Names) -> Amount | None:
        if self.word is not None and value == self.word:
            return None
        bound = number(value, None, known) or Amount(float("nan"))
        if bound.value <= 0:
            raise NumberMistake(f"must be positive, is {bound.value:g}")
        return bound

    def schema(self) -> dict[str, Any]:
        what = "in the quantity's unit" + (f", or `{self.word}`" if self.word else "")
        return {
            "anyOf": [{"type": "number", "exclusiveMinimum": 0}, {"type": "string"}],
            "description": f"{NUMBER}, {what}",
        }
