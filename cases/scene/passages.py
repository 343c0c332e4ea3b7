"""Where a smooth piece of the reference passes zero from above, as the top of a flight does."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..trajectory import Array, Trajectory

AROUND = 8  # steps in a curve: of seventh degree, as the integrator's eighth order
ROOT = 1e-15  # s: what the root-finder is asked for
JUMP = 1e-6  # of the largest value: what a curve leaves open that goes on for a quarter of a step
MIRRORED = 0.5  # of a fold's size: so well a curve goes on to it; one with no fold is off by twice
LOCATED = 1e-12  # s: how well an extremum between two steps is found
FINE = 1e-13  # of the time between two steps: so well a root is found where that is little
FLAT = 1e-10  # of it: so well an extremum

Curve = Callable[[float], float]
"""t → u."""


def lasting(record: Trajectory) -> list[NDArray[np.int64]]:
    """The rows of each phase of a record that lasts: what ends as it begins is none."""
    assert record.phase is not None  # the reference's record has it
    phases = np.split(np.arange(len(record.times)), np.flatnonzero(np.diff(record.phase)) + 1)
    return [rows for rows in phases if record.times[rows[-1]] > record.times[rows[0]]]


def passages(
    times: Array, u: Array, still: float, corners: Sequence[float] = ()
) -> Iterator[float]:
    """Times [s] at which u (N,) falls through zero, as `passing` finds them."""
    return (t for t, _ in passing(times, u, still, corners))


def passing(
    times: Array, u: Array, still: float, corners: Sequence[float] = ()
) -> Iterator[tuple[float, Curve]]:
    """When [s] u (N,) falls through zero between rows that are above and below `still`, and by
    which curve.

    A row at zero lies between the two; what ends at zero is the boundary's. A dip below zero, or a
    hump above it, may hide between rows: the curve's extremum there is one more row. corners [s]:
    rows at which u may bend or jump, and no curve goes through both sides of one; what jumps across
    zero there does not fall through it.
    """
    from scipy.optimize import brentq

    for part in _unbroken(times, u, corners):
        times, u, bends, rows = _rows(*part, still, corners)
        clear = [row for row in rows if abs(row[1]) > still]
        for (before, above, i), (after, below, k) in pairwise(clear):
            if above > 0.0 > below:
                hidden = after != times[k]  # it is told by a curve, and falls by this one
                curve = _curve(times, u, k if hidden else i, bends)
                yield float(brentq(curve, before, after, xtol=_fine(before, after))), curve


def touches(times: Array, u: Array, still: float, corners: Sequence[float] = ()) -> Iterator[float]:
    """Times [s] at which u (N,) comes as near to zero as `still` and turns back, through it or not.

    Rounding says which.
    """
    for part in _unbroken(times, u, corners):
        *_, rows = _rows(*part, still, corners)
        clear = [k for k, row in enumerate(rows) if abs(row[1]) > still]
        for i, k in pairwise(clear):
            if k > i + 1 and rows[i][1] * rows[k][1] > 0.0:
                yield min(rows[i + 1 : k], key=lambda row: abs(row[1]))[0]


def smooth(record: Trajectory, corners: Sequence[float]) -> Iterator[NDArray[np.int64]]:
    """Yields the rows between two corners in a phase, from the first of them on."""
    for rows in lasting(record):
        yield from np.split(rows, bent(record.times[rows], corners))


def dips(times: Array, u: Array) -> Iterator[tuple[float, float]]:
    """When [s] u (N,), positive in its smooth rows, is zero or less between two, and how much."""
    times, kept = np.unique(times, return_index=True)
    return ((t, low) for t, low, _ in _hidden(times, u[kept], (), 0.0))


def _rows(
    times: Array, u: Array, still: float, corners: Sequence[float]
) -> tuple[Array, Array, list[int], list[tuple[float, float, int]]]:
    """The times, u there, the bends, and the rows: time, u and number, with what hides."""
    bends = bent(times, corners)
    rows = [*zip(times.tolist(), u.tolist(), range(len(u)), strict=True)]
    return times, u, bends, sorted([*rows, *_hidden(times, u, bends, still)])


def _unbroken(times: Array, u: Array, corners: Sequence[float]) -> Iterator[tuple[Array, Array]]:
    """Yields the times, each once, and u between one jump at a corner and the next.

    A row at a corner has what u is from then on; those before it tell where it was going, and that
    is one more row.
    """
    times, kept = np.unique(times, return_index=True)
    u, begin = u[kept], 0
    bends = bent(times, corners)
    for before, k in pairwise([0, *bends]):
        if k - before < AROUND // 2:
            continue
        came = _curve(times[:k], u[:k], k - 1, [before])(float(times[k]))
        if abs(came - u[k]) > JUMP * np.max(np.abs(u)):
            yield np.append(times[begin:k], times[k]), np.append(u[begin:k], came)
            begin = k
    yield times[begin:], u[begin:]


def leaps(times: Array, u: Array, corners: Sequence[float]) -> Iterator[tuple[float, float, float]]:
    """When [s] u (N,) jumps at a corner, where it came to, and from where it goes on."""
    for (before, came), (_, goes) in pairwise(_unbroken(times, u, corners)):
        yield float(before[-1]), float(came[-1]), float(goes[0])


def bent(times: Array, corners: Sequence[float]) -> list[int]:
    """The rows at corners; whatever steps to them ends there."""
    inside = [corner for corner in corners if times[0] < corner < times[-1]]
    return sorted({int(np.argmin(np.abs(times - corner))) for corner in inside})


def _curve(times: Array, u: Array, i: int, bends: Sequence[int]) -> Curve:
    """Through the rows around i and the next, none of them beyond a bend."""
    begin = max((k for k in bends if k <= i), default=0)
    end = 1 + min((k for k in bends if k > i), default=len(u) - 1)
    first = min(max(begin, i - AROUND // 2 + 1), max(begin, end - AROUND))
    rows = slice(first, min(first + AROUND, end))
    return polynomial(times[rows], u[rows])


def _fine(one: float, other: float) -> float:
    """How well [s] a root between two times is asked for."""
    return min(ROOT, FINE * abs(other - one))


def polynomial(x: Array, y: Array) -> Curve:
    """x → y, of the polynomial through the points: the same one, bit for bit, in every run.

    scipy multiplies its weights in an order drawn by chance, if nobody seeds it; and at one of the
    points it divides by a sum that may be 0, before it takes that point's y.
    """
    from scipy.interpolate import BarycentricInterpolator

    if len(x) == 1:
        return lambda t: float(y[0])
    made = BarycentricInterpolator(x, y, rng=0)

    def at(t: float) -> float:
        with np.errstate(invalid="ignore"):
            return float(made(t))

    return at


def _hidden(
    times: Array, u: Array, bends: Sequence[int], still: float
) -> Iterator[tuple[float, float, int]]:
    """Extrema at zero or beyond, beside a row as near to it as it differs from the others."""
    from scipy.optimize import minimize_scalar

    signs = np.where(u[1:-1] > 0.0, 1.0, -1.0)
    left, here, right = signs * u[:-2], signs * u[1:-1], signs * u[2:]
    near = (here > 0.0) & (here <= np.minimum(left, right))
    near &= here <= np.maximum(left, right) - here
    for i in (np.flatnonzero(near) + 1).tolist():
        sides = ((i - 1, i), (i, i + 1)) if i in bends else ((i - 1, i + 1),)
        if i not in bends and (bend := _mirrored(times, signs[i - 1] * u, i, bends)) is not None:
            yield bend, 0.0, i
            continue
        for begin, end in sides:
            k = begin if i in bends else i
            sign, curve = float(signs[i - 1]), _curve(times, u, k, bends)
            turn = minimize_scalar(
                lambda t, sign=sign, curve=curve: sign * curve(t),
                bounds=(times[begin], times[end]),
                method="bounded",
                options={"xatol": min(LOCATED, FLAT * float(times[end] - times[begin]))},
            )
            if turn.fun <= still:
                yield float(turn.x), float(sign * turn.fun), k


def _mirrored(times: Array, u: Array, i: int, bends: Sequence[int]) -> float | None:
    """When [s] u (N,) comes to zero beside row i and turns back at once: the size of what passes.

    A curve through the rows on one side then goes on below zero, as far as the row beyond is above.
    """
    from scipy.optimize import brentq

    begin = max((k for k in bends if k <= i), default=0)
    end = 1 + min((k for k in bends if k > i), default=len(u) - 1)
    found: list[tuple[float, float]] = []
    for last, beyond in ((i, i + 1), (i - 1, i), (i, i - 1), (i + 1, i)):
        if beyond > last:
            rows = slice(max(begin, last + 1 - AROUND), last + 1)
        else:
            rows = slice(last, min(end, last + AROUND))
        if len(u[rows]) < AROUND // 2 or not begin <= beyond < end:
            continue
        curve = polynomial(times[rows], u[rows])
        on = curve(float(times[beyond]))
        both = min(u[last], u[beyond]) > 0.0 > on
        if both and (off := abs(on / u[beyond] + 1.0)) < MIRRORED:
            xtol = _fine(float(times[last]), float(times[beyond]))
            found.append((off, float(brentq(curve, times[last], times[beyond], xtol=xtol))))
    return min(found)[1] if found else None  # a curve with one row of the other side tells worse
