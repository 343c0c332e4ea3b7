"""Results of tasks: from the store, or from the executor and then kept as they come."""

import time
from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Protocol

from ...cases.case import Case
from ...cases.mistake import CaseError, Mistake
from .cache.key import Keys
from .cache.store import Store
from .processes.pool import Died, spread

PAUSE = 0.5  # s between two looks at the files of code


class Progress(Protocol):
    """A function called with what is being done, how many tasks are done, and of how many.

    last: the task that was done last, by its name. part: how much of the work is done, 0 to 1, of
    what was left to do; unlike the tasks' number it counts a long one for more.
    """

    def __call__(
        self, what: str, done: int, total: int, last: str = "", part: float = 0.0, /
    ) -> None: ...


def silent(what: str, done: int, total: int, last: str = "", part: float = 0.0, /) -> None:
    """Ignores progress."""


@dataclass(frozen=True)
class Results:
    """Executor, progress, store and keys, by which a run computes tasks or finds them stored."""

    executor: Executor
    progress: Progress
    store: Store
    keys: Keys

    def __post_init__(self) -> None:
        watch = getattr(self.progress, "watch", None)
        if watch is not None:
            watch(self.executor)

    def stored(self, keys: Iterable[str]) -> dict[str, Any]:
        """The stored results, by key."""
        return {key: kept for key in keys if (kept := self.store.get(key)) is not None}

    def keep(self, results: Mapping[str, Any]) -> None:
        """Stores results by their keys for the next run, unless the code has changed meanwhile."""
        if results and self.keys.hold():
            for key, result in results.items():
                self.store.put(key, result)

    def of(
        self, what: str, function: Callable[[Any], Any], tasks: Mapping[str, Any]
    ) -> dict[str, Any]:
        """Returns results by the tasks' keys: stored ones, and all others computed and kept."""
        stored = self.stored(tasks)
        missing = {key: task for key, task in tasks.items() if key not in stored}
        return stored | self.anew(what, function, missing, len(tasks), keep=True)

    def anew(
        self,
        what: str,
        function: Callable[[Any], Any],
        tasks: Mapping[Any, Any],
        of: int | None = None,
        *,
        keep: bool = False,
    ) -> dict[Any, Any]:
        """Computes every task, whatever is stored; of: how many there are with those stored.

        keep: whether the results are stored as they come, also where the rest is interrupted.
        """
        total = len(tasks) if of is None else of
        done, results, keys = total - len(tasks), dict[Any, Any](), list(tasks)
        whole, finished = sum(map(_work, tasks.values())) or 1.0, 0.0
        unkept, since = dict[str, Any](), time.monotonic()

        def tell(last: str = "") -> None:
            self.progress(what, done + len(results), total, last, finished / whole)

        tell()
        try:
            for index, result in spread(function, list(tasks.values()), self.executor, tell):
                key = keys[index]
                results[key] = result
                finished += _work(tasks[key])
                if keep and not isinstance(result, Died | CaseError):
                    unkept[key] = result
                if time.monotonic() - since >= PAUSE:  # to look at all files takes longer than most
                    self.keep(unkept)
                    unkept, since = {}, time.monotonic()
                tell(getattr(tasks[key], "name", ""))
        finally:
            self.keep(unkept)
        return results


def mistakes_of(case: Case, answer: object) -> list[Mistake]:
    """Why the case has no reference, of what the task `solved` gave; empty if it has one."""
    if isinstance(answer, CaseError):
        return answer.mistakes
    if not isinstance(answer, Died):
        return []
    what = f"the reference of {case.name} could not be solved: {answer.because}"
    return [Mistake(case.source.file, 0, 0, "", what)]


def _work(task: Any) -> float:
    """Returns the work of a task beside others of its kind: its steps, if it has any."""
    return float(getattr(task, "steps", 1.0))
