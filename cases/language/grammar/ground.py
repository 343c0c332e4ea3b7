"""Points of the ground as a case file writes them: a place, or where it starts and how it moves."""

from typing import Annotated, Any

from pydantic import Field, Tag, create_model

from ...fields.field import In
from ...fields.part import Made, Part, Position, plain_or_map
from ...fields.signal import Signal
from ...fields.signal_grammar import Moving, keys
from ...fields.words import wrong
from ...scene.point import GroundPoint as Noun

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


def _point(written: DrivenPoint) -> Noun:
    return Noun(written.at, written.velocity or (0.0, 0.0), written.moves)


GroundPoint = Annotated[
    Annotated[Noun, Made(Position, Noun), Tag("<plain>")]
    | Annotated[Noun, Made(DrivenPoint, _point), Tag("<map>")],
    plain_or_map(),
]
