"""A zero that is nearly known, again from the steps right beside it, where those can be trusted.

What slides smoothly until it rests, or from when it breaks loose, is known there as well as the
engine knows its motion: t as a curve of u through eight steps, at u = 0. Whether the steps beside a
rest are smooth, or an engine's creep and a soft contact have bent them already, two such curves
tell: of eight steps and of six they agree better with each other than with the zero as it was, or
it stays that: it is the mean of many steps, which noise moves less.
"""

import numpy as np

from ....cases.scene.passages import polynomial
from ....cases.trajectory import Array

STEPS, FEWER = 8, 6  # of seventh and fifth degree: both above what the engines' own order leaves
SKIPPED = 4  # at most: an engine's law may bend the last steps
AGREE = 1e-3  # of a step: curves that are further apart are not those of a smooth motion


def continued(times: Array, u: Array, zero: float, away: int) -> float:
    """The zero [s] of u (N,) again; away: 1 where u stops there, −1 where it starts."""
    h = float(times[1] - times[0])
    moving = np.flatnonzero(away * (zero - times) > 0.0)[::-away]  # the nearest first
    best, apart = zero, AGREE * h
    for skipped in range(SKIPPED):
        rows = moving[skipped : skipped + STEPS]
        steps = np.diff(u[rows])
        if len(rows) < STEPS:
            break
        if not np.all(steps * u[rows[0]] > 0.0):
            continue  # it does not grow from the rest on: no curve of u
        found, other = (_at_zero(times[rows[:n]], u[rows[:n]]) for n in (STEPS, FEWER))
        if abs(found - other) < min(apart, abs(found - zero)) and abs(found - zero) < h:
            best, apart = found, abs(found - other)
    return best


def _at_zero(times: Array, u: Array) -> float:
    """t where u is 0."""
    return polynomial(u, times)(0.0)
