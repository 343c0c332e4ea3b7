"""Laws in time as a case file writes them: one of three keys beside the others of a force.

What is prescribed has such a law as its value, and a plain number is a constant one.
"""

from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import ConfigDict, GetCoreSchemaHandler, Tag, create_model
from pydantic_core import CoreSchema

from ...signal import Law as Word
from ...signal import Signal
from .field import In
from .part import Angle, Made, Part, plain_or_map
from .words import wrong

LAWS: tuple[Word, ...] = get_args(Word)


@dataclass(frozen=True)
class InTime:
    """Marks a signal: the unit of its amplitude, and along how many axes it has one."""

    unit: str
    axes: int


class Sine(Part):
    """How fast it swings, and where it begins; what it is for adds how far."""

    angular_frequency: Annotated[float, In("rad/s", above=0)]
    phase: Angle = 0.0


class Following(Part):
    """What follows exactly one law in time."""

    model_config = ConfigDict(json_schema_extra={"oneOf": [{"required": [law]} for law in LAWS]})

    def model_post_init(self, context: object) -> None:
        given = [law for law in LAWS if getattr(self, law) is not None]
        if len(given) != 1:
            has = f"has {' and '.join(given)}" if given else "has none"
            raise wrong(f"needs exactly one of {', '.join(LAWS)}; {has}")

    @property
    def signal(self) -> Signal:
        """The law that is given."""
        law: Word = next(law for law in LAWS if getattr(self, law) is not None)
        given = getattr(self, law)
        numbers = dict(given) if isinstance(given, Sine) else {"amplitude": given}
        amplitude = numbers.pop("amplitude")
        entries = amplitude if isinstance(amplitude, tuple) else (amplitude,)
        return Signal(law, entries, **numbers)


def law(title: str, signal: Any, axes: int | None = None) -> dict[str, tuple[Any, Any]]:
    """The three keys that give the `signal` of a force, as fields of its model.

    axes: along how many it has an amplitude, if not along as many as it is marked with.
    """
    (mark,) = (mark for mark in signal.__metadata__ if isinstance(mark, InTime))
    return keys(title, mark.unit, mark.axes if axes is None else axes)


def keys(title: str, unit: str, axes: int) -> dict[str, tuple[Any, Any]]:
    """The three keys of a law, for so many axes."""
    amplitude = _amount(unit, axes)
    sine = create_model(f"{title}Sine", __base__=Sine, amplitude=(amplitude, ...))
    kinds = (amplitude, _amount(f"{unit}/s", axes), sine)
    return {law: (kind | None, None) for law, kind in zip(LAWS, kinds, strict=True)}


@dataclass(frozen=True, eq=False)
class Law:
    """Marks a signal of one axis that stands as a value: a number, or a map with its law."""

    unit: str

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        fields: dict[str, Any] = keys("Prescribed", self.unit, 1)
        model = create_model("Prescribed", __base__=Following, __doc__="A law in time.", **fields)
        constant = Made(_amount(self.unit, 1), lambda value: Signal("constant", (value,)))
        number: Any = Annotated[Signal, constant, Tag("<plain>")]
        law: Any = Annotated[Signal, Made(model, lambda written: written.signal), Tag("<map>")]
        return handler.generate_schema(Annotated[number | law, plain_or_map()])


def _amount(unit: str, axes: int) -> Any:
    number = Annotated[float, In(unit)]
    return number if axes == 1 else tuple[(number,) * axes]
