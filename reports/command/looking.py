"""Measures the cases and engines that were named, for a command that shows the results."""

from collections.abc import Callable, Sequence
from concurrent.futures import Executor
from typing import TYPE_CHECKING

from ...cases.mistake import CaseError, Mistake
from ..show.console import tell

if TYPE_CHECKING:
    from ...cases.case import Case
    from ..batch.suite import Report


def looked_at(
    words: Sequence[str],
    names: Sequence[str] = (),
    settings: Sequence[str] = (),
    *,
    jobs: int | None = None,
    cached: bool = True,
    long: bool = False,
    causes: bool = False,
    executor: Executor | None = None,
    before: "Callable[[Sequence[Case]], None]" = lambda cases: None,
) -> "Report":
    """From the store what has not changed, and with progress what has to be run.

    causes: whether they are searched for; executor: what works instead of processes of our own;
    before: is told the cases before any work, and may raise.
    A file with mistakes is left out: `mistakes` of the report tells them. Raises CaseError where
    nothing is left.
    """
    from ..batch import suite
    from ..batch.cache import store
    from ..batch.request import requested
    from ..batch.selection import sound_cases
    from ..output import committed
    from ..show.cures import carried
    from ..show.progress import progress
    from ..system import pool
    from .done import finished

    known = committed.committed_causes() if causes and cached else None
    found, mistakes = sound_cases(words, long=long)
    wanted = requested(found, names, settings, mistakes=mistakes, named=bool(words), long=long)
    if wanted.mistakes:
        tell(left_out(wanted.mistakes))
    for warning in wanted.warnings:
        tell(warning)
    before(wanted.cases)
    used = store.usable() if cached else None
    with progress() as shown, finished(used is not None):
        report = suite.measure(
            wanted.cases,
            wanted.engines,
            jobs=jobs or pool.workers(),
            progress=shown,
            book=wanted.book,
            causes=causes,
            known=known,
            store=used,
            executor=executor,
        )
    if used is not None:
        used.trim()
    report.mistakes[:0] = wanted.mistakes
    if known and (told := carried(report.causes, known.causes)):
        tell(told)
    return report


def left_out(mistakes: Sequence[Mistake]) -> str:
    """Returns all mistakes in words, and how many files have some and are left out."""
    files = len({mistake.file for mistake in mistakes})
    what = "1 file has mistakes and is" if files == 1 else f"{files} files have mistakes and are"
    return f"{CaseError(mistakes)}\n{what} left out"
