"""The equations of a case: as its hand-written system states them, with the book's numbers."""

import inspect
import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from ...cases.case import Case
from ...reference.systems import SYSTEMS
from ...reference.systems.stated import STATED
from .mathml import mathml

ORDER = (
    "accelerations", "closed_form", "T", "U", "V", "D", "Q4", "f", "f_a", "g", "guards", "rates",
    "reactions", "closed_events",
)  # fmt: skip
"""Which methods are told, the motion's own first."""
NUMBERS = re.compile(r"((?:\(2\.\d+\)(?:, |–| and )?)+) ?(.*)", re.DOTALL)
SHAPE = re.compile(r",? \((?:\w+, ?)+\w*\)(?=[.:]?$)")
UNIT = re.compile(r" \[((?:rad|kg|[NmsJW])\b[^\]]*)\]")
STATES = re.compile(r"[=≤≥<>]")
PROSE = re.compile(r"(?:[A-Za-z’']{3,}[ ,.;:]*){3}")  # three words in a row


@dataclass(frozen=True)
class Equation:
    """A statement with the book's numbers: `html` its MathML, or nothing where it is prose."""

    numbers: str
    html: str
    text: str
    unit: str
    what: str


def equations(case: Case) -> list[Equation]:
    """Of its hand-written system; none where the mechanism is generated from the scene."""
    system = (SYSTEMS | STATED).get(case.system or "")
    if system is None:
        return []
    told = (getattr(system, name, None) for name in ORDER)
    found = [one for method in told if inspect.isfunction(method) for one in _stated(method)]
    return list({(one.numbers, one.text): one for one in found}.values())


def _stated(method: Any) -> Iterator[Equation]:
    """What its docstring opens with, and of the motion's own equation the lines that follow."""
    lines = [line.strip() for line in (inspect.getdoc(method) or "").splitlines()]
    found = NUMBERS.match(lines[0]) if lines else None
    if found is None:
        return
    numbers, opening = found[1].strip(), found[2]
    yield _equation(numbers, opening, method.__name__)
    if method.__name__ == ORDER[0]:
        for line in lines[1:]:
            if STATES.search(line) and not PROSE.search(line):
                yield _equation("", line, method.__name__)


def _equation(numbers: str, line: str, what: str) -> Equation:
    line = SHAPE.sub("", line.rstrip(".:"))
    unit = UNIT.search(line)
    text = UNIT.sub("", line).rstrip(".,: ")
    is_equation = STATES.search(text) and not PROSE.search(text)
    html = mathml(text) if is_equation else ""
    return Equation(numbers, html, text, unit[1] if unit else "", what)
