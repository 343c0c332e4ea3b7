"""Bodies as a case file writes them: a shape, and named points beside it."""

from collections.abc import Callable
from typing import Annotated, Any, ClassVar

from pydantic import Field, create_model

from ...fields import vector
from ...fields.part import Name, OneOf, Part, Position
from ...fields.words import wrong
from ...scene import shape, solid
from .element import keys, numbers


class Shaped(Part):
    """A shape's word with its measures."""

    word: ClassVar[str]
    makes: ClassVar[Callable[..., Any]]

    def named(self, name: str) -> Any:
        """The body."""
        return type(self).makes(name=name, **dict(getattr(self, self.word)))

    @property
    def own_points(self) -> tuple[str, ...]:
        """The points that the shape has by itself."""
        named: dict[str, Any] = {"points": {}} if "points" in keys(type(self).makes) else {}
        made = type(self).makes(name="", **named, **dict(getattr(self, self.word)))
        return tuple(made.points)


_POINTS = "points of the body, in its axes from its centre of mass"


class WithPoints(Shaped):
    """A body on which points can be named."""

    points: dict[Name, Position] = Field({}, description=_POINTS)

    def named(self, name: str) -> Any:
        measures = dict(getattr(self, self.word))
        return type(self).makes(name=name, points=self.points, **measures)


class WithSpatialPoints(WithPoints):
    """A body in space on which points can be named; the axle that it may have is that of a rim."""

    points: dict[Name, vector.Position] = Field(  # pyright: ignore[reportIncompatibleVariableOverride]
        {}, description=_POINTS
    )

    def model_post_init(self, context: object) -> None:
        measures = getattr(self, self.word)
        if getattr(measures, "axle", None) is not None and measures.radius is None:
            raise wrong("has an `axle` and no `radius`: the axle is that of a rim")


def body(
    word: str,
    makes: Callable[..., Any],
    *,
    with_points: type[Shaped] = WithPoints,
    prefix: str = "",
) -> type[Shaped]:
    """The model of a body, written as its shape's word with its measures."""
    base = with_points if "points" in keys(makes) else Shaped
    inner = numbers(makes, without=("name", "points"), prefix=prefix)
    measures: dict[str, Any] = {word: (inner, ...)}
    model = create_model(f"{prefix}{word.capitalize()}Body", __base__=base, **measures)
    model.word, model.makes = word, makes
    return model


KINDS: dict[int, dict[str, type[Shaped]]] = {
    2: {word: body(word, makes) for word, makes in shape.SHAPES.items()},
    3: {
        word: body(word, makes, with_points=WithSpatialPoints, prefix="Spatial")
        for word, makes in solid.SHAPES.items()
    },
}
"""By the dimension of the frame, the model of each shape's word."""
ALIKE = {
    **dict.fromkeys(("rod", "link", "beam"), "did you mean 'bar'?"),
    **dict.fromkeys(("box", "rectangle"), "did you mean 'block'?"),
    **dict.fromkeys(("point", "mass", "point_mass"), "did you mean 'particle'?"),
}
"""For each word that others use for a shape: the question whether ours is meant."""
ROUND = {
    2: dict.fromkeys(("ball", "circle", "wheel"), "did you mean 'disk'?"),
    3: {"ball": "did you mean 'sphere'?", "wheel": "did you mean 'disk'?"},
}
Body = Annotated[Shaped, OneOf("shape", KINDS[2], ALIKE | ROUND[2])]
SpatialBody = Annotated[Shaped, OneOf("shape", KINDS[3], ALIKE | ROUND[3])]
