"""Joints in space as a case file writes them: each is the freedoms that it leaves."""

from typing import Annotated, Any, ClassVar

from pydantic import Field

from ....fields.part import OneOf, Pair, Part
from ....fields.vector import Direction
from ....fields.words import wrong
from ....scene.frame import SPACE
from ....scene.joint import Freedom
from ....scene.joint import Joint as Noun
from ....scene.point import anchor
from .freedom import Freedoms, parallel


class SpatialJointed(Part):
    """A joint as a case file writes it, before the key above it names it."""

    kind: ClassVar[Any]

    def points(self) -> tuple[str, str]:
        """The two points it joins."""
        return getattr(self, self.kind)

    def left(self) -> tuple[Freedom, ...]:
        """The freedoms that it leaves."""
        return ()

    def named(self, name: str) -> Noun:
        """The joint."""
        a, b = map(anchor, self.points())
        return Noun(name, self.kind, a, b, self.left(), frame=SPACE)


class Hinge(SpatialJointed):
    """Lets the second part turn about an axis."""

    kind = "hinge"
    hinge: Pair
    axis: Direction = Field(description="in the axes of the first part")

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom.turn(self.axis, "angle"),)


class Ball(SpatialJointed):
    """Lets the second part turn in any way."""

    kind = "ball"
    ball: Pair

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom("ball"),)


class Universal(SpatialJointed):
    """Lets the second part turn about an axis of the first, and about one of its own."""

    kind = "universal"
    universal: Pair
    axes: tuple[Direction, Direction] = Field(
        description="in the axes of the first part, and of the second"
    )

    def model_post_init(self, context: object) -> None:
        if parallel(*self.axes):
            raise wrong("the two `axes` are parallel: then it is a `hinge`")

    def left(self) -> tuple[Freedom, ...]:
        return tuple(Freedom.turn(axis) for axis in self.axes)


class SpatialSlide(SpatialJointed):
    """Lets the second point shift along a line."""

    kind = "slide"
    slide: Pair
    along: Direction = Field(description="in the axes of the first part")

    def left(self) -> tuple[Freedom, ...]:
        return (Freedom.shift(self.along, "shift"),)


class SpatialWeld(SpatialJointed):
    """Lets the second part do nothing."""

    kind = "weld"
    weld: Pair


class Named(SpatialJointed):
    """Leaves freedoms with names: slides, then hinges; what is not named is held."""

    kind = "freedoms"
    freedoms: Freedoms
    of: Pair

    def points(self) -> tuple[str, str]:
        return self.of

    def left(self) -> tuple[Freedom, ...]:
        return self.freedoms  # type: ignore[return-value]  # as its validator makes them


KINDS: dict[str, type[SpatialJointed]] = {
    joint.kind: joint for joint in (Hinge, Ball, Universal, SpatialSlide, SpatialWeld, Named)
}
IN_THE_PLANE = {
    "pin": "in space it is `hinge`, with its `axis`",
    "revolute": "did you mean 'hinge'?",
    "prismatic": "did you mean 'slide'?",
    "spherical": "did you mean 'ball'?",
    "fixed": "did you mean 'weld'?",
    "distance": "rods join points of the plane",
    "slot": "in space it is `freedoms`, a slide and the hinges after it",
}
Joint = Annotated[SpatialJointed, OneOf("joint", KINDS, IN_THE_PLANE)]
