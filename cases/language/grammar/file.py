"""The keys that may stand in a case file. cases/README.md explains every one by an example."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import AfterValidator, BeforeValidator, Field, Tag

from ...fields.event import Rule
from ...fields.field import NUMBER, Bound, In, Literal, Plain
from ...fields.number import Amount, Names, number, shown
from ...fields.part import Name, Part, plain_or_list, plain_or_map
from ...fields.text import THREAD, Place, Text, Word, equation, label, no_formula, thread_name
from ...fields.words import wrong
from ...mistake import NO_VALUE, nearest
from ...scene.states import Span, States
from .scene import Scene, SpatialScene
from .start import Initial, Near, SpatialStart

# A claim about states as a case file writes it, in place of a start and a duration.


MOST = 10_000  # states of a file: a minute of its reference


def _check_order(span: Span) -> Span:
    if span[0] > span[1]:
        raise wrong(f"should be a list [low, high], is [{span[0]:g}, {span[1]:g}]")
    return span


_Number = Annotated[float, In("1")]
_Span = Annotated[tuple[_Number, _Number], AfterValidator(_check_order)]


def _at_most(count: int) -> int:
    if count > MOST:
        raise wrong(f"must be at most {MOST}, is {count}")
    return count


class Drawn(Part):
    """So many unrelated states, with every coordinate drawn evenly from a span, in SI."""

    random: Annotated[int, AfterValidator(_at_most)] = Field(ge=3, description="how many")
    seed: int = Field(ge=0, description="of the random numbers: another one draws other states")
    q: _Span = Field(description="from which the places are drawn, [low, high] in m and rad")
    q_dot: _Span = Field(description="from which the rates are drawn")
    q_ddot: _Span = Field((0.0, 0.0), description="from which the accelerations are drawn")

    @property
    def states(self) -> States:
        """As a noun."""
        return States(self.random, self.seed, self.q, self.q_dot, self.q_ddot)


# Events as a case file writes them: one quantity and its rule.
#
# `{touch.slip: stays zero}`, `{jumper.y: {falls to: 0.5}}`.


RULES: tuple[Rule, ...] = get_args(Rule)
CROSSES: Mapping[str, Rule] = {"falls to": "falls to zero", "rises to": "rises to zero"}
MAP = "`{falls to: 0.5}`"

Quantity = Annotated[str, Text(description="part.field, as crank.angle")]


@dataclass(frozen=True)
class Crossing:
    """A rule, and to which value the quantity comes; its unit is known when the scene is."""

    word: Rule
    to: Amount


@dataclass(frozen=True)
class RuleWords(Plain):
    """A rule in words, or a map of one, `{falls to: 0.5}`, with the value it comes to."""

    def check(self, value: object, known: Names) -> Crossing:
        if isinstance(value, str):
            return Crossing(_word(value, known), Amount(0.0))
        if not isinstance(value, dict):
            raise wrong(f"should be one of {', '.join(RULES)}, or {MAP}, is {shown(value)}")
        if len(value) != 1:
            raise wrong(f"should be one rule with its value, as {MAP}, has {len(value)}")
        ((word, to),) = value.items()
        if word in RULES:
            raise wrong(f"{word!r} takes no value: write it alone, or {MAP}")
        if word not in CROSSES:
            raise wrong(f"unknown rule {word!r}{nearest(word, CROSSES)}")
        if to is None:
            raise wrong(NO_VALUE)
        return Crossing(CROSSES[word], number(to, None, known) or Amount(float("nan")))

    def schema(self) -> dict[str, Any]:
        to = {"anyOf": [{"type": "number"}, {"type": "string"}]}
        to["description"] = f"{NUMBER}, in the quantity's unit"  # type: ignore[assignment]
        value = {
            "type": "object",
            "properties": dict.fromkeys(CROSSES, to),
            "additionalProperties": False,
            "minProperties": 1,
            "maxProperties": 1,
        }
        return {"anyOf": [{"enum": list(RULES)}, value]}


def _word(text: str, known: Names) -> Rule:
    for way in CROSSES:
        if text.startswith(f"{way} ") and text not in RULES:
            raise wrong(f"unknown rule {text!r}; a value other than zero is written as {MAP}")
    word: Any = Word("rule", RULES).check(text, known)
    return word


def _check_single(value: object) -> object:
    if isinstance(value, dict) and len(value) == 1:
        return value
    has = f"has {len(value)}" if isinstance(value, dict) else f"is {shown(value)}"
    raise wrong(f"should be one quantity with its rule (`touch.slip: stays zero`), {has}")


Event = Annotated[
    dict[Quantity, Annotated[Crossing, RuleWords()]],
    BeforeValidator(_check_single),
    Field(json_schema_extra={"minProperties": 1, "maxProperties": 1}),
]


# Where a case comes from: places in the book, or the public question that it answers.


BookPlace = Annotated[str, Place()]
Places = Annotated[
    Annotated[str, Place(), Tag("<plain>")] | Annotated[tuple[BookPlace, ...], Tag("<list>")],
    plain_or_list(),
]


class Source(Part):
    """Where the case comes from: places in the book as text, for "2.10" is not 2.1; a question."""

    equations: tuple[Annotated[str, Place(equation, r"^2\.[1-9][0-9]?$")], ...] = ()
    example: BookPlace | None = None
    exercise: BookPlace | None = None
    figure: Places | None = None  # one, or a list of several
    section: BookPlace | None = None
    thread: Annotated[str, Text(thread_name, THREAD)] | None = Field(
        default=None, description="the public question that it answers: owner/repository#number"
    )

    @property
    def figures(self) -> tuple[str, ...]:
        """The figures that are given."""
        return (self.figure,) if isinstance(self.figure, str) else self.figure or ()


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


def overlay_schema(schema: dict[str, Any], keys: Sequence[str]) -> None:
    """Alters the schema of variants: each has some of the keys."""
    for pattern in schema["patternProperties"]:
        overlay = {"type": "object", "propertyNames": {"enum": [*keys]}}
        schema["patternProperties"][pattern] = overlay


class File(Part):
    """A case: one claim about the motion of one scene, or about its states."""

    elsewhere = dict.fromkeys(Scene.model_fields, "it stands in `scene`")

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
        json_schema_extra=lambda schema: overlay_schema(schema, OVERLAID),
    )


class SpatialFile(File):
    """A case: one claim about the motion of one scene in space."""

    scene: SpatialScene  # pyright: ignore[reportIncompatibleVariableOverride]
    initial: dict[Name, SpatialStart]  # pyright: ignore[reportIncompatibleVariableOverride]
    near: dict[Name, SpatialStart] = Field(  # pyright: ignore[reportIncompatibleVariableOverride]
        {}, description="a guess, where the constraints have more than one solution"
    )


OVERLAID = tuple(key for key in File.model_fields if key not in FIXED)
