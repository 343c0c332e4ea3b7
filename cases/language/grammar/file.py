"""The keys that may stand in a case file. cases/README.md explains every one by an example."""

from typing import Annotated, Any

from pydantic import ConfigDict, Field, Tag

from ...fields.field import Bound, In, Literal, Space
from ...fields.gravity import Gravity
from ...fields.number import Amount
from ...fields.part import Angle, Name, Part, Point, Position, plain_or_list, plain_or_map, written
from ...fields.text import Text, Word, label, no_formula
from ...fields.words import wrong
from .body import Body
from .constraint import Constraint
from .contact import Contact
from .drive import Driven, Rate
from .event import Event, Quantity
from .force import Force
from .ground import GroundPoint
from .joint import Joint
from .plane import Plane
from .source import Source
from .states import Drawn

POLAR = ("from_", "length", "direction")  # how a start gives a place by a distance
WAYS = ("", ".law", ".driver", ".limit")  # after an engine's name: which of its rows

Tolerance = Annotated[Amount, Bound()]
Seconds = Annotated[float, In("s", above=0)]
Engine = Annotated[str, Text(description="an engine's name")]  # which there are is checked later
Way = Annotated[str, Text(description="an engine, or engine.law, engine.driver, engine.limit")]
Setting = Annotated[str, Text(description="engine.setting, as engine.shipped")]
Step = Annotated[
    Annotated[Seconds, Tag("<plain>")]
    | Annotated[dict[Engine, Seconds], Field(min_length=1), Tag("<map>")],
    plain_or_map(),
]


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


class Near(Part):
    """A guess of where a body is, by its coordinates or by the places of its points."""

    model_config = ConfigDict(extra="allow")
    __pydantic_extra__: dict[str, Position] = Field(init=False)  # type: ignore[assignment]

    x: Annotated[float, In("m")] | None = None
    y: Annotated[float, In("m")] | None = None
    angle: Angle | None = None

    @property
    def places(self) -> dict[str, tuple[float, float]]:
        """Where points of the body are."""
        return self.__pydantic_extra__

    @property
    def given(self) -> dict[str, float]:
        """Coordinates and rates by name."""
        numbers = {key: getattr(self, key) for key in type(self).model_fields if key not in POLAR}
        return {key: number for key, number in numbers.items() if isinstance(number, float)}

    @property
    def keys(self) -> set[str]:
        """The keys that are given, as they are written."""
        fields = written(type(self)).items()
        return {key for key, name in fields if name in self.model_fields_set} | {*self.places}

    @property
    def polar(self) -> tuple[str, float, float] | None:
        """A point of the ground, and how far [m] and in which direction [rad] the centre is."""
        return None

    @property
    def attitude(self) -> None:
        """None in the plane, where a body has an angle."""

    @property
    def stands_on(self) -> tuple[str, ...]:
        """The points that stand on their planes: only a start has any."""
        return ()


class Initial(Near):
    """How a body starts: coordinates and rates, or places of its points; or an edge, or a joint."""

    from_: Point | None = Field(None, alias="from", description="a point of the ground")
    length: Annotated[float, In("m", above=0)] | None = Field(
        None, description="how far from that point the centre is"
    )
    direction: Angle | None = Field(None, description="in which direction from it, from x")

    vx: Annotated[float, In("m/s")] | None = None
    vy: Annotated[float, In("m/s")] | None = None
    omega: Annotated[float, In("rad/s")] | None = None
    shift: Annotated[float, In("m")] | None = Field(None, description="of a joint, along its line")
    speed: Annotated[float, In("m/s")] | None = Field(
        None, description="of an edge or a joint, along it"
    )
    on: (
        Annotated[
            Annotated[Name, Tag("<plain>")] | Annotated[tuple[Name, Name], Tag("<list>")],
            plain_or_list(),
        ]
        | None
    ) = Field(None, description="the point of the body that stands on its plane, or two")

    @property
    def stands_on(self) -> tuple[str, ...]:
        return (self.on,) if isinstance(self.on, str) else self.on or ()

    @property
    def polar(self) -> tuple[str, float, float] | None:
        """Where all three are given."""
        if self.from_ is None or self.length is None or self.direction is None:
            return None
        return self.from_, self.length, self.direction


class Deviation(Part):
    """A known difference of a model: its limit for h → 0, or an interval at the case's step."""

    limit: Tolerance | None = None
    by: tuple[Tolerance, Tolerance] | None = None
    because: Annotated[str, Text(no_formula)]

    def model_post_init(self, context: object) -> None:
        if (self.limit is None) == (self.by is None):
            raise wrong("needs exactly one of limit, by")
        if self.by is not None and self.by[0].value >= self.by[1].value:
            raise wrong("`by` should be a list [low, high], low < high")


FIXED = ("title", "source", "variants")  # what a variant cannot change


def _overlay_schema(schema: dict[str, Any]) -> None:
    keys = [key for key in File.model_fields if key not in FIXED]
    for pattern in schema["patternProperties"]:
        overlay = {"type": "object", "propertyNames": {"enum": keys}}
        schema["patternProperties"][pattern] = overlay


class File(Part):
    """A case: one claim about the motion of one scene, or about its states."""

    elsewhere = {"drive": "it stands in `scene`"}  # noqa: RUF012  # a ClassVar of Part

    title: Annotated[str, Text()]
    source: Source = Source()
    system: Annotated[str, Text()] | None = Field(
        None,
        description="the hand-written system in reference/systems; absent: the reference "
        "is generated from the scene",
    )
    parameters: dict[Annotated[str, Text(label)], Annotated[Amount, Literal()]] = Field(
        {}, description="numbers that the rest of the file names"
    )
    drops_out: tuple[Annotated[str, Text()], ...] = Field(
        (), description="parameters on which the motion does not depend"
    )
    scene: Scene
    initial: dict[Name, Initial]
    near: dict[Name, Near] = Field(
        {}, description="a guess, where the constraints have more than one solution"
    )
    states: Drawn | None = Field(
        None, description="in place of a start and a duration: a claim about states"
    )
    events: dict[Name, Event] = Field(
        {}, description="named instants: when a quantity comes to zero or leaves it"
    )
    tube: Annotated[float, In("s", least=0)] = Field(
        0.0, description="how long a jump at an event may take: what is after it is read so late"
    )
    duration: Seconds
    samples: int = Field(ge=3, description="number of times at which anything is compared")
    step: Step = Field(
        {}, description="step of the tuned settings: one number, or engine by engine"
    )
    allow: dict[Quantity, Annotated[Amount | None, Bound("unknown")]] = Field(
        min_length=1, description="what still counts as textbook mechanics, for every engine"
    )
    reach: dict[Way, dict[Quantity, Tolerance]] = Field(
        {}, description="what the tuned setting of an engine must hold at the step"
    )
    deviates: dict[Setting, dict[Quantity, Deviation]] = Field(
        {}, description="known differences of an engine's model"
    )
    rests: bool = Field(False, description="nothing moves here, on purpose")
    stays: tuple[Quantity, ...] = Field(
        (), description="places and velocities that stay what they were, and that is the claim"
    )
    variants: dict[Name, dict[str, Any]] = Field(
        {},
        description="each a deep overlay of the keys above, but title and source",
        json_schema_extra=_overlay_schema,
    )


OVERLAID = tuple(key for key in File.model_fields if key not in FIXED)
