"""Measures the cases and engines that were named, for a command that shows the results."""

from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING

from ....cases.mistake import CaseError, Mistake
from ..show.console import tell

if TYPE_CHECKING:
    from ....cases.case import Case
    from ...runs.request import Request
    from ...runs.suite import Report


def named(
    words: Sequence[str], names: Sequence[str], settings: Sequence[str] = (), *, long: bool = False
) -> "Request":
    """Returns what the words of a command ask for, and tells what is wrong with them.

    A file with mistakes is left out: `mistakes` of the request tells them. Raises CaseError where
    nothing is left.
    """
    from ...runs.chosen_models import choose_models
    from ...runs.request import requested
    from ...runs.selection import sound_cases

    chosen = choose_models(words, long=long)
    others = chosen.others if words else words
    cases, mistakes = sound_cases(others, long=long) if others or not words else ([], [])
    tell_spaces(cases)
    request = requested(
        cases, names, settings, mistakes=[*chosen.mistakes, *mistakes], named=bool(words),
        long=long, models=chosen.cases,
    )  # fmt: skip
    if request.mistakes:
        tell(left_out(request.mistakes))
    for warning in request.warnings:
        tell(warning)
    return request


def tell_spaces(cases: "Sequence[Case]") -> None:
    """Tells how those cases are read that are Spaces of a user's own."""
    from ...runs.selection import names_function

    for case in cases:
        if names_function(case.source.file):
            tell(f"{case.source.file}: {case.title}")


def looked_at(request: "Request", *, causes: bool = False, cached: bool = True) -> "Report":
    """Returns its rows: from the store what has not changed, with progress what has to be run.

    causes: whether they are searched for. `mistakes` of the report are those of all files.
    """
    from ...runs.cache import store
    from ...search.causes import explained
    from ...tables import committed
    from ..show.cures import carried
    from ..show.progress import progress
    from .done import finished
    from .own_advice import cures

    known = committed.committed_causes() if causes and cached else None
    used = store.usable() if cached else None
    with progress() as shown, finished(used is not None):
        asked = replace(request, progress=shown, store=used)
        report = explained.measure(asked, search=causes, known=known)
        if causes:
            report.cures = cures(asked, report)
    if used is not None:
        used.trim()
    report.mistakes[:0] = request.mistakes
    if known and (summary := carried(report.causes, known.causes)):
        tell(summary)
    return report


def left_out(mistakes: Sequence[Mistake]) -> str:
    """Returns all mistakes in words, and how many files have some and are left out."""
    files = len({mistake.file for mistake in mistakes})
    what = "1 file has mistakes and is" if files == 1 else f"{files} files have mistakes and are"
    return f"{CaseError(mistakes)}\n{what} left out"
