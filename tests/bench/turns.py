"""CPU time of several works, taken in turn in one run: a busy machine slows all of them alike."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from textmech.cases.trajectory import Array

Work = Callable[[], object]


@dataclass(frozen=True)
class Ratio:
    """CPU time of one work over another's: median of the rounds, half the interquartile range.

    A round's own ratio counts, for its two works had the same machine.
    """

    median: float
    spread: float

    def __str__(self) -> str:
        return f"{self.median:.2f} ±{self.spread:.2f}"


def ratio(ours: Array, plain: Array) -> Ratio:
    """Returns the ratio of two works from their CPU seconds (rounds,), `ours` over `plain`."""
    low, middle, high = np.quantile(ours / plain, (0.25, 0.5, 0.75)).tolist()
    return Ratio(middle, (high - low) / 2)


def turns(works: Sequence[Callable[[int], Work]], rounds: int) -> Array:
    """CPU seconds (works, rounds), all threads; what prepares a work for a round is not counted."""
    seconds = np.empty((len(works), rounds))
    for i in range(rounds):
        for row, prepare in zip(seconds, works, strict=True):
            work = prepare(i)
            before = time.process_time()
            work()
            row[i] = time.process_time() - before
    return seconds
