"""Gravity as a case file writes it: none, how strong it is, or a vector of its own."""

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Tag

from ..mistake import nearest
from .field import In, Plain
from .number import Names, NumberMistake
from .part import plain_or_list

Acceleration = Annotated[float, In("m/s²")]


@dataclass(frozen=True)
class Strength(Plain):
    """How strong gravity is [m/s²]; `none` is 0."""

    def check(self, value: object, known: Names) -> float:
        if value == "none":
            return 0.0
        word = value.removeprefix("-") if isinstance(value, str) else ""
        if word.isidentifier() and word not in known.amounts:
            raise NumberMistake(f"unknown gravity {value!r}{nearest(str(value), ['none'])}")
        return In("m/s²", least=0).check(value, known)

    def schema(self) -> dict[str, Any]:
        return In("m/s²", least=0).schema()


Gravity = Annotated[
    Annotated[float, Strength(), Tag("<plain>")]
    | Annotated[tuple[Acceleration, Acceleration], Tag("<list>")],
    plain_or_list(),
]
