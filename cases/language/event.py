"""Events as a case file writes them: one quantity and its rule, `{touch.slip: stays zero}`."""

from typing import Annotated

from pydantic import AfterValidator, Field

from cases.language.text import Text, Word
from cases.language.words import wrong

RULES = ("stays zero", "leaves zero", "falls to zero")

Quantity = Annotated[str, Text(description="part.field, as crank.angle")]


def _one(rules: dict[str, str]) -> dict[str, str]:
    if len(rules) != 1:
        raise wrong(
            f"should be one quantity with its rule (`touch.slip: stays zero`), has {len(rules)}"
        )
    return rules


Event = Annotated[
    dict[Quantity, Annotated[str, Word("rule", RULES)]],
    AfterValidator(_one),
    Field(json_schema_extra={"minProperties": 1, "maxProperties": 1}),
]
