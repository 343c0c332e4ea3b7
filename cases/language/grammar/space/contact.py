"""Contacts in space as a case file writes them: what rolls on the floor, or stands on a point."""

from collections.abc import Mapping
from typing import Annotated, Any

from pydantic import Field, model_validator

from ....fields.friction_grammar import Coefficient
from ....fields.part import Part
from ....fields.text import Text, Word
from ....fields.words import wrong
from ....scene.body import Body
from ....scene.contact import Contact, spatial_contact
from ....scene.plane import Plane
from ....scene.point import anchor

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

    def named(self, name: str, bodies: Mapping[str, Body], planes: Mapping[str, Plane]) -> Contact:
        """The contact; of a body with an axle, by its rim. There is no plane but the floor."""
        at = anchor(self.between[0])
        body = bodies.get(at.body)
        rim = self.ideal == "rolling" and body is not None and body.axle is not None
        return spatial_contact(name, at, self.friction, rim, self.ideal)  # type: ignore[arg-type]
