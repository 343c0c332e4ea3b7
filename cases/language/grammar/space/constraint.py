"""Constraints in space as a case file writes them."""

from typing import Annotated

from pydantic import Field

from ....fields.part import OneOf, Part, Point
from ....fields.text import Word
from ....fields.vector import Direction
from ....scene.constraint import Edge
from ....scene.frame import SPACE
from ....scene.point import anchor


class Blade(Part):
    """A blade at a point of a body: the point does not move across its heading."""

    edge: Point
    along: Direction = Field(description="in the axes of the body; its shadow is the heading")
    height: Annotated[str, Word("height", ("kept",))] | None = Field(
        None, description="`kept`: the point stays as high as it starts"
    )

    def named(self, name: str) -> Edge:
        """The blade."""
        return Edge(name, anchor(self.edge), self.along, kept=self.height is not None, frame=SPACE)


KINDS: dict[str, type[Part]] = {"edge": Blade}
Constraint = Annotated[Blade, OneOf("constraint", KINDS)]
