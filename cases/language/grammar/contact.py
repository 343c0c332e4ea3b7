"""Contacts as a case file writes them: in the plane of two parts, in space with the floor."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from ...fields.field import In
from ...fields.friction_grammar import Coefficient, Friction
from ...fields.part import Part, Point
from ...fields.text import Text, Word
from ...fields.words import wrong
from ...scene.body import Body
from ...scene.contact import Contact as Noun
from ...scene.contact import spatial_contact
from ...scene.pair import Pair
from ...scene.plane import LEVEL, Plane
from ...scene.point import CENTER, anchor


class Contact(Part):
    """Two things that may touch, with friction between them and what an impact leaves of speed."""

    between: tuple[Annotated[str, Text()], Annotated[str, Text()]] = Field(
        description="a disk, a particle, a point of a bar or spokes, then a plane of the ground, a "
        "disk or a side of a block"
    )
    friction: Friction
    restitution: Annotated[float, In("1", least=0, most=1)] = Field(
        0.0, description="speed after an impact over speed before it"
    )
    ideal: Annotated[str, Word("ideal", ("rolling", "pivot"))] | None = Field(
        None, description="what the reference assumes, and checks at every sample"
    )
    ahead_of: Point | None = Field(
        None, description="the other foot: this one strikes only where it is further along x"
    )

    def model_post_init(self, context: object) -> None:
        if self.ideal == "rolling" and "restitution" in self.model_fields_set:
            raise wrong("`restitution` cannot stand beside `ideal: rolling`: it has no impacts")
        if self.ideal == "pivot" and self.restitution > 0:  # a mistaken number is nan
            raise wrong("`restitution` is 0 beside `ideal: pivot`: what strikes the floor stays")
        if self.ideal == "pivot" and self.friction.static > self.friction.kinetic:
            raise wrong("`friction` is one number beside `ideal: pivot`: nothing slides")
        if self.ahead_of is not None and self.ideal != "pivot":
            raise wrong("`ahead_of` is a foot's, which pivots: write `ideal: pivot`")

    def pairs(self, bodies: Mapping[str, Body]) -> bool:
        """Whether it is with another body."""
        return self.between[1].partition(".")[0] in bodies

    def paired(self, name: str) -> Pair:
        """The contact of two bodies, as it stands (check/contact.py)."""
        at, (touched, _, face) = anchor(self.between[0]), self.between[1].partition(".")
        static, kinetic = self.friction.static, self.friction.kinetic
        return Pair(name, at, touched, face or None, static, kinetic, self.restitution)

    def named(self, name: str, bodies: Mapping[str, Body], planes: Mapping[str, Plane]) -> Noun:
        """The contact; with the floor where there is no such plane (check/contact.py says so)."""
        static, kinetic = self.friction.static, self.friction.kinetic
        at, ideal = anchor(self.between[0]), self.ideal
        plane = planes.get(self.between[1].partition(".")[2], LEVEL)
        body = bodies.get(at.body)
        tips = body.tips if body is not None and at.point == CENTER else ()
        other = None if self.ahead_of is None else anchor(self.ahead_of)
        return Noun(name, at, static, kinetic, self.restitution, ideal, plane, tips, other)  # type: ignore[arg-type]


# In space: what rolls on the floor, or stands there on a point.


_ONLY = (
    "in space a contact rolls or is a pivot (slipping in two directions has no finite set of modes)"
)


class Rolling(Part):
    """A disk's rim or a sphere that rolls on the floor z = 0, or a point that stands there."""

    between: tuple[Annotated[str, Text()], Annotated[str, Text()]] = Field(
        description="a disk or a sphere, or a point of a body, then ground.floor"
    )
    friction: Coefficient
    ideal: Annotated[str, Word("ideal", ("rolling", "pivot"))] = Field(
        description="what the reference assumes, and checks at every sample"
    )

    @model_validator(mode="before")
    @classmethod
    def _only_rolls(cls, value: Any) -> Any:
        if isinstance(value, dict) and "restitution" in value:
            raise wrong(f"has a `restitution`: {_ONLY}, and has no impacts")
        if isinstance(value, dict) and isinstance(value.get("friction"), dict):
            raise wrong(f"has a map as `friction`: {_ONLY}, and takes one number")
        if isinstance(value, dict) and "ideal" not in value and "between" in value:
            raise wrong(f"needs `ideal: rolling` or `ideal: pivot`: {_ONLY}")
        return value

    def named(self, name: str, bodies: Mapping[str, Body], planes: Mapping[str, Plane]) -> Noun:
        """The contact; of a body with an axle, by its rim. There is no plane but the floor."""
        at = anchor(self.between[0])
        body = bodies.get(at.body)
        rim = self.ideal == "rolling" and body is not None and body.axle is not None
        return spatial_contact(name, at, self.friction, rim, self.ideal)  # type: ignore[arg-type]
