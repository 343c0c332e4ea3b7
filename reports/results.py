"""Results of tasks: from the store, or from the executor and then kept as they come."""

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any, Protocol

from ..cases.mistake import CaseError
from .cache.key import Keys
from .cache.store import Store
from .pool import Died, spread


class Progress(Protocol):
    """Is told what is being done, how many tasks of it are done, out of how many.

    last: the task that was done last, by its name. part: how much of the work is done, 0 to 1, of
    what was left to do; unlike the tasks' number it counts a long one for more.
    """

    def __call__(
        self, what: str, done: int, total: int, last: str = "", part: float = 0.0, /
    ) -> None: ...


@dataclass(frozen=True)
class Results:
    """What every phase of a run needs."""

    executor: Executor
    progress: Progress
    store: Store
    keys: Keys

    def stored(self, keys: Iterable[str]) -> dict[str, Any]:
        """Those that need not be computed."""
        return {key: kept for key in keys if (kept := self.store.get(key)) is not None}

    def keep(self, key: str, result: Any) -> None:
        """For the next run, unless it may be of a mixture of code."""
        if self.keys.hold():
            self.store.put(key, result)

    def of(
        self, what: str, function: Callable[[Any], Any], tasks: Mapping[str, Any]
    ) -> dict[str, Any]:
        """By the tasks' keys: what is stored, and all else computed and kept at once."""
        found = self.stored(tasks)
        left = {key: task for key, task in tasks.items() if key not in found}
        return found | self.anew(what, function, left, len(tasks), self.keep)

    def anew(
        self,
        what: str,
        function: Callable[[Any], Any],
        tasks: Mapping[str, Any],
        of: int | None = None,
        keep: Callable[[str, Any], None] = lambda key, result: None,
    ) -> dict[str, Any]:
        """All computed, whatever is stored; of: so many there are with those that are stored."""
        total = len(tasks) if of is None else of
        done, found, keys = total - len(tasks), dict[str, Any](), list(tasks)
        work = {key: _work(task) for key, task in tasks.items()}

        def tell(last: str = "") -> None:
            part = sum(work[key] for key in found) / (sum(work.values()) or 1.0)
            self.progress(what, done + len(found), total, last, part)

        tell()
        for index, result in spread(function, list(tasks.values()), self.executor, tell):
            key = keys[index]
            found[key] = result
            if not isinstance(result, Died | CaseError):
                keep(key, result)
            tell(getattr(tasks[key], "name", ""))
        return found


def _work(task: Any) -> float:
    """How much a task is, among its like: its steps, if it has any."""
    return float(getattr(task, "steps", 1.0))
