"""Power at the samples, and the work that it does from the first of them on.

Between two samples stands the polynomial through the six around them, on one side of all corners of
laws in time: there a power may jump or bend. So the error falls as the sixth power of the samples'
distance, where nothing else jumps, as friction and blows do. How large it is the reference says of
itself: it compares with sums over fewer samples.
"""

from collections.abc import Callable, Iterable
from itertools import pairwise

import numpy as np

from .pieces import AROUND, pieces
from .trajectory import Array, Trajectory


def done(
    motion: Trajectory, corners: Iterable[float], power: Callable[[Trajectory], Array]
) -> Array:
    """(N,) work [J] since the first sample, of a power [W] that is told at any rows of a motion."""
    found, before = [np.zeros(0)], 0.0
    for piece in pieces(motion, corners):
        own = motion.times[piece.own]
        marks = np.unique([piece.begin, *own.clip(piece.begin, piece.end), piece.end])
        sums = before + np.cumsum([0.0, *areas(piece.motion.times, power(piece.motion), marks)])
        found.append(sums[np.searchsorted(marks, own.clip(piece.begin, piece.end))])
        before = float(sums[-1])
    return np.concatenate(found)


def areas(times: Array, values: Array, marks: Array) -> list[float]:
    """The areas between each mark and the next, under the polynomials through the values around."""
    around = [_around(times, (a + b) / 2) for a, b in pairwise(marks.tolist())]
    between = zip(around, pairwise(marks.tolist()), strict=True)
    return [_between(times[rows], values[rows], *ends) for rows, ends in between]


def _around(times: Array, middle: float) -> slice:
    """The rows around a time."""
    first = int(np.searchsorted(times, middle)) - AROUND // 2
    first = min(max(0, first), max(0, len(times) - AROUND))
    return slice(first, first + AROUND)


def _between(times: Array, values: Array, begin: float, end: float) -> float:
    """The area from `begin` to `end` under the polynomial through all rows."""
    middle, half = (begin + end) / 2, (end - begin) / 2
    size = max(half, float(np.ptp(times)))  # scaled: a power of a small time is none
    degrees = np.arange(len(times))
    powers = ((times - middle) / size)[:, None] ** degrees
    each = (1 - (-1.0) ** (degrees + 1)) / (degrees + 1) * (half / size) ** (degrees + 1)
    return size * float(each @ np.linalg.solve(powers, values))
