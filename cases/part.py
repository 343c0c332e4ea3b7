"""The parts of a scene as a case file writes them: bodies, joints, contacts and forces."""

import math
from typing import Annotated, Any, ClassVar, Self

from pydantic import (
    AfterValidator,
    BaseModel,
    ConfigDict,
    Discriminator,
    Field,
    ModelWrapValidatorHandler,
    Tag,
    ValidationError,
    model_validator,
)

from cases.field import IDENTIFIER, In, Text, Word, name, reference
from cases.words import in_words, wrong

Mass = Annotated[float, In("kg", above=0)]
Length = Annotated[float, In("m", above=0)]
Angle = Annotated[float, In("rad")]
Frequency = Annotated[float, In("rad/s", above=0)]
Name = Annotated[str, Text(name, f"^{IDENTIFIER}$")]
Point = Annotated[str, Text(reference, rf"^{IDENTIFIER}\.{IDENTIFIER}$", "body.point")]
Pair = tuple[Point, Point]
Position = tuple[Annotated[float, In("m")], Annotated[float, In("m")]]
Velocity = tuple[Annotated[float, In("m/s")], Annotated[float, In("m/s")]]
Newtons = tuple[Annotated[float, In("N")], Annotated[float, In("N")]]
NewtonsPerSecond = tuple[Annotated[float, In("N/s")], Annotated[float, In("N/s")]]


class Part(BaseModel):
    """A map with exactly these keys."""

    model_config = ConfigDict(strict=True, extra="forbid", frozen=True)

    @model_validator(mode="wrap")
    @classmethod
    def _in_words(cls, value: object, check: ModelWrapValidatorHandler[Self]) -> Self:
        try:
            return check(value)
        except ValidationError as error:
            raise in_words(error, tuple(cls.model_fields)) from None


def by_key(kind: str, **models: Any) -> Any:
    """The model named by the one key that says what a part is, so that mistakes stay sharp."""

    def tag(value: object) -> str | None:
        present = [word for word in models if isinstance(value, dict) and word in value]
        return f"<{present[0]}>" if len(present) == 1 else None

    tagged = [Annotated[model, Tag(f"<{word}>")] for word, model in models.items()]
    union = tagged[0]
    for model in tagged[1:]:
        union = union | model  # type: ignore[operator]
    choice = {"kind": kind, "words": list(models)}
    return Annotated[union, Discriminator(tag, "choice", "one of {words}", choice)]


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


AnyBody = BarBody | DiskBody | BlockBody | ParticleBody | RigidBody
Body = by_key(
    "shape", bar=BarBody, disk=DiskBody, block=BlockBody, particle=ParticleBody, rigid=RigidBody
)


class DrivenPoint(Part):
    at: Position
    velocity: Velocity


def _is_driven(value: object) -> str:
    return "<driven>" if isinstance(value, dict) else "<fixed>"


GroundPoint = Annotated[
    Annotated[Position, Tag("<fixed>")] | Annotated[DrivenPoint, Tag("<driven>")],
    Discriminator(_is_driven),
]


def _unit(value: tuple[float, float]) -> tuple[float, float]:
    length = math.hypot(*value)
    if length == 0:
        raise wrong("should be a direction, is [0, 0]")
    return value[0] / length, value[1] / length


Direction = Annotated[
    tuple[Annotated[float, In("1")], Annotated[float, In("1")]], AfterValidator(_unit)
]


class Pin(Part):
    pin: Pair


class Slide(Part):
    slide: Pair
    along: Direction = Field(description="in the axes of the first part")
    angle: Angle = 0.0


class Weld(Part):
    weld: Pair
    angle: Angle = 0.0


AnyJoint = Pin | Slide | Weld
Joint = by_key("joint", pin=Pin, slide=Slide, weld=Weld)


class Contact(Part):
    between: tuple[Annotated[str, Text()], Annotated[str, Text()]] = Field(
        description="a disk, then ground.floor"
    )
    friction: Annotated[float, In("1", least=0)]
    ideal: Annotated[str, Word("ideal", ("rolling",))] = Field(
        description="what the reference assumes, and checks at every sample"
    )


class Spring(Part):
    spring: Pair
    stiffness: Annotated[float, In("N/m", above=0)]
    rest_length: Annotated[float, In("m", least=0)]


class Damper(Part):
    damper: Pair
    damping: Annotated[float, In("N s/m", least=0)]


class PushSine(Part):
    amplitude: Newtons
    angular_frequency: Frequency
    phase: Angle = 0.0


class TorqueSine(Part):
    amplitude: Annotated[float, In("N m")]
    angular_frequency: Frequency
    phase: Angle = 0.0


class _InTime(Part):
    """A force that follows exactly one law in time."""

    laws: ClassVar[tuple[str, ...]] = ("constant", "ramp", "sine")
    model_config = ConfigDict(
        json_schema_extra={"oneOf": [{"required": [law]} for law in ("constant", "ramp", "sine")]}
    )

    def model_post_init(self, context: object) -> None:
        given = [law for law in self.laws if getattr(self, law) is not None]
        if len(given) != 1:
            has = f"has {' and '.join(given)}" if given else "has none"
            raise wrong(f"needs exactly one of constant, ramp, sine; {has}")


class Push(_InTime):
    push: Point
    constant: Newtons | None = None
    ramp: NewtonsPerSecond | None = None
    sine: PushSine | None = None


class Torque(_InTime):
    torque: Name
    constant: Annotated[float, In("N m")] | None = None
    ramp: Annotated[float, In("N m/s")] | None = None
    sine: TorqueSine | None = None


AnyForce = Spring | Damper | Push | Torque
Force = by_key("force", spring=Spring, damper=Damper, push=Push, torque=Torque)
