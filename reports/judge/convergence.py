"""What a ladder of steps h, 2h, 4h, … says: order, limit for h → 0, verdict, usable step.

The order is that of neighbouring differences u(2h) − u(h), never of errors: a model's error would
hide it. The limit is Romberg's, with the exponents that the engine's setting declares.
"""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ...cases.trajectory import Array
from . import metric

EXACT = "exact"
TEXTBOOK = "converges to the textbook"
ANOTHER = "converges to another value"
UNSETTLED = "not settled"
INSTANTS = "instants"  # of events: they have errors and a usable step, and no order

TEXTBOOK_WITHIN = 3.0  # uncertainties between limit and reference
ANOTHER_BEYOND = 4.0
FALLS = 0.7  # a halved step halves a difference of first order; noise keeps it
FEWEST = 3  # samples away from events, or they say nothing of a motion
OF_ALLOW = 0.1  # an uncertainty above this part of `allow` decides nothing


@dataclass(frozen=True)
class Convergence:
    """One quantity on one ladder. Without a settled ladder there is no order."""

    verdict: str
    order: float | None
    order_low: float | None
    order_high: float | None
    limit: float | None  # largest |limit − reference|
    uncertainty: float | None
    usable_step: float | None  # the largest rung from which on the error stays within `allow`


def study(
    ladder: Mapping[float, Array],
    reference: Array,
    *,
    exponents: Sequence[int],
    allow: float,
    floor: float,
    away: NDArray[np.bool_] | None = None,
) -> Convergence:
    """Judges samples (N,) by step; the steps double from the smallest on.

    floor: the difference that rounding alone can make at the smallest step. away: the samples that
    are away from events, of which alone order and limit are taken: beside an event a sample is
    before it on one rung and after it on the next.
    """
    steps = sorted(ladder)
    errors = {h: metric.error(ladder[h], reference).largest for h in steps}
    usable = _usable(errors, allow)
    if errors[steps[0]] <= floor:
        return Convergence(EXACT, None, None, None, errors[steps[0]], floor, usable)
    keep = np.ones(len(reference), dtype=bool) if away is None else away
    if len(steps) < len(exponents) + 1 or np.count_nonzero(keep) < FEWEST:
        return Convergence(UNSETTLED, None, None, None, None, None, usable)
    rungs, reference = [ladder[h][keep] for h in steps], reference[keep]
    limit, uncertainty = _romberg(rungs, exponents)
    uncertainty = max(uncertainty, floor, _noise(rungs))
    off = float(np.max(np.abs(limit - reference)))
    if off <= TEXTBOOK_WITHIN * uncertainty and uncertainty <= OF_ALLOW * allow:
        verdict = TEXTBOOK
    elif off > ANOTHER_BEYOND * uncertainty:
        verdict = ANOTHER
    else:
        return Convergence(UNSETTLED, None, None, None, off, uncertainty, usable)
    orders = [] if _noise(rungs) else _orders(rungs, floor)
    low, high = (min(orders), max(orders)) if orders else (None, None)
    order = orders[0] if orders else None
    return Convergence(verdict, order, low, high, off, uncertainty, usable)


def instants(errors: Mapping[float, float], allow: float) -> Convergence:
    """What a ladder of events' errors by step says; inf where they happen more or less often."""
    return Convergence(INSTANTS, None, None, None, None, None, _usable(errors, allow))


def _usable(errors: Mapping[float, float], allow: float) -> float | None:
    usable = None
    for h in sorted(errors):
        if not errors[h] <= allow:
            break
        usable = h
    return usable


def _orders(rungs: Sequence[Array], floor: float) -> list[float]:
    """log₂ of the ratios of neighbouring differences, the last three, finest first."""
    d = [float(np.max(np.abs(b - a))) for a, b in itertools.pairwise(rungs)]
    pairs = itertools.pairwise(d)
    return [math.log2(coarse / fine) for fine, coarse in pairs if fine > floor][:3]


def _noise(rungs: Sequence[Array]) -> float:
    """The finest difference, if it is no smaller than the next: then it is not the step's."""
    fine, coarse = (float(np.max(np.abs(b - a))) for a, b in itertools.pairwise(rungs[:3]))
    return fine if fine > FALLS * coarse else 0.0


def _romberg(rungs: Sequence[Array], exponents: Sequence[int]) -> tuple[Array, float]:
    """The limit (N,) for h → 0, and the last minus the last-but-one column."""
    column = list(rungs[: len(exponents) + 1])
    before = column[0]
    for p in exponents:
        before = column[0]
        weight = 2.0**p
        column = [
            (weight * fine - coarse) / (weight - 1) for fine, coarse in itertools.pairwise(column)
        ]
    return column[0], float(np.max(np.abs(column[0] - before)))
