"""The list of cases, file by file: what the variants of one share is told once."""

import inspect
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import Any

from ...cases.case import Case
from ...cases.theme import THEMES
from ...reference.systems import SYSTEMS
from ..data.row import REFUSED
from .column import Column
from .heat import Cell
from .mathml import mathml


def listed(
    cases: Sequence[Case],
    shown: Sequence[Column],
    found: Mapping[Any, Cell],
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
                        "cells": [
                            (one, cell)
                            for one in shown
                            if (cell := found.get((case.name, one))) and cell.kind != REFUSED
                        ],
                    }
                    for case in variants
                ],
            }
        )
    return out


# The equations of a case: as its hand-written system states them, with the book's numbers.


ORDER = (
    "accelerations", "closed_form", "T", "U", "V", "D", "Q4", "f", "f_a", "g", "guards", "rates",
    "reactions", "closed_events",
)  # fmt: skip
"""Which methods are told, the motion's own first."""
NUMBERS = re.compile(r"((?:\(2\.\d+\)(?:, |–| and )?)+) ?(.*)", re.DOTALL)
SHAPE = re.compile(r",? \((?:\w+, ?)+\w*\)(?=[.:]?$)")
UNIT = re.compile(r" \[((?:rad|kg|[NmsJW])\b[^\]]*)\]")
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
    found = [one for kind in (type(system), *modes) for one in _of(kind)]
    return list({(one.numbers, one.html): one for one in found}.values())


def _of(system: type) -> list[Equation]:
    told = (getattr(system, name, None) for name in ORDER)
    return [one for method in told if inspect.isfunction(method) for one in _stated(method)]


def _stated(method: Any) -> Iterator[Equation]:
    """Yields the equation that opens a method's docstring.

    For the motion's own equation, the equations in the lines below come after it.
    """
    lines = [line.strip() for line in (inspect.getdoc(method) or "").splitlines()]
    found = NUMBERS.match(lines[0]) if lines else None
    if found is None:
        return
    more = [("", line) for line in lines[1:]] if method.__name__ == ORDER[0] else []
    for numbers, line in [(found[1].strip(), found[2]), *more]:
        equation = _equation(numbers, line)
        if equation is not None:
            yield equation


def _equation(numbers: str, line: str) -> Equation | None:
    """None of a line that states none."""
    line = SHAPE.sub("", line.rstrip(".:")).replace("`", "")
    unit = UNIT.search(line)
    text = UNIT.sub("", line).rstrip(".,: ")
    tail = TAIL.search(text)
    stated, words = (text[: tail.start()], text[tail.start() :]) if tail else (text, "")
    if not STATES.search(stated) or PROSE.search(stated):
        return None
    return Equation(numbers, mathml(stated), words, unit[1] if unit else "")
