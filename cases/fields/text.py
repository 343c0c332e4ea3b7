"""The kinds of text a case file is made of: names, references, numbers of equations, choices."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..mistake import invisible, nearest, plain
from .field import Plain
from .kind import RESERVED
from .number import Names, shown
from .words import wrong

IDENTIFIER = "[A-Za-z_][A-Za-z0-9_]*"


@dataclass(frozen=True)
class Text(Plain):
    """Text that is not empty; `rule` says what else is wrong with it, or nothing."""

    rule: Callable[[str], str | None] = lambda _: None
    pattern: str | None = None
    description: str | None = None

    def check(self, value: object, known: Names) -> str:
        if not isinstance(value, str) or not value.strip():
            empty = isinstance(value, str)
            raise wrong("should not be empty" if empty else f"should be text, is {shown(value)}")
        value = value.rstrip("\n")  # what a block of YAML ends with
        if (hidden := invisible(value)) is not None:
            raise wrong(f"should be one line of text, has the character {plain(hidden)}")
        if what := self.rule(value):
            raise wrong(what)
        return value

    def schema(self) -> dict[str, Any]:
        extra = {"pattern": self.pattern, "description": self.description}
        return {"type": "string", **{k: v for k, v in extra.items() if v is not None}}


@dataclass(frozen=True)
class Place(Text):
    """A number of a place in the book: text, because 2.10 as a number is 2.1."""

    def check(self, value: object, known: Names) -> str:
        if isinstance(value, int | float) and not isinstance(value, bool):
            raise wrong('should be text in quotes, as "2.10": as a number it would be 2.1')
        return super().check(value, known)


@dataclass(frozen=True)
class Word(Plain):
    """One of a few words."""

    kind: str
    words: tuple[str, ...]

    def check(self, value: object, known: Names) -> str:
        if isinstance(value, str) and value in self.words:
            return value
        if not isinstance(value, str):
            raise wrong(f"should be {' or '.join(self.words)}, is {shown(value)}")
        raise wrong(f"unknown {self.kind} {value!r}{nearest(value, self.words)}")

    def schema(self) -> dict[str, Any]:
        return {"enum": list(self.words)}


def label(word: str) -> str | None:
    """The mistake in the name of a parameter, in words; None if it is sound."""
    if not re.fullmatch(IDENTIFIER, word):
        return f"{word!r} is not a name: ASCII letters, digits and _, not starting with a digit"
    return "the name 'unknown' is taken" if word == "unknown" else None


def name(word: str) -> str | None:
    """The mistake in the name of a part, in words; None if it is sound."""
    return f"the name {word!r} is taken" if word in RESERVED else label(word)


def equation(number: str) -> str | None:
    """The mistake in the number of an equation, in words; None if the chapter has it."""
    if re.fullmatch(r"2\.([1-9]|[1-8][0-9]|9[0-8])", number):
        return None
    return f"no equation {number!r}: the chapter has 2.1 to 2.98"


def reference(word: str) -> str | None:
    """The mistake in the form of a reference to a point, in words; None if it is sound."""
    if re.fullmatch(rf"{IDENTIFIER}\.{IDENTIFIER}", word):
        return None
    return f"should be body.point or ground.point, is {word!r}"


def rate(word: str) -> str | None:
    """The mistake in the form of a reference to a rate, in words; None if it is sound."""
    if re.fullmatch(rf"{IDENTIFIER}\.{IDENTIFIER}", word):
        return None
    return f"should be joint.rate (`q1.omega`), is {word!r}"


TURN = rf"^{IDENTIFIER}(\.{IDENTIFIER})?$"


def turn(word: str) -> str | None:
    """The mistake in the form of a reference to a joint's turn, in words; None if it is sound."""
    if re.fullmatch(TURN, word):
        return None
    return f"should be a joint's name, or joint.turn (`arm.theta`), is {word!r}"


THREAD = r"^[A-Za-z0-9-]+/[A-Za-z0-9._-]+#[1-9][0-9]*$"


def thread_name(word: str) -> str | None:
    """The mistake in the name of a public thread, in words; None if it is sound."""
    if re.fullmatch(THREAD, word):
        return None
    return f"should be owner/repository#number, is {word!r}"


def no_formula(words: str) -> str | None:
    """The mistake in words that fill a cell of a report; None unless they begin as a formula."""
    if words[0] in "=+-@":
        return f"begins with {words[0]!r}, as a formula of a spreadsheet does"
    return None
