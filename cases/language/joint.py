"""Points of the ground, joints and contacts as a case file writes them."""

import math
from typing import Annotated

from pydantic import AfterValidator, Discriminator, Field, Tag

from cases.language.field import In
from cases.language.part import Angle, Pair, Part, Position, by_key
from cases.language.text import Text, Word
from cases.language.words import wrong

Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]


class DrivenPoint(Part):
    at: Position
    velocity: Velocity


def _is_driven(value: object) -> str:
    return "<driven>" if isinstance(value, dict) else "<fixed>"


GroundPoint = Annotated[
    Annotated[Position, Tag("<fixed>")] | Annotated[DrivenPoint, Tag("<driven>")],
    Discriminator(_is_driven),
]


def _unit(value: tuple[float, float]) -> tuple[float, float]:
    length = math.hypot(*value)
    if length == 0:
        raise wrong("should be a direction, is [0, 0]")
    return value[0] / length, value[1] / length


Direction = Annotated[
    tuple[Annotated[float, In("1")], Annotated[float, In("1")]], AfterValidator(_unit)
]


class Pin(Part):
    pin: Pair


class Slide(Part):
    slide: Pair
    along: Direction = Field(description="in the axes of the first part")
    angle: Angle = 0.0


class Weld(Part):
    weld: Pair
    angle: Angle = 0.0


Joint = Annotated[
    Annotated[Pin, Tag("<pin>")]
    | Annotated[Slide, Tag("<slide>")]
    | Annotated[Weld, Tag("<weld>")],
    by_key("joint", "pin", "slide", "weld"),
]


class Contact(Part):
    between: tuple[Annotated[str, Text()], Annotated[str, Text()]] = Field(
        description="a disk, then ground.floor"
    )
    friction: Annotated[float, In("1", least=0)]
    ideal: Annotated[str, Word("ideal", ("rolling",))] = Field(
        description="what the reference assumes, and checks at every sample"
    )
