"""The keys that may stand in a case file with a `model` of the user's own in place of a scene."""

from collections.abc import Mapping
from pathlib import Path
from typing import Annotated, Any, ClassVar

from pydantic import ConfigDict, Discriminator, Field, Tag, create_model

from ...fields.field import AnyUnit, Bound, In
from ...fields.number import Amount
from ...fields.part import Made, Name, Part, plain_or_list, plain_or_map
from ...fields.signal import Signal
from ...fields.signal_grammar import LAWS, Following, Table, law_fields
from ...fields.text import Text, Word
from ...model_case import DURATION, JOINTS, SAMPLES, TOLERANCE, Law, RandomRates, Steps
from .file import overlay_schema

ModelName = Annotated[str, Text(description="a name of the model's")]
Number = Annotated[Amount, AnyUnit()]
Numbers = Annotated[
    Annotated[tuple[Amount], Made(Number, lambda number: (number,)), Tag("<plain>")]
    | Annotated[tuple[Number, ...], Field(min_length=1), Tag("<list>")],
    plain_or_list(),
]


class Rates(Part):
    """How large rates drawn by chance are at most, and the seed of the numbers."""

    most: Annotated[float, In("1", least=0)] = 0.5
    seed: int = Field(0, ge=0)

    @property
    def noun(self) -> RandomRates:
        """As a noun."""
        return RandomRates(self.most, self.seed)


class Start(Part):
    """Where a model starts: a keyframe by name, joints and rates by name over it."""

    keyframe: ModelName | None = None
    joints: dict[ModelName, Numbers] = Field({})
    rates: dict[ModelName, Numbers] = Field({})
    random_rates: Rates | None = None


def _default_start() -> Start:
    return Start(joints={}, rates={})


class Held(Table):
    """Values at times, each of which stays until the next."""


class Control(Following):
    """A law in time of a control; `held`: a table whose values stay until the next one."""

    laws: ClassVar[tuple[Any, ...]] = (*LAWS, "held")
    model_config = ConfigDict(json_schema_extra={"oneOf": [{"required": [law]} for law in laws]})
    held: Any = None

    @property
    def control(self) -> Law:
        """The law that is given, as the noun."""
        table = self.held
        if table is None:
            return self.signal
        return Steps(table.times, tuple(number.value for number in table.values))


_HELD: dict[str, Any] = {"values": (tuple[Number, ...], ...)}
_HeldTable: Any = create_model("ControlHeld", __base__=Held, __doc__=Held.__doc__, **_HELD)
_LAWS: dict[str, Any] = law_fields("Control", None, 1) | {"held": (_HeldTable | None, None)}
_InTime = create_model("ControlInTime", __base__=Control, __doc__="A law in time.", **_LAWS)


def _law(written: Any) -> Law:
    return written.control


def _constant(amount: Amount) -> Law:
    return Signal("constant", (amount.value,))


Driven = Annotated[
    Annotated[Law, Made(Number, _constant), Tag("<plain>")]
    | Annotated[Law, Made(_InTime, _law), Tag("<map>")],
    plain_or_map(),
]
File = Annotated[str, Text(description="a CSV file: `time` [s], and a column for each actuator")]
BETWEEN = ("held", "lines")


class ControlFile(Part):
    """Controls from a CSV file; between its times each value is held, or lines go between them."""

    table: File
    between: Annotated[str, Word("way", BETWEEN)] = "held"


def _kind(value: object) -> str:
    """A map whose `table` is text names a file; an actuator of that name has a law or a number."""
    if isinstance(value, str):
        return "<file>"
    named = isinstance(value, Mapping) and isinstance(value.get("table"), str)
    return "<table>" if named else "<map>"


Controls = Annotated[
    Annotated[ControlFile, Made(File, lambda file: ControlFile(table=file)), Tag("<file>")]
    | Annotated[ControlFile, Tag("<table>")]
    | Annotated[dict[ModelName, Driven], Tag("<map>")],
    Discriminator(_kind),
]
Bar = Annotated[Amount, Bound()]


def _any_of(schema: dict[str, Any]) -> None:
    """Alters the schema of controls: a map with a `table` may name a file or an actuator."""
    schema["anyOf"] = schema.pop("oneOf")


def _everywhere(bar: Amount) -> dict[str, Amount]:
    return {JOINTS: bar}


Allowed = Annotated[
    Annotated[dict[str, Amount], Made(Bar, _everywhere), Tag("<plain>")]
    | Annotated[dict[ModelName, Bar], Field(min_length=1), Tag("<map>")],
    plain_or_map(),
]


class ModelFile(Part):
    """A case of a model of the user's own."""

    elsewhere: ClassVar[Mapping[str, str]] = {
        "scene": "a case has a `model` or a `scene`",
        "system": "a model has none",
    }

    model: Annotated[str, Text(description="the MJCF or URDF, beside this file")]
    title: Annotated[str, Text()] = ""
    initial: Start = Field(default_factory=_default_start)
    control: Controls = Field({}, json_schema_extra=_any_of)
    contacts: Annotated[str, Word("word", ("on", "off"))] = "on"
    duration: Annotated[float, In("s", above=0)] = DURATION
    samples: int = Field(SAMPLES, ge=3, description="number of times at which anything is compared")
    allow: Allowed = Field({JOINTS: Amount(TOLERANCE)})
    variants: dict[Name, dict[str, Any]] = Field(
        {},
        description="each a deep overlay of the keys above, but title",
        json_schema_extra=lambda schema: overlay_schema(schema, OVERLAID),
    )

    def path(self, beside: str) -> str:
        """The model's file, which stands beside the case's unless its path is whole."""
        return str((Path(beside).parent / self.model).resolve())


FIXED = ("title", "variants")
OVERLAID = tuple(key for key in ModelFile.model_fields if key not in FIXED)
