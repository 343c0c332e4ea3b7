"""Checks the options of an engine that a user gives, and names each mistake with its place."""

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ..cases.mistake import did_you_mean
from .step_scaled import FORMS, tied

Check = Callable[[str, Any], Iterator[str]]
"""The mistakes in one option's value, each headed by where it stands: `mujoco.pair.solref`."""
_LARGEST = 1e300  # what engines take for infinite; and an int can exceed every float


def mistakes_in(known: Mapping[str, Check]) -> Check:
    """The mistakes in a map of options, among them unknown names with the nearest right one."""

    def mistakes(where: str, options: Any) -> Iterator[str]:
        if not isinstance(options, Mapping):
            yield f"{where}: should be a map of {', '.join(known)}, is {options!r}"
            return
        for name, value in options.items():
            if name in known:
                yield from known[name](f"{where}.{name}", value)
            else:
                hint = did_you_mean(str(name), [*known]) or f"known: {', '.join(known)}"
                yield f"{where}.{name}: unknown option; {hint}"

    return mistakes


def should_be(what: str, right: Callable[[Any], bool], words: Sequence[str] = ()) -> Check:
    """The check of a value that is right or wrong; words: of which the nearest is named."""

    def mistakes(where: str, value: Any) -> Iterator[str]:
        if not right(value):
            hint = did_you_mean(str(value), words)
            yield f"{where}: should be {what}, is {value!r}" + (f"; {hint}" if hint else "")

    return mistakes


def word(*words: str) -> Check:
    """One of some words."""
    return should_be(f"one of {', '.join(words)}", lambda value: value in words, words)


def number(
    least: float = 0, largest: float = _LARGEST, *, whole: Any = None, otherwise: str = ""
) -> Check:
    """A number within bounds; whole: the types as which a whole one may stand in the file.

    otherwise: a word that may stand instead.
    """
    to = f" to {largest:.10g}" if largest < _LARGEST else " on"
    what = f"a {'whole ' if whole else ''}number from {least:g}{to}"

    def right(value: Any) -> bool:
        if otherwise and value == otherwise:
            return True
        within = is_number(value) and least <= value <= largest
        return within and (not whole or (isinstance(value, whole) and value == int(value)))

    return should_be(what + (f", or {otherwise}" if otherwise else ""), right)


def numbers(*counts: int, follow: bool = False) -> Check:
    """A list of so many finite numbers; follow: of such that may follow the step."""
    what = f"a list of {' or '.join(map(str, counts))} finite numbers"

    def right(value: Any) -> bool:
        listed = isinstance(value, list | tuple) and len(value) in counts
        return listed and all(
            (is_number(x) and abs(x) <= _LARGEST) or (follow and tied(x)) for x in value
        )

    return should_be(what + (f", or texts {FORMS}" if follow else ""), right)


def is_number(value: Any) -> bool:
    """Whether it is a number, and not the truth value that Python counts as one."""
    return isinstance(value, int | float) and not isinstance(value, bool)


SWITCH = should_be("true or false", lambda value: isinstance(value, bool))
STEP = should_be(
    "a positive number of seconds", lambda value: is_number(value) and 0 < value <= _LARGEST
)
