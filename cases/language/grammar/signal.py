"""Laws in time as a case file writes them: one of three keys beside the others of a force."""

from dataclasses import dataclass
from typing import Annotated, Any, get_args

from pydantic import ConfigDict, create_model

from ...signal import Law, Signal
from .field import In
from .part import Angle, Part
from .words import wrong

LAWS: tuple[Law, ...] = get_args(Law)


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
        law: Law = next(law for law in LAWS if getattr(self, law) is not None)
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
    count = mark.axes if axes is None else axes
    amplitude = _amount(mark.unit, count)
    sine = create_model(f"{title}Sine", __base__=Sine, amplitude=(amplitude, ...))
    kinds = (amplitude, _amount(f"{mark.unit}/s", count), sine)
    return {law: (kind | None, None) for law, kind in zip(LAWS, kinds, strict=True)}


def _amount(unit: str, axes: int) -> Any:
    number = Annotated[float, In(unit)]
    return number if axes == 1 else tuple[(number,) * axes]
