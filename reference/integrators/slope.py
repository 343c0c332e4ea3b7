"""What is integrated: a slope, and how well it is known."""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

Vector = NDArray[np.float64]
Slope = Callable[[float, Vector], Vector]

EPS = float(np.finfo(np.float64).eps)
DIFFERENCED = 10  # points; four differences of order 6
APART = 1e-4  # of the step between them: then a smooth slope leaves 1e-24 of itself there
LOUD = 1e-8  # of the slopes: rounding grows beyond that only where a mechanism is singular
POINTS = DIFFERENCED + 2  # at which a slope is asked for its noise


def noise(f: Slope, t: float, y: Vector, h: float, peak: Vector) -> Vector | None:
    """The rounding in f, (n,): its standard deviation, from a table of differences.

    None where it is no small part of f: there is no solution to follow then.

    J. J. More, S. M. Wild, Estimating computational noise, SIAM J. Sci. Comput. 33 (2011) 1292.
    The sixth differences of a smooth function vanish; of noise they are sqrt(12!)/6! = 30 times
    as large.  The line goes along the motion, and across it by some ulp (no whole number of them),
    as the state itself is rounded too.  So is the time: a force that grows evenly shows it in no
    difference.
    """
    along, across = f(t, y), math.pi * EPS * peak
    pace = APART * h
    values = [f(t + i * pace, y + i * (pace * along + across)) for i in range(DIFFERENCED)]
    differences = np.diff(np.array(values), n=6, axis=0)
    found = np.sqrt(np.mean(differences**2, axis=0) / 924.0)
    late = math.ulp(t) / math.sqrt(12.0)  # of a clock that is rounded, evenly
    found = np.maximum(found, late * np.abs(values[-1] - values[0]) / (DIFFERENCED - 1) / pace)
    largest = np.maximum(np.abs(along), np.abs(f(t + h, y + h * along)))
    return found if found.max() <= LOUD * largest.max() < math.inf else None
