"""Grammar of laws in time: what a force, a prescribed velocity or a moved point follows.

A force has the law as one key among its others (`sine: {…}`). What is prescribed has a map with
that one key as its value, and a plain number there is a constant. From what is written the noun
`Signal` is made. The models are built by `law_fields`, since an amplitude's unit and its number of
axes depend on what follows the law.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import Annotated, Any, ClassVar, get_args

from pydantic import AfterValidator, ConfigDict, GetCoreSchemaHandler, Tag, create_model
from pydantic_core import CoreSchema

from .field import AnyUnit, Coefficients, In
from .number import Amount, per_second
from .part import Angle, Made, Part, plain_or_map, unit
from .signal import Law as LawName
from .signal import Signal
from .words import wrong

LAWS: tuple[LawName, ...] = get_args(LawName)
JUMPS: tuple[LawName, ...] = ("step", "pulse")  # laws that no velocity can follow
Instant = Annotated[float, In("s", least=0)]


@dataclass(frozen=True)
class InTime:
    """Marks a field that holds a signal: the unit of its amplitude, and along how many axes."""

    unit: str
    axes: int


class Numbers(Part):
    """Base of the laws that have several numbers; to each is added the field for its size.

    It is `amplitude`, or the unit vector `along` of a law that has values of its own.
    """

    def noun(self) -> dict[str, Any]:
        """Returns the numbers as arguments of `Signal`, by name."""
        return dict(self)


class Sine(Numbers):
    """How far and how fast it swings, and where it begins."""

    angular_frequency: Annotated[float, In("rad/s", above=0)]
    phase: Angle = 0.0


class Step(Numbers):
    """Nothing, and then all of it."""

    at: Instant

    def noun(self) -> dict[str, Any]:
        # The amplitude is added: by its plain name a type checker would not find it here.
        return {"amplitude": getattr(self, "amplitude"), "times": (self.at,)}  # noqa: B009


class Pulse(Numbers):
    """Nothing, all of it for a while, and nothing again: `from` one instant `until` another."""

    until: Instant

    def model_post_init(self, context: object) -> None:
        if self.begins >= self.until:
            raise wrong(f"`until` ({self.until:g}) should be later than `from` ({self.begins:g})")

    @property
    def begins(self) -> float:
        """`from`, which is no name in Python."""
        return getattr(self, "from")

    def noun(self) -> dict[str, Any]:
        return {"amplitude": getattr(self, "amplitude"), "times": (self.begins, self.until)}  # noqa: B009


class Polynomial(Numbers):
    """c₀ + c₁ t + c₂ t² …"""

    coefficients: tuple[Any, ...]

    def noun(self) -> dict[str, Any]:
        # Along one axis there is no key `along`.
        return {"amplitude": getattr(self, "along", 1.0), "values": self.coefficients}


class Table(Numbers):
    """Values at times, lines between them, and outside the nearest value."""

    times: tuple[Instant, ...]
    values: tuple[Any, ...]

    def model_post_init(self, context: object) -> None:
        if len(self.times) < 2:
            raise wrong(f"needs at least 2 `times`, has {len(self.times)}")
        if len(self.times) != len(self.values):
            raise wrong(f"has {len(self.times)} times and {len(self.values)} values")
        for before, after in pairwise(self.times):
            if before >= after:
                raise wrong(f"`times` should rise, but {after:g} follows {before:g}")

    def noun(self) -> dict[str, Any]:
        along = getattr(self, "along", 1.0)
        return {"amplitude": along, "times": self.times, "values": self.values}


class Following(Part):
    """Base of what follows exactly one law in time: it has a field for each, and one is given."""

    laws: ClassVar[tuple[LawName, ...]] = LAWS
    model_config = ConfigDict(json_schema_extra={"oneOf": [{"required": [law]} for law in LAWS]})

    def model_post_init(self, context: object) -> None:
        given = [law for law in self.laws if getattr(self, law) is not None]
        if len(given) != 1:
            has = f"has {' and '.join(given)}" if given else "has none"
            raise wrong(f"needs exactly one of {', '.join(self.laws)}; {has}")

    @property
    def law(self) -> LawName:
        """The name of the law that is given."""
        return next(law for law in self.laws if getattr(self, law) is not None)

    @property
    def signal(self) -> Signal:
        """The law that is given, as the noun, with all numbers in SI."""
        given = getattr(self, self.law)
        noun = given.noun() if isinstance(given, Numbers) else {"amplitude": given}
        numbers = {key: _plain(number) for key, number in noun.items()}
        amplitude = numbers.pop("amplitude")
        entries = amplitude if isinstance(amplitude, tuple) else (amplitude,)
        return Signal(self.law, entries, **numbers)

    def amounts(self) -> Iterator[tuple[tuple[str | int, ...], Amount, int]]:
        """Yields the numbers whose unit is known later, when the scene is.

        Each with its place below this part, and how often it is "per second" more than the rest:
        once in a ramp, k times as the coefficient of tᵏ.
        """
        given = getattr(self, self.law)
        # A constant and a ramp are one number, which has no key of its own.
        numbers = dict(given) if isinstance(given, Numbers) else {None: given}
        for key, number in numbers.items():
            path = (self.law,) if key is None else (self.law, key)
            if isinstance(number, Amount):
                yield path, number, int(self.law == "ramp")
            elif key in ("coefficients", "values"):
                for k, entry in enumerate(number):
                    yield (*path, k), entry, k if key == "coefficients" else 0


class Prescribed(Following):
    """Base of a law for a prescribed velocity: no law that jumps, for a jump is a blow."""

    laws: ClassVar[tuple[LawName, ...]] = tuple(law for law in LAWS if law not in JUMPS)
    model_config = ConfigDict(json_schema_extra={"oneOf": [{"required": [law]} for law in laws]})
    elsewhere = dict.fromkeys(
        JUMPS, "a velocity that jumps is a blow; a `table` climbs in a time that you choose"
    )


class Moving(Following):
    """A law in time of a place, whose velocity cannot jump either."""

    laws: ClassVar[tuple[LawName, ...]] = ("ramp", "sine", "polynomial")
    model_config = ConfigDict(json_schema_extra={"oneOf": [{"required": [law]} for law in laws]})
    elsewhere = dict.fromkeys(
        (*JUMPS, "table"), "a velocity that jumps is a blow; take a `polynomial`"
    )


def signal_fields(title: str, signal: Any, axes: int | None = None) -> dict[str, tuple[Any, Any]]:
    """Returns the keys that give the `signal` of a force, as fields of its model.

    signal: the noun's annotated field, marked with InTime. axes: along how many it has an
    amplitude, if not along as many as the mark says. title: what the models' names begin with.
    """
    (mark,) = (mark for mark in signal.__metadata__ if isinstance(mark, InTime))
    return law_fields(title, mark.unit, mark.axes if axes is None else axes)


def law_fields(
    title: str, unit: str | None, axes: int, laws: Any = LAWS
) -> dict[str, tuple[Any, Any]]:
    """Returns a field for each of the laws, None by default: its key, its model and the default.

    axes: along how many the amplitude has entries. unit: of the amplitude; None where it is known
    later, with the scene, as of a prescribed rate.
    """
    size = _amount(unit, axes)
    along = {} if axes == 1 else {"along": (_direction(axes), ...)}
    numbers: dict[LawName, tuple[type[Numbers], dict[str, Any]]] = {
        "sine": (Sine, {"amplitude": size}),
        "step": (Step, {"amplitude": size}),
        "pulse": (Pulse, {"amplitude": size, "from": Instant}),
        "polynomial": (Polynomial, {"coefficients": Annotated[Any, Coefficients(unit)]}),
        "table": (Table, {"values": tuple[_amount(unit, 1), ...]}),
    }
    # A ramp's number is a rate; a unit that is not known yet stays None.
    kinds: dict[LawName, Any] = {
        "constant": size,
        "ramp": _amount(unit and per_second(unit, 1), axes),
    }
    for word, (base, types) in numbers.items():
        fields: dict[str, Any] = {key: (kind, ...) for key, kind in types.items()}
        fields |= along if word in ("polynomial", "table") else {}
        kinds[word] = create_model(
            f"{title}{word.capitalize()}", __base__=base, __doc__=base.__doc__, **fields
        )
    return {word: (kinds[word] | None, None) for word in laws}


@dataclass(frozen=True, eq=False)
class PrescribedLaw:
    """Marks a field with a signal of one axis, written as a number or as a map with its law."""

    unit: str

    def __get_pydantic_core_schema__(
        self, source: object, handler: GetCoreSchemaHandler
    ) -> CoreSchema:
        fields: dict[str, Any] = law_fields("Prescribed", self.unit, 1, Prescribed.laws)
        model = create_model("Prescribed", __base__=Prescribed, __doc__="A law in time.", **fields)
        constant = Made(_amount(self.unit, 1), lambda value: Signal("constant", (value,)))
        number: Any = Annotated[Signal, constant, Tag("<plain>")]
        law: Any = Annotated[Signal, Made(model, lambda written: written.signal), Tag("<map>")]
        return handler.generate_schema(Annotated[number | law, plain_or_map()])


def _plain(number: Any) -> Any:
    """Returns the number, or the tuple of them, in SI, without its unit."""
    if isinstance(number, tuple):
        return tuple(map(_plain, number))
    return number.value if isinstance(number, Amount) else number


def _amount(unit: str | None, axes: int) -> Any:
    """Returns the type of a number, or along several axes of a tuple; unit None: any for now."""
    number: Any = Annotated[Amount, AnyUnit()] if unit is None else Annotated[float, In(unit)]
    return number if axes == 1 else tuple[(number,) * axes]


def _direction(axes: int) -> Any:
    """Returns the type of a direction, made a unit vector, along which a law of one number acts."""
    entries: Any = tuple[(Annotated[float, In("1")],) * axes]
    return Annotated[entries, AfterValidator(unit)]
