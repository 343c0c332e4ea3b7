"""Results of tasks: from the store, or from the executor and then kept as they come."""

from collections.abc import Callable, Iterable, Mapping
from concurrent.futures import Executor
from dataclasses import dataclass
from typing import Any

from ..cases.mistake import CaseError
from .cache.key import Keys
from .cache.store import Store
from .pool import Died, spread

Progress = Callable[[str, int, int], None]
"""What is being done, how much is done, out of how much."""


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
        self.progress(what, done, total)
        for index, result in spread(function, list(tasks.values()), self.executor):
            found[keys[index]] = result
            if not isinstance(result, Died | CaseError):
                keep(keys[index], result)
            self.progress(what, done + len(found), total)
        return found
