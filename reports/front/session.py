"""The rows of a pytest session: each simulation once, however many workers the session has."""

from collections.abc import Sequence
from pathlib import Path

from ...cases.case import Case
from ...cases.mistake import CaseError
from ...cases.model_case import ModelCase
from ..runs.cache.store import Store, usable
from ..runs.models import Settings, own_engines, settings_of
from ..runs.processes import termination as ending
from ..runs.request import Request
from ..runs.selection import BOOK, choose_engines
from ..runs.suite import Report
from ..runs.task_results import Progress
from ..search.causes.explained import measure


def rows(
    cases: Sequence[Case],
    used: Sequence[str],
    settings: Sequence[str],
    shared: str | None,
    progress: Progress,
    *,
    cached: bool = True,
    models: Sequence[ModelCase] = (),
) -> Report:
    """Runs the cases on all cores, or takes them from the store: another worker of xdist asks for
    the same, waits, and finds it there. A mistake that solving finds costs its own file.

    used: `engine.setting`. settings: files of the user's own options. shared: a folder for the
    workers where the user has no store. cached: whether anything is taken from the user's store, or
    kept there. models: of the user's own, in all of their settings and those of the files.
    """
    if shared is not None:
        ending.with_parent()
    names = [name for name in used if not name.startswith(f"{BOOK}.")]
    engines = choose_engines(names, settings, spare=True) if names else []
    store = (usable() if cached else None) or (Store(Path(shared)) if shared else None)
    try:
        stepped = settings_of([*choose_engines([], []), *own_engines(settings)]) if models else None
        return measure(
            Request(
                cases,
                engines,
                len(names) < len(used),
                progress=progress,
                store=store,
                models=models,
                model_settings=stepped or Settings(),
            )
        )
    except CaseError as error:
        return Report(mistakes=error.mistakes)
