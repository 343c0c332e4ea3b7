"""Where a smooth piece of the reference passes zero from above, as the top of a flight does."""

from collections.abc import Callable, Iterator
from itertools import pairwise

import numpy as np
from scipy.interpolate import BarycentricInterpolator
from scipy.optimize import brentq, minimize_scalar

from ...cases.trajectory import Array

AROUND = 8  # steps in a curve: of seventh degree, as the integrator's eighth order
LOCATED = 1e-12  # s: how well an extremum between two steps is found


def passages(times: Array, u: Array, still: float) -> Iterator[float]:
    """Times [s] at which u (N,) falls through zero between rows that are above and below `still`.

    A row at zero lies between the two; what ends at zero is the boundary's. A dip below zero, or a
    hump above it, may hide between rows: the curve's extremum there is one more row.
    """
    times, kept = np.unique(times, return_index=True)
    u = u[kept]
    curves = [_curve(times, u, i) for i in range(len(u))]
    rows = sorted([*zip(times.tolist(), u.tolist(), range(len(u)), strict=True)])
    rows = sorted([*rows, *_hidden(times, u, curves)])
    clear = [row for row in rows if abs(row[1]) > still]
    for (before, above, i), (after, below, _) in pairwise(clear):
        if above > 0.0 > below:
            yield float(brentq(curves[i], before, after, xtol=1e-14))


def _curve(times: Array, u: Array, i: int) -> Callable[[float], float]:
    """Through the rows around i; made when it is first asked for."""
    first = min(max(0, i - AROUND // 2 + 1), max(0, len(u) - AROUND))
    rows = slice(first, first + AROUND)
    made: list[BarycentricInterpolator] = []

    def value(t: float) -> float:
        if not made:
            made.append(BarycentricInterpolator(times[rows], u[rows]))
        return float(made[0](t))

    return value


def _hidden(
    times: Array, u: Array, curves: list[Callable[[float], float]]
) -> Iterator[tuple[float, float, int]]:
    """Extrema beyond zero beside a row that is as near to zero as it differs from the others."""
    for i in range(1, len(u) - 1):
        sign = 1.0 if u[i] > 0.0 else -1.0
        left, here, right = (float(sign * x) for x in u[i - 1 : i + 2])
        if not (0.0 < here <= min(left, right) and here <= max(left, right) - here):
            continue
        turn = minimize_scalar(
            lambda t, sign=sign, curve=curves[i]: sign * curve(t),
            bounds=(times[i - 1], times[i + 1]),
            method="bounded",
            options={"xatol": LOCATED},
        )
        if turn.fun < 0.0:
            yield float(turn.x), float(sign * turn.fun), i
