"""A scene as a case file writes it: in the plane, or in space where it says so."""

from typing import Annotated

from pydantic import Field

from ...fields import vector
from ...fields.field import Space
from ...fields.gravity import Gravity
from ...fields.part import Angle, Name, Part
from ...fields.text import Word
from .body import Body, SpatialBody
from .constraint import Constraint, SpatialConstraint
from .contact import Contact, Rolling
from .drive import Driven, Rate
from .force import Force, SpatialForce
from .ground import GroundPoint, Plane, SpatialGroundPoint
from .joint import Joint, SpatialJoint

GRAVITY = "`none` (a scene seen from above), how strong it is [m/s²], or a vector of its own"
INCLINE = "turns gravity, never the ground: x points down the slope"


class Scene(Part):
    """Bodies and what joins, touches and drives them."""

    elsewhere = {  # noqa: RUF012  # a ClassVar of Part
        "stops": "each is one of the `forces`: NAME: {stops: JOINT, low: -90 deg}"
    }

    space: Annotated[int, Space()] | None = Field(None, description="3: a scene in space")
    gravity: Gravity | None = Field(None, description=GRAVITY)
    seen: Annotated[str, Word("view", ("from above",))] | None = Field(
        None, description="of gravity only what points down the incline is left"
    )
    incline: Angle | None = Field(None, description=INCLINE)
    points: dict[Name, GroundPoint] = Field({}, description="points of the ground")
    planes: dict[Name, Plane] = Field({}, description="planes of the ground, beside the floor")
    bodies: dict[Name, Body]
    joints: dict[Name, Joint] = Field({})
    constraints: dict[Name, Constraint] = Field({}, description="that cannot be integrated")
    contacts: dict[Name, Contact] = Field({})
    forces: dict[Name, Force] = Field({})
    drive: dict[Rate, Driven] = Field({}, description="prescribed rates of joints' freedoms")


class SpatialScene(Part):
    """Bodies in space, and what joins, touches and drives them."""

    space: Annotated[int, Space()] = 3
    gravity: vector.Gravity | None = Field(None, description=GRAVITY)
    incline: Angle | None = Field(None, description=f"about y; {INCLINE}")
    points: dict[Name, SpatialGroundPoint] = Field({}, description="points of the ground")
    bodies: dict[Name, SpatialBody]
    joints: dict[Name, SpatialJoint] = Field({})
    constraints: dict[Name, SpatialConstraint] = Field({}, description="that cannot be integrated")
    contacts: dict[Name, Rolling] = Field({})
    forces: dict[Name, SpatialForce] = Field({})
    drive: dict[Rate, Driven] = Field({}, description="prescribed rates of joints' freedoms")
