"""The keys that may stand in a case file. cases/README.md explains every one by an example."""

from typing import Annotated, Any

from pydantic import Field, Tag

from ...fields.field import Bound, In, Literal
from ...fields.number import Amount
from ...fields.part import Name, Part, plain_or_map
from ...fields.text import Text, label, no_formula
from ...fields.words import wrong
from .event import Event, Quantity
from .scene import Scene, SpatialScene
from .source import Source
from .start import Initial, Near, SpatialStart
from .states import Drawn

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


class SpatialFile(File):
    """A case: one claim about the motion of one scene in space."""

    scene: SpatialScene  # pyright: ignore[reportIncompatibleVariableOverride]
    initial: dict[Name, SpatialStart]  # pyright: ignore[reportIncompatibleVariableOverride]
    near: dict[Name, SpatialStart] = Field(  # pyright: ignore[reportIncompatibleVariableOverride]
        {}, description="a guess, where the constraints have more than one solution"
    )


OVERLAID = tuple(key for key in File.model_fields if key not in FIXED)
