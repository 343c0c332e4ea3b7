"""The rows of a pytest session: each simulation once, however many workers the session has."""

from collections.abc import Sequence
from pathlib import Path

from ..cases.case import Case
from ..cases.mistake import CaseError
from . import pool, suite
from .cache.store import Store, usable
from .selection import BOOK, choose_engines


def rows(cases: Sequence[Case], used: Sequence[str], shared: str | None) -> suite.Report:
    """Runs the cases on all cores, or takes them from the store: another worker of xdist asks for
    the same, waits, and finds it there. A mistake that solving finds costs its own file.

    used: `engine.setting`. shared: a folder for the workers where the user has no store.
    """
    names = [name for name in used if not name.startswith(f"{BOOK}.")]
    engines = choose_engines(names, []) if names else []
    try:
        return suite.measure(
            cases,
            engines,
            jobs=pool.workers(),
            progress=lambda *_: None,
            book=len(names) < len(used),
            store=usable() or (Store(Path(shared)) if shared else None),
        )
    except CaseError as error:
        return suite.Report(mistakes=error.mistakes)
