"""A row of the benchmark, and CPU seconds of several works taken in turn."""

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from textmech.cases.trajectory import Array

Work = Callable[[], object]


@dataclass(frozen=True)
class Row:
    """CPU time of one work, beside that of another in the same run.

    seconds: of ours. ratio: to the other work's, the median over the rounds; spread: half of what
    the middle half of the rounds spans. aim: of the ratio, or where there is none of the seconds.
    note: why there is no figure, or what was compared. wrong: what was compared is not the same.
    """

    part: str
    name: str
    over: str = ""
    seconds: float = np.nan
    ratio: float = np.nan
    spread: float = np.nan
    aim: float = np.nan
    note: str = ""
    wrong: bool = False


def ratio(ours: Array, other: Array) -> tuple[float, float]:
    """Returns median and half interquartile range of the ratios of each round, from CPU seconds.

    A round's own ratio counts, for its two works had the same machine.
    """
    low, middle, high = np.quantile(ours / other, (0.25, 0.5, 0.75)).tolist()
    return middle, (high - low) / 2


def in_turn(works: Sequence[Callable[[int], Work]], rounds: int) -> Array:
    """Returns CPU seconds (works, rounds) of all threads, each work once a round.

    Each is made for its round by a function of the round's number, which is not counted.
    """
    seconds = np.empty((len(works), rounds))
    for i in range(rounds):
        for row, make in zip(seconds, works, strict=True):
            work = make(i)
            before = time.process_time()
            work()
            row[i] = time.process_time() - before
    return seconds
