"""Events as a case file writes them: one quantity and its rule, `{touch.slip: stays zero}`."""

from typing import Annotated

from pydantic import BeforeValidator, Field

from .number import shown
from .text import Text, Word
from .words import wrong

RULES = ("stays zero", "leaves zero", "falls to zero")

Quantity = Annotated[str, Text(description="part.field, as crank.angle")]


def _one(value: object) -> object:
    if isinstance(value, dict) and len(value) == 1:
        return value
    has = f"has {len(value)}" if isinstance(value, dict) else f"is {shown(value)}"
    raise wrong(f"should be one quantity with its rule (`touch.slip: stays zero`), {has}")


Event = Annotated[
    dict[Quantity, Annotated[str, Word("rule", RULES)]],
    BeforeValidator(_one),
    Field(json_schema_extra={"minProperties": 1, "maxProperties": 1}),
]
