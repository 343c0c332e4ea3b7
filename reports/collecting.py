"""What pytest collects of a case file: its cases, and in which ways each engine runs them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .. import engines as installed
from ..cases.case import Case
from ..cases.load import load
from ..cases.mistake import CaseError
from ..engines.engine import Engine, Plan, Refusal, Start
from .coverage import countable
from .pool import Died, local, spread
from .selection import ENGINES, HANDWRITTEN, choose_book, choose_engines
from .show.progress import aloud
from .trial.book import producers
from .trial.start import assembled
from .trial.states import ways_of
from .trial.trial import judged_names
from .trial.work import too_long

Key = tuple[str, str, str, str, str]
"""Case, engine, setting, realisation, quantity."""


@dataclass(frozen=True)
class _Asked:
    engine: Engine
    case: Case
    start: Start

    @property
    def name(self) -> str:
        return f"{self.case.name} in {self.engine.name}.{self.engine.setting}"


def collected(
    path: Path,
    names: Sequence[str],
    wanted: Sequence[str],
    *,
    long: bool,
    write: Callable[[str], Any],
) -> list[tuple[Case, list[Key]]]:
    """The wanted cases of a file, or all, each with the rows of the named engines, or of all.

    write: takes a line where it takes long. Raises CaseError.
    """
    with aloud(write):
        countable()
        cases = load(path, systems=HANDWRITTEN, engines=ENGINES, long=long)
        engines = choose_engines(names, [])
        cases = [case for case in cases if not wanted or {case.name, path.stem} & {*wanted}]
        if mistakes := too_long(cases, engines):
            raise CaseError(mistakes)
        book = choose_book(names, [])
        return [(case, [*_keys(case, producers(case, engines, book=book))]) for case in cases]


def _keys(case: Case, engines: Sequence[Engine]) -> Iterator[Key]:
    start = assembled(case)
    for engine in engines:
        asked = _Asked(engine, case, start)
        for way in _apart(asked) if installed.foreign(engine.name) else _ways(asked):
            audit = () if isinstance(way, Refusal) else ("audit",)
            for quantity in (*audit, *judged_names(case)):
                yield case.name, engine.name, engine.setting, way.realised, quantity


def _ways(asked: _Asked) -> tuple[Plan | Refusal, ...]:
    return ways_of(asked.engine, asked.case, asked.start)


def _apart(asked: _Asked) -> tuple[Plan | Refusal, ...]:
    """In a process of their own: what somebody else's engine does is not this session's end."""
    with local(1) as executor:
        ((_, found),) = spread(_ways, [asked], executor)
    return (Refusal("native", found.because),) if isinstance(found, Died) else found
