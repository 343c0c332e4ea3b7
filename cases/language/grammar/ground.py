"""The ground as a case file writes it: points, be it that they move, and planes to stand on."""

from typing import Annotated, Any

from pydantic import Field, Tag, create_model

from ...fields import vector
from ...fields.field import In
from ...fields.part import Direction, Made, Part, Position, plain_or_map
from ...fields.signal import Signal
from ...fields.signal_grammar import Moving, keys
from ...fields.words import wrong
from ...scene import plane, point

Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]
_laws: dict[str, Any] = keys("Moving", "m", 2, Moving.laws)
_moves = create_model("Moves", __base__=Moving, __doc__=Moving.__doc__, **_laws)
Moves = Annotated[Signal, Made(_moves, lambda written: written.signal)]


class DrivenPoint(Part):
    at: Position
    velocity: Velocity | None = None
    moves: Moves | None = Field(None, description="away from `at`, by a law in time")

    def model_post_init(self, context: object) -> None:
        if (self.velocity is None) == (self.moves is None):
            raise wrong("needs exactly one of velocity, moves")


def _point(written: DrivenPoint) -> point.GroundPoint:
    return point.GroundPoint(written.at, written.velocity or (0.0, 0.0), written.moves)


GroundPoint = Annotated[
    Annotated[point.GroundPoint, Made(Position, point.GroundPoint), Tag("<plain>")]
    | Annotated[point.GroundPoint, Made(DrivenPoint, _point), Tag("<map>")],
    plain_or_map(),
]


class SpatialDrivenPoint(Part):
    """Where it starts and how it moves."""

    at: vector.Position
    velocity: vector.Velocity


def _spatial(at: vector.Position, velocity: vector.Velocity = (0.0, 0.0, 0.0)) -> point.GroundPoint:
    return point.GroundPoint(at, velocity)  # type: ignore[arg-type]  # as many as the frame's axes


SpatialGroundPoint = Annotated[
    Annotated[point.GroundPoint, Made(vector.Position, _spatial), Tag("<plain>")]
    | Annotated[
        point.GroundPoint,
        Made(SpatialDrivenPoint, lambda written: _spatial(**dict(written))),
        Tag("<map>"),
    ],
    plain_or_map(),
]


class Plane(Part):
    """A straight line, seen from the side, on which bodies stand and slide."""

    at: Position = Field(description="any of its points")
    normal: Direction = Field(description="points away from it, to where bodies are")

    def named(self, name: str) -> plane.Plane:
        """The plane."""
        return plane.Plane(name, self.at, self.normal)
