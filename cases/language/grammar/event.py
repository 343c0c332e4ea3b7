"""Events as a case file writes them: one quantity and its rule.

`{touch.slip: stays zero}`, `{jumper.y: {falls to: 0.5}}`.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import BeforeValidator, Field

from ...fields.event import Rule
from ...fields.field import NUMBER, Plain
from ...fields.number import Amount, Names, number, shown
from ...fields.text import Text, Word
from ...fields.words import NO_VALUE, wrong
from ...mistake import nearest

RULES: tuple[Rule, ...] = get_args(Rule)
CROSSES: Mapping[str, Rule] = {"falls to": "falls to zero", "rises to": "rises to zero"}
MAP = "`{falls to: 0.5}`"

Quantity = Annotated[str, Text(description="part.field, as crank.angle")]


@dataclass(frozen=True)
class Crossing:
    """A rule, and to which value the quantity comes; its unit is known when the scene is."""

    word: Rule
    to: Amount


@dataclass(frozen=True)
class RuleWords(Plain):
    """A rule in words, or a map of one, `{falls to: 0.5}`, with the value it comes to."""

    def check(self, value: object, known: Names) -> Crossing:
        if isinstance(value, str):
            return Crossing(_word(value, known), Amount(0.0))
        if not isinstance(value, dict):
            raise wrong(f"should be one of {', '.join(RULES)}, or {MAP}, is {shown(value)}")
        if len(value) != 1:
            raise wrong(f"should be one rule with its value, as {MAP}, has {len(value)}")
        ((word, to),) = value.items()
        if word not in CROSSES:
            raise wrong(f"unknown rule {word!r}{nearest(word, CROSSES)}")
        if to is None:
            raise wrong(NO_VALUE)
        return Crossing(CROSSES[word], number(to, None, known) or Amount(float("nan")))

    def schema(self) -> dict[str, Any]:
        to = {"anyOf": [{"type": "number"}, {"type": "string"}]}
        to["description"] = f"{NUMBER}, in the quantity's unit"  # type: ignore[assignment]
        value = {
            "type": "object",
            "properties": dict.fromkeys(CROSSES, to),
            "additionalProperties": False,
            "minProperties": 1,
            "maxProperties": 1,
        }
        return {"anyOf": [{"enum": list(RULES)}, value]}


def _word(text: str, known: Names) -> Rule:
    for way in CROSSES:
        if text.startswith(f"{way} ") and text not in RULES:
            raise wrong(f"unknown rule {text!r}; a value other than zero is written as {MAP}")
    word: Any = Word("rule", RULES).check(text, known)
    return word


def _one(value: object) -> object:
    if isinstance(value, dict) and len(value) == 1:
        return value
    has = f"has {len(value)}" if isinstance(value, dict) else f"is {shown(value)}"
    raise wrong(f"should be one quantity with its rule (`touch.slip: stays zero`), {has}")


Event = Annotated[
    dict[Quantity, Annotated[Crossing, RuleWords()]],
    BeforeValidator(_one),
    Field(json_schema_extra={"minProperties": 1, "maxProperties": 1}),
]
