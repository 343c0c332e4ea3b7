"""Says what a run is asked to do, and with what: cases, engines, processes, a store."""

import warnings
from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext
from dataclasses import dataclass, field

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from ...cases.model_case import ModelCase
from ...engines.engine import Engine
from ..compare.trial.book import producers
from ..compare.trial.work import too_long
from .cache.key import Keys
from .cache.store import Store, temporary_store
from .models import Settings, settings_of
from .processes.pool import local, workers
from .selection import choose_book, choose_engines, sound
from .task_results import Progress, Results, silent


@dataclass(frozen=True)
class Request:
    """Sound cases, the engines for them, and what does the work.

    book: whether the book's own approximations stand beside the engines. mistakes: of the files
    that are left out. warnings: what else a person should know before it begins. jobs: processes of
    this machine, by default as many as cores. store: where results are kept as they come, and taken
    from if nothing that they depend on has changed; None: nowhere. executor: any of
    `concurrent.futures`, a cluster's for instance, in place of the processes. models: of the user's
    own, in these settings.
    """

    cases: Sequence[Case]
    engines: Sequence[Engine]
    book: bool = True
    mistakes: Sequence[Mistake] = ()
    warnings: Sequence[str] = ()
    jobs: int | None = None
    progress: Progress = silent
    store: Store | None = None
    executor: Executor | None = None
    models: Sequence[ModelCase] = ()
    model_settings: Settings = field(default_factory=Settings)

    @contextmanager
    def results(self, most: int | None = None) -> Iterator[Results]:
        """Yields the results of tasks; most: how many processes have anything to do."""
        jobs = self.jobs or workers()
        with (
            nullcontext(self.store) if self.store else temporary_store() as store,
            nullcontext(self.executor) if self.executor else local(min(jobs, most or jobs)) as used,
        ):
            yield Results(used, self.progress, store, Keys.now(self.store))


def requested(
    chosen: Sequence[Case],
    names: Sequence[str],
    settings: Sequence[str],
    *,
    own: Sequence[Engine] = (),
    mistakes: Sequence[Mistake] = (),
    named: bool = True,
    long: bool = False,
    models: Sequence[ModelCase] = (),
) -> Request:
    """Returns the request to run cases in engines × settings by name (all for none).

    own: further engines, with a user's own options. mistakes: of files that were not found sound.
    named: whether a person named the cases, and should know which of them nobody answers. models:
    of the user's own, which MuJoCo alone reads. Raises CaseError where nothing is left to do.
    """
    with warnings.catch_warnings(record=True) as broken:
        engines = [*choose_engines(names, settings, long=long), *own]
    mistakes = [*mistakes, *too_long(chosen, engines)]
    cases = sound(chosen, mistakes)
    stepped = settings_of(engines) if models else None
    if models and not stepped:
        mistakes += [Mistake(model.file, 0, 0, "", NO_ENGINE) for model in models]
    models = models if stepped else ()
    names_of_cases = {case.name for case in cases}
    mistakes += [
        Mistake(model.file, 0, 0, "", f"a case beside it has the name {model.name!r}: rename one")
        for model in models
        if model.name in names_of_cases
    ]
    if not (cases or models):
        raise CaseError(mistakes)
    book = choose_book(names, settings)
    silent = _silent(cases, engines, book=book) if cases else ""
    remarks = [f"warning: {warning.message}" for warning in broken]
    remarks += [silent] if silent and named else []
    return Request(
        cases, engines, book, mistakes, remarks, models=models, model_settings=stepped or Settings()
    )


NO_ENGINE = "is a model, which MuJoCo alone reads: name it among the engines, or none"


def _silent(cases: Sequence[Case], engines: Sequence[Engine], *, book: bool) -> str:
    """Names the cases that no engine answers. Raises CaseError if none is left."""
    silent = [case.name for case in cases if not producers(case, engines, book=book)]
    if not silent:
        return ""
    why = "the book approximates dry friction alone, in Examples 2.3 and 2.4"
    what = f"no row for {', '.join(silent)}: {why}"
    if len(silent) == len(cases):
        raise CaseError([Mistake("--engine", 0, 0, "", what)])
    return what
