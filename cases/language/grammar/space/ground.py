"""Points of the ground in space: a place, or where it starts and how it moves."""

from typing import Annotated

from pydantic import Tag

from ....fields.part import Made, Part, plain_or_map
from ....fields.vector import Position, Velocity
from ....scene.point import GroundPoint as Noun


class SpatialDrivenPoint(Part):
    """Where it starts and how it moves."""

    at: Position
    velocity: Velocity


def _point(at: Position, velocity: Velocity = (0.0, 0.0, 0.0)) -> Noun:
    return Noun(at, velocity)  # type: ignore[arg-type]  # as many entries as the frame has axes


GroundPoint = Annotated[
    Annotated[Noun, Made(Position, _point), Tag("<plain>")]
    | Annotated[Noun, Made(SpatialDrivenPoint, lambda point: _point(**dict(point))), Tag("<map>")],
    plain_or_map(),
]
