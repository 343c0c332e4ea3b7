"""Where a smooth piece of the reference passes zero from above, as the top of a flight does."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np

from ...cases.trajectory import Array

AROUND = 8  # steps in a curve: of seventh degree, as the integrator's eighth order
LOCATED = 1e-12  # s: how well an extremum between two steps is found


def passages(times: Array, u: Array, still: float) -> Iterator[float]:
    """Times [s] at which u (N,) falls through zero between rows that are above and below `still`.

    A row at zero lies between the two; what ends at zero is the boundary's. A dip below zero, or a
    hump above it, may hide between rows: the curve's extremum there is one more row.
    """
    from scipy.optimize import brentq

    times, kept = np.unique(times, return_index=True)
    u = u[kept]
    rows = [*zip(times.tolist(), u.tolist(), range(len(u)), strict=True)]
    rows = sorted([*rows, *_hidden(times, u)])
    clear = [row for row in rows if abs(row[1]) > still]
    for (before, above, i), (after, below, _) in pairwise(clear):
        if above > 0.0 > below:
            yield float(brentq(_curve(times, u, i), before, after, xtol=1e-14))


def _curve(times: Array, u: Array, i: int) -> Callable[[float], float]:
    """Through the rows around i."""
    from scipy.interpolate import BarycentricInterpolator

    first = min(max(0, i - AROUND // 2 + 1), max(0, len(u) - AROUND))
    rows = slice(first, first + AROUND)
    made = BarycentricInterpolator(times[rows], u[rows])
    return lambda t: float(made(t))


def _hidden(times: Array, u: Array) -> Iterator[tuple[float, float, int]]:
    """Extrema beyond zero beside a row that is as near to zero as it differs from the others."""
    from scipy.optimize import minimize_scalar

    signs = np.where(u[1:-1] > 0.0, 1.0, -1.0)
    left, here, right = signs * u[:-2], signs * u[1:-1], signs * u[2:]
    near = (here > 0.0) & (here <= np.minimum(left, right))
    near &= here <= np.maximum(left, right) - here
    for i in (np.flatnonzero(near) + 1).tolist():
        sign, curve = float(signs[i - 1]), _curve(times, u, i)
        turn = minimize_scalar(
            lambda t, sign=sign, curve=curve: sign * curve(t),
            bounds=(times[i - 1], times[i + 1]),
            method="bounded",
            options={"xatol": LOCATED},
        )
        if turn.fun < 0.0:
            yield float(turn.x), float(sign * turn.fun), i
