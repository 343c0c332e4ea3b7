"""Constraints that cannot be integrated, as a case file writes them."""

from typing import Annotated

from pydantic import Field

from ...fields import vector
from ...fields.part import Direction, OneOf, Part, Point
from ...fields.text import Word
from ...scene.constraint import CONSTRAINTS, Edge
from ...scene.frame import SPACE
from ...scene.point import anchor
from .element import Element, element

_ALONG = Annotated[Direction, Field(description="in the axes of the body")]


class Blade(Part):
    """A blade at a point of a body: the point does not move across its heading."""

    edge: Point
    along: vector.Direction = Field(
        description="in the axes of the body; its shadow is the heading"
    )
    height: Annotated[str, Word("height", ("kept",))] | None = Field(
        None, description="`kept`: the point stays as high as it starts"
    )

    def named(self, name: str) -> Edge:
        """The blade."""
        return Edge(name, anchor(self.edge), self.along, kept=self.height is not None, frame=SPACE)


KINDS: dict[int, dict[str, type[Part]]] = {
    2: {
        word: element(word, noun, without=("kept", "frame"), typed={"along": _ALONG})
        for word, noun in CONSTRAINTS.items()
    },
    3: {"edge": Blade},
}
"""By the dimension of the frame."""
Constraint = Annotated[Element, OneOf("constraint", KINDS[2])]
SpatialConstraint = Annotated[Blade, OneOf("constraint", KINDS[3])]
