"""Collects for pytest the cases of a case file, and in which ways each engine runs them."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from functools import cache, partial
from pathlib import Path
from typing import Any

from ... import engines as installed
from ...cases.case import Case
from ...cases.load import load
from ...cases.load_model import load_model
from ...cases.mistake import CaseError
from ...cases.model_case import ModelCase
from ...engines.engine import Engine, Plan, Start
from ...engines.probe import apart
from ..compare.trial.book import producers
from ..compare.trial.limit import limit
from ..compare.trial.start import assembled
from ..compare.trial.states import ways_of
from ..compare.trial.trial import judged_names
from ..compare.trial.work import too_long
from ..runs.cache.key import Keys
from ..runs.cache.store import Store
from ..runs.models import ENGINE as MODEL_ENGINE
from ..runs.models import Settings, own_engines, row_names, settings_of
from ..runs.selection import ENGINES, HANDWRITTEN, choose_book, choose_engines, nameable
from ..tables.coverage import countable
from .show.progress import aloud

Key = tuple[str, str, str, str, str]
"""Case, engine, setting, realisation, quantity."""

Ways = tuple[tuple[str, bool], ...]
"""How an engine runs a case: in which realisations, and whether it does or refuses."""


@dataclass(frozen=True)
class Earlier:
    """The engines' answers to earlier sessions, in a store; without one each is asked anew."""

    store: Store | None
    keys: Keys
    new: dict[str, Ways] = field(default_factory=dict)

    @staticmethod
    def of(store: Store | None) -> "Earlier":
        """Returns the answers in a store, for the code and the engines as they are now."""
        return Earlier(store, Keys.now(store))

    def ways(self, case: Case, engine: Engine, start: Callable[[], Start]) -> Ways:
        """Returns how the engine runs the case; `start` is called where nobody has asked before."""
        key = self.keys.collected(case, engine) if self.store else ""
        kept = self.store.get(key) if self.store else None
        if kept is not None:
            return kept
        if installed.foreign(engine.name):  # what it does is not this session's end
            answer, why = apart(ways_of, engine, case, start(), most=limit())
            if why:  # it may not do so again
                return (("native", False),)
        else:
            answer = ways_of(engine, case, start())
        self.new[key] = tuple((way.realised, isinstance(way, Plan)) for way in answer)
        return self.new[key]

    def keep(self) -> None:
        """Puts the answers of this session into the store, for the next one."""
        if self.store and self.new and self.keys.hold():
            for key, ways in self.new.items():
                self.store.put(key, ways)
        self.new.clear()


def collected(
    path: Path,
    names: Sequence[str],
    settings: Sequence[str],
    wanted: Sequence[str],
    earlier: Callable[[], Earlier],
    *,
    long: bool,
    spare: bool = False,
    write: Callable[[str], Any],
) -> list[tuple[Case, list[Key]]]:
    """The wanted cases of a file, or all, each with the rows of the named engines, or of all.

    settings: files of the user's own options, further columns; spare: also of other engines.
    earlier: called only for a file without mistakes.
    write: takes a line where it takes long. Raises CaseError.
    """
    with aloud(write):
        countable()
        nameable(str(path))
        cases = load(path, systems=HANDWRITTEN, engines=ENGINES, long=long)
        engines = choose_engines(names, settings, spare=spare)
        cases = [case for case in cases if not wanted or {case.name, path.stem} & {*wanted}]
        if mistakes := too_long(cases, engines):
            raise CaseError(mistakes)
        book = choose_book(names, [])
        asked = earlier()
        rows = [[*_keys(case, producers(case, engines, book=book), asked)] for case in cases]
        asked.keep()
        return list(zip(cases, rows, strict=True))


def collected_models(
    path: Path, names: Sequence[str], settings: Sequence[str], wanted: Sequence[str], *, long: bool
) -> list[tuple[ModelCase, list[Key]]]:
    """Returns the wanted cases of a file with a model, each with its rows; none without MuJoCo.

    Each is compiled in a process of its own. Raises CaseError.
    """
    nameable(str(path))
    cases = [
        case
        for case in load_model(path, long=long)
        if not wanted or {case.name, path.stem} & {*wanted}
    ]
    if names and not any(name.partition(".")[0] == MODEL_ENGINE for name in names):
        return []
    beside = settings_of([*choose_engines([], []), *own_engines(settings)]) or Settings()
    rows: list[list[Key]] = []
    for case in cases:
        answer, why = apart(row_names, case, beside, most=limit())
        if isinstance(answer, CaseError):
            raise answer
        if why:
            raise CaseError([case.mistake(("model",), f"cannot be compiled: {why}")])
        rows.append(
            [(case.name, MODEL_ENGINE, way, "native", quantity) for way, quantity in answer]
        )
    return list(zip(cases, rows, strict=True))


def _keys(case: Case, engines: Sequence[Engine], earlier: Earlier) -> Iterator[Key]:
    start = cache(partial(assembled, case))
    for engine in engines:
        for realised, runs in earlier.ways(case, engine, start):
            audit = ("audit",) if runs else ()
            for quantity in (*audit, *judged_names(case)):
                yield case.name, engine.name, engine.setting, realised, quantity
