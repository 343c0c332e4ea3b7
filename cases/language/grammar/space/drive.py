"""Prescribed rates as a case file writes them: a number, or one of the laws in time."""

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Tag

from ....signal import Law, Signal
from ..field import AnyUnit
from ..number import Amount
from ..part import Made, plain_or_map
from ..signal import LAWS, Following, Sine

_Amount = Annotated[Amount, AnyUnit()]


@dataclass(frozen=True)
class Drive:
    """A law in time whose unit is that of the rate it prescribes."""

    law: Law
    amount: Amount
    angular_frequency: float = 0.0
    phase: float = 0.0

    @property
    def signal(self) -> Signal:
        """Its numbers in SI."""
        return Signal(self.law, (self.amount.value,), self.angular_frequency, self.phase)


class _DriveSine(Sine):
    amplitude: _Amount


class _InTime(Following):
    constant: _Amount | None = None
    ramp: _Amount | None = None
    sine: _DriveSine | None = None


def _drive(written: Any) -> Drive:
    law: Law = next(law for law in LAWS if getattr(written, law) is not None)
    given = getattr(written, law)
    if isinstance(given, _DriveSine):
        return Drive(law, given.amplitude, given.angular_frequency, given.phase)
    return Drive(law, given)


Driven = Annotated[
    Annotated[Drive, Made(_Amount, lambda amount: Drive("constant", amount)), Tag("<plain>")]
    | Annotated[Drive, Made(_InTime, _drive), Tag("<map>")],
    plain_or_map(),
]
