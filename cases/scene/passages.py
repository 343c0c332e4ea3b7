"""Smooth pieces of the reference, and where one passes zero from above, as the top of a flight."""

from collections.abc import Callable, Iterator, Sequence
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray

from ..trajectory import Array, Trajectory
from . import Scene
from .observe import observe
from .quantity import table

AROUND = 8  # steps in a curve: of seventh degree, as the integrator's eighth order
ROOT = 1e-15  # s: what the root-finder is asked for
JUMP = 1e-6  # of the largest value: what a curve leaves open that goes on for a quarter of a step
MIRRORED = 0.5  # of a fold's size: so well a curve goes on to it; one with no fold is off by twice
LOCATED = 1e-12  # s: how well an extremum between two steps is found
FINE = 1e-13  # of the time between two steps: so well a root is found where that is little
FLAT = 1e-10  # of it: so well an extremum
STILL = 1e-9  # of the largest value of its kind: what rounding leaves of a zero of the reference

Curve = Callable[[float], float]
"""t → u."""


def lasting(record: Trajectory) -> list[NDArray[np.int64]]:
    """The rows of each phase of a record that lasts: what ends as it begins is none."""
    assert record.phase is not None  # the reference's record has it
    phases = np.split(np.arange(len(record.times)), np.flatnonzero(np.diff(record.phase)) + 1)
    return [rows for rows in phases if record.times[rows[-1]] > record.times[rows[0]]]


def smooth(record: Trajectory, corners: Sequence[float]) -> Iterator[NDArray[np.int64]]:
    """Yields the rows between two corners in a phase, from the first of them on."""
    for rows in lasting(record):
        yield from np.split(rows, _bends(record.times[rows], corners))


def pieces(
    record: Trajectory, u: Array, corners: Sequence[float]
) -> Iterator[tuple[int, Array, Array]]:
    """Yields the phase, times and u of each smooth piece of a record, whose ends two may share.

    A row at a corner has what u is from then on; where it jumps there, those before it tell where
    it was going.
    """
    assert record.phase is not None
    for rows in lasting(record):
        times, kept = np.unique(record.times[rows], return_index=True)
        values, bends = u[rows[kept]], _bends(times, corners)
        for begin, end in pairwise([0, *bends, len(times) - 1]):
            t, part = times[begin : end + 1], values[begin : end + 1].copy()
            if end in bends and len(t) > AROUND // 2:
                came = polynomial(t[-1 - AROUND : -1], part[-1 - AROUND : -1])(float(t[-1]))
                if abs(came - part[-1]) > JUMP * np.max(np.abs(values)):
                    part[-1] = came
            yield int(record.phase[rows[0]]), t, part


def _bends(times: Array, corners: Sequence[float]) -> list[int]:
    """The rows at corners, but the first and the last; whatever steps to them ends there."""
    inside = [corner for corner in corners if times[0] < corner < times[-1]]
    rows = {int(np.argmin(np.abs(times - corner))) for corner in inside}
    return sorted(rows - {0, len(times) - 1})


def passing(times: Array, u: Array, still: float) -> Iterator[tuple[float, Curve | None]]:
    """When [s] a smooth u (N,) falls through zero between rows that are above and below `still`,
    and by which curve; None where it only comes as near to zero as that and turns back.

    A row at zero lies between the two; what ends at zero is the boundary's. A dip below zero, or a
    hump above it, may hide between rows: the curve's extremum there is one more row.
    """
    from scipy.optimize import brentq

    numbered = zip(times.tolist(), u.tolist(), range(len(u)), strict=True)
    rows = sorted([*numbered, *_hidden(times, u, still)])
    clear = [k for k, row in enumerate(rows) if abs(row[1]) > still]
    for i, k in pairwise(clear):
        (before, above, row), (after, below, other) = rows[i], rows[k]
        if above > 0.0 > below:
            hidden = after != times[other]  # it is told by a curve, and falls by this one
            curve = _curve(times, u, other if hidden else row)
            yield float(brentq(curve, before, after, xtol=_fine(before, after))), curve
        elif k > i + 1 and above * below > 0.0:
            yield min(rows[i + 1 : k], key=lambda row: abs(row[1]))[0], None


def dips(times: Array, u: Array) -> Iterator[tuple[float, float]]:
    """When [s] u (N,), positive in its smooth rows, is zero or less between two, and how much."""
    times, kept = np.unique(times, return_index=True)
    return ((t, low) for t, low, _ in _hidden(times, u[kept], 0.0))


def _curve(times: Array, u: Array, i: int) -> Curve:
    """Through the rows around i and the next."""
    first = min(max(0, i - AROUND // 2 + 1), max(0, len(u) - AROUND))
    return polynomial(times[first : first + AROUND], u[first : first + AROUND])


def _fine(begin: float, end: float) -> float:
    """How well [s] a root between two times is asked for."""
    return min(ROOT, FINE * abs(end - begin))


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


def _hidden(times: Array, u: Array, still: float) -> Iterator[tuple[float, float, int]]:
    """Extrema at zero or beyond, beside a row as near to it as it differs from the others."""
    from scipy.optimize import minimize_scalar

    signs = np.where(u > 0.0, 1.0, -1.0)
    here = signs * u
    row_before = np.append(np.inf, signs[1:] * u[:-1])
    row_after = np.append(signs[:-1] * u[1:], np.inf)
    near = (here > 0.0) & (here <= np.minimum(row_before, row_after))
    near &= here <= np.maximum(row_before, row_after) - here
    for i in np.flatnonzero(near).tolist():
        sign = float(signs[i])
        if (turn := _mirrored(times, sign * u, i)) is not None:
            yield turn, 0.0, i
            continue
        curve = _curve(times, u, i)
        least = minimize_scalar(
            lambda t, sign=sign, curve=curve: sign * curve(t),
            bounds=(begin := times[max(i - 1, 0)], end := times[min(i + 1, len(u) - 1)]),
            method="bounded",
            options={"xatol": min(LOCATED, FLAT * float(end - begin))},
        )
        if least.fun <= still:
            yield float(least.x), float(sign * least.fun), i


def _mirrored(times: Array, u: Array, i: int) -> float | None:
    """When [s] u (N,) comes to zero beside row i and turns back at once: the size of what passes.

    A curve through the rows on one side then goes on below zero, as far as the row beyond is above.
    """
    from scipy.optimize import brentq

    turns: list[tuple[float, float]] = []
    for last, beyond in ((i, i + 1), (i - 1, i), (i, i - 1), (i + 1, i)):
        rows = slice(max(0, last + 1 - AROUND), last + 1)
        if beyond < last:
            rows = slice(last, last + AROUND)
        if len(u[rows]) < AROUND // 2 or not 0 <= beyond < len(u):
            continue
        curve = polynomial(times[rows], u[rows])
        on = curve(float(times[beyond]))
        both = min(u[last], u[beyond]) > 0.0 > on
        if both and (off := abs(on / u[beyond] + 1.0)) < MIRRORED:
            xtol = _fine(float(times[last]), float(times[beyond]))
            turns.append((off, float(brentq(curve, times[last], times[beyond], xtol=xtol))))
    return min(turns)[1] if turns else None  # a curve with one row of the other side tells worse


def still(scene: Scene, record: Trajectory, name: str) -> float:
    """The bound below which values of a quantity of the reference are zero, in its unit."""
    u = observe(scene, record, name)
    return STILL * max(float(np.max(np.abs(u))), _peers(scene, record, name))


def _peers(scene: Scene, record: Trajectory, name: str) -> float:
    """The largest of all places, rates or forces of the scene: what trembles is small beside it."""
    quantity = table(scene)[name]
    columns = scene.frame.alike(quantity.unit)
    peers = [states[:, columns] for states in record.states.values()]
    if quantity.kind == "force":
        peers += list(record.reactions.values())
    return max((float(np.max(np.abs(x), initial=0.0)) for x in peers), default=0.0)
