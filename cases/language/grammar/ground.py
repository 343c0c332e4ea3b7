"""Points of the ground as a case file writes them: a place, or where it starts and how it moves."""

from typing import Annotated

from pydantic import Tag

from ...point import GroundPoint as Noun
from .field import In
from .part import Made, Part, Position, plain_or_map

Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]


class DrivenPoint(Part):
    at: Position
    velocity: Velocity


GroundPoint = Annotated[
    Annotated[Noun, Made(Position, Noun), Tag("<plain>")]
    | Annotated[Noun, Made(DrivenPoint, lambda point: Noun(**dict(point))), Tag("<map>")],
    plain_or_map(),
]
