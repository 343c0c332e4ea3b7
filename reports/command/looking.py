"""What a command measures in order to show it: the cases and engines that were named."""

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

from ...cases.mistake import CaseError
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
    from ..cache import store
    from ..selection import choose_book, choose_engines, sound, sound_cases
    from ..show.progress import progress
    from ..trial.work import too_long
    from .done import finished

    found, mistakes = sound_cases(words, long=long)
    with warnings.catch_warnings(record=True) as broken:
        engines = choose_engines(names, settings, long=long)
    for warning in broken:
        tell(f"warning: {warning.message}")
    mistakes += too_long(found, engines)
    chosen = sound(found, mistakes)
    if not chosen:
        raise CaseError(mistakes)
    used = store.usable() if cached else None
    with progress() as shown, finished(used is not None):
        report = suite.measure(
            chosen,
            engines,
            jobs=jobs or pool.workers(),
            progress=shown,
            book=choose_book(names, settings),
            store=used,
        )
    report.mistakes[:0] = mistakes
    return report
