"""The slope that is integrated, and how well it is known."""

import math
from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Slope = Callable[[float, Vector], Vector]

EPS = float(np.finfo(np.float64).eps)
DIFFERENCED = 10  # points; four differences of order 6
APART = 1e-4  # of the step between them: then a smooth slope leaves 1e-24 of itself there
LOUD = 1e-8  # of the slopes: rounding grows beyond that only where a mechanism is singular
FINE, COARSE = -60, 20  # powers of two, of the way that it first takes, among which f feels it
POINTS = DIFFERENCED + 2  # at which a slope is asked for its noise


def noise(
    f: Slope,
    t: float,
    y: Vector,
    h: float,
    peak: Vector,
    least: Vector | float = 0.0,
    later: Vector | float = 0.0,
) -> Vector | None:
    """The rounding in f, (n,): its standard deviation, from a table of differences.

    At least `least`. None where it is no small part of f, or of what f is `later`: there is no
    solution to follow then.

    J. J. More, S. M. Wild, Estimating computational noise, SIAM J. Sci. Comput. 33 (2011) 1292.
    The sixth differences of a smooth function vanish; of noise they are sqrt(12!)/6! = 30 times
    as large.  The line goes along the motion, and across it by some ulp (no whole number of them),
    as the state itself is rounded too.  So is the time: a force that grows evenly shows it in no
    difference.
    """
    along, across = f(t, y), math.pi * EPS * peak
    pace = APART * h
    values = [f(t + i * pace, y + i * (pace * along + across)) for i in range(DIFFERENCED)]
    sigma = scatter(values)
    late = math.ulp(t) / math.sqrt(12.0)  # of a clock that is rounded, evenly
    sigma = np.maximum(sigma, late * np.abs(values[-1] - values[0]) / (DIFFERENCED - 1) / pace)
    sigma = np.maximum(sigma, least)
    largest = np.maximum(np.maximum(np.abs(along), np.abs(f(t + h, y + h * along))), later)
    return sigma if sigma.max() <= LOUD * largest.max() < math.inf else None


def scatter(values: Sequence[Vector]) -> Vector:
    """The standard deviation of the rounding in what is smooth and was asked at even distances."""
    return np.sqrt(np.mean(np.diff(np.array(values), n=6, axis=0) ** 2, axis=0) / 924.0)


def leaps(f: Slope, t: float, y: Vector, h: float) -> Vector:
    """The rounding in f, (n,), of a state of rest that is zero, from the least of it that f feels.

    What stands a metre from where it is measured is there for f until it has moved by an ulp of
    that: no small step meets such a leap, and after many it comes. A state that f takes as it is
    has none. So leaps a small force that grows beside a large one: in time, by an ulp of that.
    """
    rest = f(t, y)
    way = h * f(t + h, y + h * f(t + h, y + h * rest))  # in which what is pushed also moves
    rounding = _leap(lambda part: np.abs(f(t + part * h, y) - rest), 0)
    for j in np.flatnonzero(way):

        def change(part: float, j: Any = j) -> Vector:
            moved = y.copy()
            moved[j] += part * way[j]
            return np.abs(f(t, moved) - rest)

        rounding = np.maximum(rounding, _leap(change, COARSE))
    return rounding


def _leap(change: Callable[[float], Vector], coarse: int) -> Vector:
    """The change at the least power of two, up to 2^coarse, at which there is any, over √12.

    0 where there is one at the finest as well, or none at the coarsest.
    """
    low, high = FINE, coarse
    if change(math.ldexp(1.0, low)).any() or not change(math.ldexp(1.0, high)).any():
        return 0.0 * change(0.0)
    while high - low > 1:
        k = (low + high) // 2
        low, high = (low, k) if change(math.ldexp(1.0, k)).any() else (k, high)
    return change(math.ldexp(1.0, high)) / math.sqrt(12.0)
