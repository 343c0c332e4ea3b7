"""Bodies as a case file writes them: a shape, and named points beside it."""

from typing import Annotated

from pydantic import Field, Tag

from .field import In
from .part import Length, Mass, Name, Part, Position, by_key


class Bar(Part):
    mass: Mass
    length: Length


class Disk(Part):
    mass: Mass
    radius: Length


class Block(Part):
    mass: Mass
    width: Length
    height: Length


class Particle(Part):
    mass: Mass


class Rigid(Part):
    mass: Mass
    inertia: Annotated[float, In("kg m²", above=0)]


class _WithPoints(Part):
    points: dict[Name, Position] = Field(
        {}, description="points of the body, in its axes from its centre of mass"
    )


class BarBody(_WithPoints):
    bar: Bar


class DiskBody(_WithPoints):
    disk: Disk


class BlockBody(_WithPoints):
    block: Block


class ParticleBody(Part):
    particle: Particle


class RigidBody(_WithPoints):
    rigid: Rigid


Body = Annotated[
    Annotated[BarBody, Tag("<bar>")]
    | Annotated[DiskBody, Tag("<disk>")]
    | Annotated[BlockBody, Tag("<block>")]
    | Annotated[ParticleBody, Tag("<particle>")]
    | Annotated[RigidBody, Tag("<rigid>")],
    by_key("shape", "bar", "disk", "block", "particle", "rigid"),
]
