"""Bodies in space as a case file writes them: a shape, and named points beside it."""

from typing import Annotated, Any

from pydantic import Field

from ....fields.part import Name, OneOf
from ....fields.vector import Position
from ....fields.words import wrong
from ....scene.solid import SHAPES
from ..body import ALIKE, Shaped, body


class WithPoints(Shaped):
    """A body on which points can be named."""

    points: dict[Name, Position] = Field(
        {}, description="points of the body, in its axes from its centre of mass"
    )

    def model_post_init(self, context: object) -> None:
        measures = getattr(self, self.word)
        if getattr(measures, "axle", None) is not None and measures.radius is None:
            raise wrong("has an `axle` and no `radius`: the axle is that of a rim")

    def named(self, name: str) -> Any:
        measures = dict(getattr(self, self.word))
        return type(self).makes(name=name, points=self.points, **measures)


KINDS = {
    word: body(word, makes, with_points=WithPoints, prefix="Spatial")
    for word, makes in SHAPES.items()
}
Body = Annotated[
    Shaped,
    OneOf(
        "shape", KINDS, ALIKE | {"ball": "did you mean 'sphere'?", "wheel": "did you mean 'disk'?"}
    ),
]
