"""The second answer for motions that switch: the law of friction itself, in small equal steps.

No modes and no guards: at every step the friction is what the law says at that v and F_a.
"""

import math
from collections.abc import Callable

import numpy as np

from ..system import Array


def stepped(
    m: float,
    F_a: Callable[[float, float], float],
    F_fr: Callable[[float, float], float],
    *,
    start: tuple[float, float] = (0.0, 0.0),
    h: float,
    steps: int,
    rests: Callable[[float, float, float], bool] = lambda v, after, F_a: v * after < 0.0,
) -> Array:
    """(2.88) ẋ = v, m v̇ = F_a(t, x) + F_fr(v, F_a): x and v at every step, (steps + 1, 2).

    A float jumps over v = 0, where (2.89) sticks: `rests(v, v after the step, F_a)` says when the
    step ends at v = 0. By itself, where v changes sign.
    """
    x, v = start
    rows = [(x, v)]
    for k in range(steps):
        force = F_a(k * h, x)
        after = v + h * (force + F_fr(v, force)) / m
        if rests(v, after, force):
            after = 0.0
        x, v = x + h * (v + after) / 2, after
        rows.append((x, v))
    return np.array(rows)


def arrest(series: Array, h: float) -> list[tuple[str, float]]:
    """`slips` and `stops` with their times [s]: where v leaves zero and where it comes back.

    v = 0 at one single step is a turning point.
    """
    moving = series[:, 1] != 0.0
    moving[1:-1] |= moving[:-2] & moving[2:]
    turns = np.flatnonzero(moving[1:] != moving[:-1])
    return [("stops" if moving[k] else "slips", math.fsum((k, moving[k])) * h) for k in turns]
