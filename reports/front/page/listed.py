"""The list of cases, file by file: what the variants of one share is told once."""

import inspect
import re
import unicodedata
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from html import escape
from itertools import groupby
from typing import Any

from ....cases.case import Case
from ....cases.theme import THEMES
from ....reference.systems import SYSTEMS
from ...tables.row import REFUSED
from .column import Column
from .heat import Cell


def listed(
    cases: Sequence[Case],
    shown: Sequence[Column],
    cells: Mapping[Any, Cell],
    about: Mapping[str, tuple[str, ...]],
) -> list[dict[str, Any]]:
    """The cases of each file together: they share title and equations."""
    out = []
    for name, group in groupby(cases, key=lambda case: case.name.partition(".")[0]):
        variants = list(group)
        first = variants[0]
        out.append(
            {
                "name": name,
                "title": first.title,
                "source": str(first.origin),
                "system": first.system,
                "themes": [t for t in THEMES if any(t in about[case.name] for case in variants)],
                "equations": equations(first),
                "cases": [
                    {
                        "name": case.name,
                        "variant": case.name.partition(".")[2] or case.name,
                        "cells": chips(case.name, shown, cells),
                    }
                    for case in variants
                ],
            }
        )
    return out


def chips(
    name: str, shown: Sequence[Column], all_cells: Mapping[Any, Cell]
) -> list[tuple[Column, Cell]]:
    """Returns the columns in which a case or a model ran, with its result in each."""
    cells = [(column, all_cells.get((name, column))) for column in shown]
    return [(column, cell) for column, cell in cells if cell and cell.kind != REFUSED]


# The equations of a case: as its hand-written system states them, with the book's numbers.


ORDER = (
    "accelerations", "closed_form", "T", "U", "V", "D", "Q4", "f", "f_a", "g", "guards", "rates",
    "reactions", "closed_events",
)  # fmt: skip
"""Which methods are told, the motion's own first."""
NUMBERS = re.compile(r"((?:\(2\.\d+\)(?:, |–| and )?)+) ?(.*)", re.DOTALL)
SHAPE = re.compile(r",? \((?:\w+, ?)+\w*\)(?=[.:]?$)")
UNIT = re.compile(r" \[((?:rad|kg|[NmsJW]|1/s)(?![A-Za-z])[^\]]*)\]")
STATES = re.compile(r"[=≤≥<>]")
TAIL = re.compile(r"[,:;] (?=(?:[A-Za-z’']{2,} ){2})")  # where words begin that go on
PROSE = re.compile(r"(?:[A-Za-z’']{3,}[ ,.;:]*){3}")  # three words in a row


@dataclass(frozen=True)
class Equation:
    """A statement with the book's numbers: its MathML, and the words and the unit behind it."""

    numbers: str
    html: str
    words: str
    unit: str


def equations(case: Case) -> list[Equation]:
    """Returns the equations of a case's hand-written system.

    There are none where the mechanism is generated from the scene.
    """
    if case.system is None or case.system not in SYSTEMS:  # generated, or a claim about states
        return []
    system: Any = SYSTEMS[case.system](**case.parameters)
    modes = dict.fromkeys(type(mode) for mode in getattr(system, "modes", {}).values())
    every = [equation for kind in (type(system), *modes) for equation in _equations_of(kind)]
    return list({(equation.numbers, equation.html): equation for equation in every}.values())


def _equations_of(system: type) -> list[Equation]:
    methods = (getattr(system, name, None) for name in ORDER)
    return [e for method in methods if inspect.isfunction(method) for e in _stated(method)]


def _stated(method: Any) -> Iterator[Equation]:
    """Yields the equation that opens a method's docstring.

    For the motion's own equation, the equations in the lines below come after it.
    """
    lines = [line.strip() for line in (inspect.getdoc(method) or "").splitlines()]
    match = NUMBERS.match(lines[0]) if lines else None
    if match is None:
        return
    more = [("", line) for line in lines[1:]] if method.__name__ == ORDER[0] else []
    for numbers, line in [(match[1].strip(), match[2]), *more]:
        equation = _equation(numbers, line)
        if equation is not None:
            yield equation


def _equation(numbers: str, line: str) -> Equation | None:
    """Returns the equation that a line states, or None."""
    line = SHAPE.sub("", line.rstrip(".:")).replace("`", "")
    unit = UNIT.search(line)
    text = UNIT.sub("", line).rstrip(".,: ")
    tail = TAIL.search(text)
    stated, words = (text[: tail.start()], text[tail.start() :]) if tail else (text, "")
    if not STATES.search(stated) or PROSE.search(stated):
        return None
    return Equation(numbers, mathml(stated), words, unit[1] if unit else "")


# A line of a docstring as MathML: `J_O φ̈ = −m g (l/2) cos φ [rad/s²], (1,).`
#
# Letters become identifiers, with their dots, primes, indices and exponents; what is a word stays
# text. Nothing is understood, only set: an unknown sign is an operator.


FUNCTIONS = frozenset(
    ("sin", "cos", "tan", "cot", "arccos", "arcsin", "arctan", "atan", "sinh", "cosh", "tanh",
     "exp", "log", "ln", "sqrt", "arg", "sign", "max", "min", "sn", "cn", "dn", "cd", "det",
     "Re", "Im")
)  # fmt: skip
SUBSCRIPTS = {
    ord(a): b for a, b in zip("₀₁₂₃₄₅₆₇₈₉₊₋ᵢⱼₖₐᵦᵣₓₛₜₙ", "0123456789+−ijkaβrxstn", strict=True)
}
SUPERSCRIPTS = {ord(a): b for a, b in zip("⁰¹²³⁴⁵⁶⁷⁸⁹⁺⁻ᵀᵃᵇⁿᵗⁱ", "0123456789+−Tabnti", strict=True)}
MARKS = "\u0307\u0308\u0303\u0304\u0302"  # dots, tilde, bar, hat

LOW = "".join(map(chr, SUBSCRIPTS))
HIGH = "".join(map(chr, SUPERSCRIPTS))
BASE = rf"(?:[^\W\d_{LOW}{HIGH}])"
WORD = r"[A-Za-z]{2,}+"  # the whole of it, or none
TOKEN = re.compile(
    rf"(?P<word>(?:{'|'.join(sorted(FUNCTIONS))})(?![A-Za-z])|{WORD}(?![{MARKS}_{LOW}]))"
    rf"|(?P<name>{BASE}[{MARKS}]*)"
    r"|(?P<number>\d+(?:\.\d+)?)"
    r"|(?P<space>\s+)"
    r"|(?P<sign>.)"
)
AFTER = re.compile(
    rf"(?P<primes>[′']*)(?:(?P<low>[{LOW}]+)|_(?:\{{(?P<braced>[^}}]*)\}}|(?P<one>(?:(?![{HIGH}])\w)+)))?"
    rf"(?P<more>[′']*)(?P<high>[{HIGH}]*)(?:\^(?:\{{(?P<over>[^}}]*)\}}|(?P<up>−?(?:\d+|\w))))?"
)
CLOSING = ")]}|∞"
FENCES = "()[]{}|"
SPACE = '<mspace width="0.4em"/>'
APPLIED = '<mo>&#x2061;</mo><mspace width="0.17em"/>'


def mathml(line: str) -> str:
    """One `<math>` element; all that was markup in the line is escaped."""
    return f'<math display="inline">{_row(unicodedata.normalize("NFD", line))}</math>'


def _row(text: str) -> str:
    out: list[str] = []
    place = 0
    while place < len(text):
        token = TOKEN.match(text, place)
        if token is None:
            break
        place = token.end()
        element = _element(token)
        if element and (token["name"] or token["number"] or token[0] in CLOSING or _named(token)):
            after = AFTER.match(text, place)
            if after and after[0]:
                element, place = _scripted(element, after), after.end()
        out.append(element)
    return "".join(out)


def _named(token: re.Match[str]) -> bool:
    return token["word"] in FUNCTIONS


def _element(token: re.Match[str]) -> str:
    text = token[0]
    if token["space"]:
        return ""
    if token["word"]:
        if text in FUNCTIONS:
            return f'<mi mathvariant="normal">{text}</mi>{APPLIED}'
        return f"<mtext>&#xA0;{escape(text)}&#xA0;</mtext>"
    if token["number"]:
        return f"<mn>{text}</mn>"
    if token["name"]:
        letter = escape(unicodedata.normalize("NFC", text))
        # As one letter with its dots: as an accent beside it they are lost where no font for
        # mathematics is installed. Such a letter is not slanted by itself.
        return f"<mi>{letter}</mi>" if len(text) == 1 else f'<mi class="dotted">{letter}</mi>'
    stretchy = ' stretchy="false"' if text in FENCES else ""
    return f"<mo{stretchy}>{escape(text)}</mo>{SPACE if text in ',;' else ''}"


def _scripted(element: str, after: re.Match[str]) -> str:
    """The element with what stands below and above it."""
    low = (after["low"] or "").translate(SUBSCRIPTS) or after["braced"] or after["one"] or ""
    high = (after["high"] or "").translate(SUPERSCRIPTS) or after["over"] or after["up"] or ""
    primes = len(after["primes"] + after["more"]) * "′"
    above = (f"<mo>{primes}</mo>" if primes else "") + (_row(high) if high else "")
    below = f"<mrow>{_row(low)}</mrow>" if low else ""
    base, tail = _split(element)
    if below and above:
        return f"<msubsup>{base}{below}<mrow>{above}</mrow></msubsup>{tail}"
    if below:
        return f"<msub>{base}{below}</msub>{tail}"
    return f"<msup>{base}<mrow>{above}</mrow></msup>{tail}" if above else element


def _split(element: str) -> tuple[str, str]:
    """Splits a function's name from its argument."""
    name = element.removesuffix(APPLIED)
    return (name, APPLIED) if name != element else (element, "")
