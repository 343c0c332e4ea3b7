"""Laws in time in a script's words, where t [s] is the present time and h [s] the step."""

from collections.abc import Callable, Iterable
from inspect import getsource

from ....cases.fields.signal import Law, Signal
from ...signal import table, under


def as_text(law: Signal, *, midpoint: bool = False) -> list[str]:
    """Its components; midpoint: t is the middle of a step, over which a corner is spread."""
    words = MEANS if midpoint and law.corners else NOW
    factor = words[law.law](law)
    return [f"{amplitude!r}{factor}" for amplitude in law.amplitude]


def helpers(laws: Iterable[Signal]) -> list[str]:
    """Lines with the functions that a script has to define for the laws."""
    if all(law.law != "table" for law in laws):
        return []
    lines = ["from bisect import bisect_right", "from itertools import pairwise"]
    for helper in (table, under):
        lines += ["", "", *getsource(helper).splitlines()]
    return [*lines, ""]


def _polynomial(law: Signal) -> str:
    return f" * ({' + '.join(f'{c!r} * t**{k}' for k, c in enumerate(law.values))})"


def _after(begins: float) -> str:
    """The share of the step around t that is after an instant."""
    return f"min(1.0, max(0.0, (t + h / 2 - {begins!r}) / h))"


def _over(law: Signal) -> str:
    ends = (f"under({law.times}, {law.values}, t {sign} h / 2)" for sign in "+-")
    return f" * ({' - '.join(ends)}) / h"


NOW: dict[Law, Callable[[Signal], str]] = {
    "constant": lambda law: "",
    "ramp": lambda law: " * t",
    "sine": lambda law: f" * math.sin({law.angular_frequency!r} * t + {law.phase!r})",
    "step": lambda law: f" * (t >= {law.times[0]!r})",
    "pulse": lambda law: f" * ({law.times[0]!r} <= t < {law.times[1]!r})",
    "polynomial": _polynomial,
    "table": lambda law: f" * table({law.times}, {law.values}, t)",
}

MEANS: dict[Law, Callable[[Signal], str]] = {
    "step": lambda law: f" * {_after(law.times[0])}",
    "pulse": lambda law: f" * ({_after(law.times[0])} - {_after(law.times[1])})",
    "table": _over,
}
