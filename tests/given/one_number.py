"""A block with one number of dry friction, (2.88) stepped with (2.89): what engines know of it."""

import math
from collections.abc import Callable

import numpy as np

from textmech.cases.trajectory import Array

STEPS = 400  # a sample interval: first order, so some 1e-4 of the motion


def one_number(
    applied: Callable[[float, float], float], m: float, bound: float, times: Array
) -> tuple[Array, Array, list[float], list[float]]:
    """x, v (N,) at the times, and when [s] it slips and stops; at rest it holds up to `bound` [N].

    A step changes v by the applied force, then friction takes its impulse from what is left.
    """
    h = float(times[1] - times[0]) / STEPS
    x = v = 0.0
    xs, vs = [x], [v]
    slips: list[float] = []
    stops: list[float] = []
    for i in range(STEPS * (len(times) - 1)):
        moved = v
        free = v + h * applied(i * h, x) / m
        v = math.copysign(max(0.0, abs(free) - h * bound / m), free)
        x += h * v
        if (v == 0.0) != (moved == 0.0):
            (stops if v == 0.0 else slips).append((i + 1) * h)
        if (i + 1) % STEPS == 0:
            xs.append(x)
            vs.append(v)
    return np.array(xs), np.array(vs), slips, stops
