"""Points of the ground, joints and contacts as a case file writes them."""

import math
from typing import Annotated, Any

from pydantic import AfterValidator, Field, Tag, model_validator

from .field import In
from .friction import DryFriction, Friction
from .part import Angle, Pair, Part, Position, by_key, plain_or_map
from .text import Text, Word
from .words import wrong

Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]


class DrivenPoint(Part):
    at: Position
    velocity: Velocity


GroundPoint = Annotated[
    Annotated[Position, Tag("<plain>")] | Annotated[DrivenPoint, Tag("<map>")], plain_or_map()
]


def _unit(value: tuple[float, float]) -> tuple[float, float]:
    length = math.hypot(*value)
    if length == 0:
        raise wrong("should be a direction, is [0, 0]")
    return value[0] / length, value[1] / length


Direction = Annotated[
    tuple[Annotated[float, In("1")], Annotated[float, In("1")]], AfterValidator(_unit)
]


class _NeverSlides(Part):
    @model_validator(mode="before")
    @classmethod
    def _no_friction(cls, value: Any) -> Any:
        if isinstance(value, dict) and "dry_friction" in value:
            raise wrong("only a slide has `dry_friction`")
        return value


class Pin(_NeverSlides):
    pin: Pair


class Slide(Part):
    slide: Pair
    along: Direction = Field(description="in the axes of the first part")
    angle: Angle = 0.0
    dry_friction: DryFriction | None = None


class Weld(_NeverSlides):
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
        description="a disk, a particle or a point of a bar, then ground.floor"
    )
    friction: Friction
    restitution: Annotated[float, In("1", least=0, most=1)] = Field(
        0.0, description="speed after an impact over speed before it"
    )
    ideal: Annotated[str, Word("ideal", ("rolling",))] | None = Field(
        None, description="what the reference assumes, and checks at every sample"
    )

    def model_post_init(self, context: object) -> None:
        if self.ideal is not None and "restitution" in self.model_fields_set:
            raise wrong("`restitution` cannot stand beside `ideal: rolling`: it has no impacts")
