"""Prescribed rates as a case file writes them: a number, or one of the laws in time."""

from dataclasses import dataclass
from typing import Annotated, Any

from pydantic import Tag, create_model

from ...fields.field import AnyUnit
from ...fields.number import Amount
from ...fields.part import Made, plain_or_map
from ...fields.signal import Signal
from ...fields.signal_grammar import Prescribed, law_fields
from ...fields.text import IDENTIFIER, Text, rate
from ...mistake import Path

Rate = Annotated[str, Text(rate, rf"^{IDENTIFIER}\.{IDENTIFIER}$", "joint.rate, as q1.omega")]
_Amount = Annotated[Amount, AnyUnit()]


@dataclass(frozen=True)
class Drive:
    """A law in time whose unit is that of the rate it prescribes.

    amounts: where its numbers stand, and how often each is "per second" more than the rate.
    """

    signal: Signal
    amounts: tuple[tuple[Path, Amount, int], ...]


_fields: dict[str, Any] = law_fields("Drive", None, 1, Prescribed.laws)
_InTime = create_model("Drive", __base__=Prescribed, __doc__="A law in time.", **_fields)


def _number(amount: Amount) -> Drive:
    return Drive(Signal("constant", (amount.value,)), (((), amount, 0),))


def _law(written: Any) -> Drive:
    return Drive(written.signal, tuple(written.amounts()))


Driven = Annotated[
    Annotated[Drive, Made(_Amount, _number), Tag("<plain>")]
    | Annotated[Drive, Made(_InTime, _law), Tag("<map>")],
    plain_or_map(),
]
