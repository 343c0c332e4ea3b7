"""A scene in space as a case file writes it."""

from typing import Annotated

from pydantic import Field

from ....fields.field import Space
from ....fields.part import Angle, Name, Part
from ....fields.vector import Gravity
from ..drive import Driven, Rate
from ..file import GRAVITY, INCLINE
from .body import Body
from .constraint import Constraint
from .contact import Rolling
from .force import Force
from .ground import GroundPoint
from .joint import Joint


class SpatialScene(Part):
    """Bodies in space, and what joins, touches and drives them."""

    space: Annotated[int, Space()] = 3
    gravity: Gravity | None = Field(None, description=GRAVITY)
    incline: Angle | None = Field(None, description=f"about y; {INCLINE}")
    points: dict[Name, GroundPoint] = Field({}, description="points of the ground")
    bodies: dict[Name, Body]
    joints: dict[Name, Joint] = Field({})
    constraints: dict[Name, Constraint] = Field({}, description="that cannot be integrated")
    contacts: dict[Name, Rolling] = Field({})
    forces: dict[Name, Force] = Field({})
    drive: dict[Rate, Driven] = Field({}, description="prescribed rates of joints' freedoms")
