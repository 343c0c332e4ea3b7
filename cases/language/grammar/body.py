"""Bodies as a case file writes them: a shape, and named points beside it."""

from collections.abc import Callable
from typing import Annotated, Any, ClassVar

from pydantic import Field, create_model

from ...fields.part import Name, OneOf, Part, Position
from ...scene import shape
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


class WithPoints(Shaped):
    """A body on which points can be named."""

    points: dict[Name, Position] = Field(
        {}, description="points of the body, in its axes from its centre of mass"
    )

    def named(self, name: str) -> Any:
        measures = dict(getattr(self, self.word))
        return type(self).makes(name=name, points=self.points, **measures)


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


KINDS = {word: body(word, makes) for word, makes in shape.SHAPES.items()}
ALIKE = {
    **dict.fromkeys(("rod", "link", "beam"), "did you mean 'bar'?"),
    **dict.fromkeys(("box", "rectangle"), "did you mean 'block'?"),
    **dict.fromkeys(("point", "mass", "point_mass"), "did you mean 'particle'?"),
}
"""For each word that others use for a shape: the question whether ours is meant."""
Body = Annotated[
    Shaped,
    OneOf(
        "shape",
        KINDS,
        ALIKE | dict.fromkeys(("ball", "circle", "wheel"), "did you mean 'disk'?"),
    ),
]
