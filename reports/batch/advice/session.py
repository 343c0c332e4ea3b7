"""A search from the words of a command: its processes, its store, and all cases at once."""

from collections.abc import Iterator, Sequence
from concurrent.futures import Executor
from contextlib import contextmanager, nullcontext

from ....cases.case import Case
from ....engines.engine import Engine
from ...system.pool import local, workers
from ..cache.key import Keys
from ..cache.store import Store, passing
from ..task_results import Progress, Results
from ..tasks import Pair
from .advice_rows import Advised, Asked
from .advise import advise


@contextmanager
def advised(
    cases: Sequence[Case],
    engines: Sequence[Engine],
    asked: Asked,
    *,
    progress: Progress,
    jobs: int | None = None,
    store: Store | None = None,
    executor: Executor | None = None,
) -> Iterator[list[Advised]]:
    """Yields the advice for each case in each engine as shipped; references stay until the end.

    jobs, store and executor as of `suite.measure`. Raises CaseError for what only solving finds.
    """
    keys = Keys.now(store)
    with (
        nullcontext(store) if store else passing() as used,
        nullcontext(executor) if executor else local(jobs or workers()) as working,
    ):
        results = Results(working, progress, used, keys)
        pairs = [Pair(case, e, used, keys.solution(case)) for case in cases for e in engines]
        yield advise(pairs, asked, results)
