"""The rows of a pytest session: each simulation once, however many workers the session has."""

from collections.abc import Sequence
from pathlib import Path

from ...cases.case import Case
from ...cases.mistake import CaseError
from ..system import pool
from ..system import termination as ending
from . import suite
from .cache.store import Store, usable
from .selection import BOOK, choose_engines
from .task_results import Progress


def rows(
    cases: Sequence[Case],
    used: Sequence[str],
    settings: Sequence[str],
    shared: str | None,
    progress: Progress,
    *,
    cached: bool = True,
) -> suite.Report:
    """Runs the cases on all cores, or takes them from the store: another worker of xdist asks for
    the same, waits, and finds it there. A mistake that solving finds costs its own file.

    used: `engine.setting`. settings: files of the user's own options. shared: a folder for the
    workers where the user has no store. cached: whether anything is taken from the user's store, or
    kept there.
    """
    if shared is not None:
        ending.with_parent()
    names = [name for name in used if not name.startswith(f"{BOOK}.")]
    engines = choose_engines(names, settings, spare=True) if names else []
    try:
        return suite.measure(
            cases,
            engines,
            jobs=pool.workers(),
            progress=progress,
            book=len(names) < len(used),
            store=(usable() if cached else None) or (Store(Path(shared)) if shared else None),
        )
    except CaseError as error:
        return suite.Report(mistakes=error.mistakes)
