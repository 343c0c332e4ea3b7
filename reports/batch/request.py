"""Says what a run is asked to do: which cases, in which engines, and what is wrong with that."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...engines.engine import Engine
from ..compare.trial.book import producers
from ..compare.trial.work import too_long
from .selection import choose_book, choose_engines, sound


@dataclass(frozen=True)
class Request:
    """Sound cases and the engines for them.

    book: whether the book's own approximations stand beside the engines. mistakes: of the files
    that are left out. warnings: what else a person should know before it begins.
    """

    cases: Sequence[Case]
    engines: Sequence[Engine]
    book: bool
    mistakes: Sequence[Mistake]
    warnings: Sequence[str]


def requested(
    found: Sequence[Case],
    names: Sequence[str],
    settings: Sequence[str],
    *,
    own: Sequence[Engine] = (),
    mistakes: Sequence[Mistake] = (),
    named: bool = True,
    long: bool = False,
) -> Request:
    """The cases that were found, in engines × settings by name (all for none).

    own: further engines, with a user's own options. mistakes: of files that were not found sound.
    named: whether a person named the cases, and should know which of them nobody answers.
    Raises CaseError where nothing is left to do.
    """
    with warnings.catch_warnings(record=True) as broken:
        engines = [*choose_engines(names, settings, long=long), *own]
    mistakes = [*mistakes, *too_long(found, engines)]
    cases = sound(found, mistakes)
    if not cases:
        raise CaseError(mistakes)
    book = choose_book(names, settings)
    silent = _silent(cases, engines, book=book)
    told = [f"warning: {warning.message}" for warning in broken]
    told += [silent] if silent and named else []
    return Request(cases, engines, book, mistakes, told)


def _silent(cases: Sequence[Case], engines: Sequence[Engine], *, book: bool) -> str:
    """Which of the cases nobody answers. Raises CaseError if none is left."""
    silent = [case.name for case in cases if not producers(case, engines, book=book)]
    if not silent:
        return ""
    why = "the book approximates dry friction alone, in Examples 2.3 and 2.4"
    what = f"no row for {', '.join(silent)}: {why}"
    if len(silent) == len(cases):
        raise CaseError([Mistake("--engine", 0, 0, "", what)])
    return what
