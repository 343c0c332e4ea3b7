"""What a command measures in order to show it: the cases and engines that were named."""

from collections.abc import Sequence
from typing import TYPE_CHECKING

from ..show.say import tell

if TYPE_CHECKING:
    from ..suite import Report


def looked_at(
    words: Sequence[str],
    names: Sequence[str] = (),
    settings: Sequence[str] = (),
    *,
    jobs: int | None = None,
    cached: bool = True,
    long: bool = False,
) -> "Report":
    """From the store what has not changed, and with progress what has to be run.

    A file with mistakes is left out: `mistakes` of the report tells them. Raises CaseError where
    nothing is left.
    """
    from .. import pool, suite
    from ..asking import asked
    from ..cache import store
    from ..selection import sound_cases
    from ..show.progress import progress
    from .done import finished

    found, mistakes = sound_cases(words, long=long)
    wanted = asked(found, names, settings, mistakes=mistakes, named=bool(words), long=long)
    for warning in wanted.warnings:
        tell(warning)
    used = store.usable() if cached else None
    with progress() as shown, finished(used is not None):
        report = suite.measure(
            wanted.cases,
            wanted.engines,
            jobs=jobs or pool.workers(),
            progress=shown,
            book=wanted.book,
            store=used,
        )
    report.mistakes[:0] = wanted.mistakes
    return report
