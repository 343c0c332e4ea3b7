"""Power at the samples, and the work that it does from the first of them on.

Between two samples stands the polynomial through the six around them, so that the error falls as
the sixth power of their distance where the power is smooth, and as the first where it jumps. How
large it is the reference says of itself: it compares with sums over fewer samples.
"""

import numpy as np

from .trajectory import Array

AROUND = 6  # samples in a polynomial: of fifth degree


def done(times: Array, power: Array) -> Array:
    """(N,) work [J] since the first of the times [s], of a power [W] (N,)."""
    steps = [
        _between(times[rows], power[rows], *times[i : i + 2].tolist())
        for i in range(len(times) - 1)
        if (rows := _around(i, len(times)))
    ]
    return np.concatenate([[0.0], np.cumsum(steps)])


def _around(i: int, n: int) -> slice:
    """The samples around those with the numbers i and i + 1."""
    first = min(max(0, i + 1 - AROUND // 2), max(0, n - AROUND))
    return slice(first, first + AROUND)


def _between(times: Array, power: Array, begin: float, end: float) -> float:
    """The area from `begin` to `end` under the polynomial through all rows."""
    middle, half = (begin + end) / 2, (end - begin) / 2  # scaled: a power of a small time is none
    degrees = np.arange(len(times))
    powers = ((times - middle) / half)[:, None] ** degrees
    areas = (1 - (-1.0) ** (degrees + 1)) / (degrees + 1)  # of each over −1 to 1
    return half * float(areas @ np.linalg.solve(powers, power))
