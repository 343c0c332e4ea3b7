"""Judges a ladder of steps h, 2h, 4h, …: order, limit for h → 0, verdict, usable step.

The order is that of neighbouring differences u(2h) − u(h), never of errors: a model's error would
hide it. The limit is Romberg's, with the exponents that the engine's setting declares. Where that
does not settle, the errors themselves may still fall with the step, and are told to.
"""

import itertools
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ....cases.trajectory import Array
from ...tables.row import ANOTHER, EXACT, FALLS, INSTANTS, STAYS, TEXTBOOK, UNSETTLED, WITHIN
from . import metric

TEXTBOOK_WITHIN = 3.0  # uncertainties between limit and reference
TEXTBOOK_BELOW = 1e-6  # of `allow`: nobody can use so small a difference
ANOTHER_BEYOND = 4.0
NOISE = 0.7  # a halved step halves a difference of first order; noise keeps it
FEWEST = 3  # samples away from events, or they say nothing of a motion
GROWN = 2.0  # two differences of noise: drawn, 0.3 % of 26 samples and 7 % of five exceed it
FAR = 100  # differences: what is further off is not reached by what they grow to
CLEAR = 0.5  # by what the last three orders of the errors' size may differ
SLOWEST = 0.25  # the least order of a size that falls at every halving: half in four of them
FALLEN = 2.0  # the factor by which errors fall over a ladder, or within which they stay
LAST = 3  # orders are the last three's
TOLD = 30  # floors: below them an order's second digit is rounding's

Orders = tuple[float | None, float | None, float | None]
"""The finest order, the least and the largest; or none."""
NO_ORDER: Orders = (None, None, None)


@dataclass(frozen=True)
class Convergence:
    """One quantity on one ladder: errors by step, smallest first, and what they say.

    The order is that of the differences, or where the verdict is `falls`, of the errors' size.
    Without either there is none.
    """

    verdict: str
    errors: Mapping[float, float]
    usable_step: float | None  # the largest rung from which on the error stays within `allow`
    order: float | None = None
    order_low: float | None = None
    order_high: float | None = None
    limit: float | None = None  # largest |limit − reference|
    uncertainty: float | None = None


def study(
    ladder: Mapping[float, Array],
    reference: Array,
    *,
    exponents: Sequence[int],
    allow: float,
    floor: float,
    away: NDArray[np.bool_] | None = None,
    behind: NDArray[np.bool_] | None = None,
) -> Convergence:
    """Judges samples (N,) by step; the steps double from the smallest on.

    floor: the difference that rounding alone can make at the smallest step. away: the samples that
    are away from events, of which alone order and limit are taken: beside an event a sample is
    before it on one rung and after it on the next. behind: the samples that follow an event.
    """
    steps = sorted(ladder)
    errors = {h: metric.largest(ladder[h] - reference) for h in steps}
    usable = _usable(errors, allow)
    if errors[steps[0]] <= floor:
        exactly = metric.round_up_to_floor(0.0, floor)
        return Convergence(EXACT, errors, usable, limit=0.0, uncertainty=exactly)
    keep = np.ones(len(reference), dtype=bool) if away is None else away
    if np.count_nonzero(keep) < FEWEST:
        return Convergence(UNSETTLED, errors, usable)
    rungs, reference = [ladder[h][keep] for h in steps], reference[keep]
    size = _Size([metric.largest(rung - reference) for rung in rungs])
    if size.verdict == UNSETTLED:
        size = _Size(list(errors.values()))  # what is beside events may fall all the same
    if len(steps) < max(FEWEST, len(exponents) + 1) or not exponents:
        return Convergence(size.verdict, errors, usable, *size.orders)
    value, uncertainty = _romberg(rungs, exponents)
    enlarged = floor * _amplified(exponents)
    uncertainty = max(uncertainty, enlarged, _noise(rungs))
    off = metric.largest(value - reference)
    settled = _settled(off, uncertainty, allow)
    remainder = _slow_remainder(rungs, exponents[0])
    doubt = max(remainder, 0.0 if behind is None else _lateness(rungs, behind[keep]))
    if settled == TEXTBOOK and remainder > metric.OF_ALLOW * allow:
        settled, uncertainty = None, max(uncertainty, remainder)
    doubt = max(doubt, _growth(rungs, size.sizes, off))
    if settled in (WITHIN, ANOTHER) and off <= ANOTHER_BEYOND * doubt:
        settled, uncertainty = None, max(uncertainty, doubt)
    limit = metric.round_to_floor(off, enlarged), metric.round_up_to_floor(uncertainty, enlarged)
    if settled is None:
        return Convergence(size.verdict, errors, usable, *size.orders, *limit)
    orders = NO_ORDER if _noise(rungs) else _order_range(_orders(rungs, TOLD * floor))
    return Convergence(settled, errors, usable, *orders, *limit)


def instants(errors: Mapping[float, float], allow: float) -> Convergence:
    """The convergence of events' errors by step; inf where they happen more or less often."""
    return Convergence(INSTANTS, errors, _usable(errors, allow))


def _usable(errors: Mapping[float, float], allow: float) -> float | None:
    usable = None
    for h in sorted(errors):
        if not errors[h] <= allow:
            break
        usable = h
    return usable


def _amplified(exponents: Sequence[int]) -> float:
    """Returns the factor by which Romberg's columns with these exponents enlarge rounding."""
    return math.prod((2.0**p + 1) / (2.0**p - 1) for p in exponents)


def _settled(off: float, uncertainty: float, allow: float) -> str | None:
    """The verdict of a limit that is `off` the reference, or None where it tells nothing."""
    near = off <= TEXTBOOK_WITHIN * uncertainty or off <= TEXTBOOK_BELOW * allow
    if near and uncertainty <= metric.OF_ALLOW * allow:
        return TEXTBOOK
    if off > ANOTHER_BEYOND * uncertainty:
        return WITHIN if off <= allow else ANOTHER
    return None


def _slow_remainder(rungs: Sequence[Array], declared: int) -> float:
    """Bounds the finest rung's distance to its limit where errors fall more slowly than declared.

    As those of a solver that is stopped too soon, or of an engine that is late, do: as much is left
    as the differences would still sum up to.
    """
    last, before = (metric.largest(b - a) for a, b in itertools.pairwise(rungs[:3]))
    slowly = last < before < 2.0 ** (declared - CLEAR) * last
    return last**2 / (before - last) if slowly else 0.0


def _lateness(rungs: Sequence[Array], behind: NDArray[np.bool_]) -> float:
    """Bounds the finest rung's distance to its limit behind an event, where no order shows it.

    An engine that sees it at the end of a step is late by what is left of that step, and on h, 2h,
    4h … these parts may differ by whole steps, and still all be short of one by the same.
    """
    return float(np.max(metric.sizes(rungs[1] - rungs[0])[behind], initial=0.0))


def _growth(rungs: Sequence[Array], sizes: Sequence[float], off: float) -> float:
    """Bounds the finest rung's distance to its limit where differences grow as the step falls.

    As where a fast turn is damped away on all coarse rungs: they are off by the same, and only
    where the step begins to resolve it the error begins to fall, ever faster.
    """
    fine, coarse = (metric.largest(b - a) for a, b in itertools.pairwise(rungs[:3]))
    finest, finer, coarser = sizes[:3]
    faster = fine > coarse and finer - finest > coarser - finer > 0.0
    grows = fine > GROWN * coarse or faster
    return off if grows and off <= FAR * fine else 0.0


@dataclass(frozen=True)
class _Size:
    """The largest errors alone, by step, smallest first: what they say without a limit."""

    sizes: Sequence[float]

    @property
    def orders(self) -> Orders:
        """log₂ of the ratios of neighbouring errors, where the last three are clear."""
        if len(self.sizes) <= LAST or not all(size > 0 for size in self.sizes):
            return NO_ORDER
        last = [math.log2(b / a) for a, b in itertools.pairwise(self.sizes)][:LAST]
        clear = min(last) >= SLOWEST and max(last) - min(last) <= CLEAR
        return _order_range(last) if clear else NO_ORDER

    @property
    def verdict(self) -> str:
        """Whether they fall, or stay what they are, on all of the ladder."""
        if len(self.sizes) <= LAST:
            return UNSETTLED
        finest, coarsest = self.sizes[0], self.sizes[-1]
        falls = finest <= min(self.sizes) and FALLEN * finest <= coarsest
        if falls or self.orders != NO_ORDER:
            return FALLS
        return STAYS if max(self.sizes) <= FALLEN * min(self.sizes) else UNSETTLED


def _order_range(orders: Sequence[float]) -> Orders:
    """Returns the finest of the orders, the least and the largest."""
    return (orders[0], min(orders), max(orders)) if orders else NO_ORDER


def _orders(rungs: Sequence[Array], floor: float) -> list[float]:
    """log₂ of the ratios of neighbouring differences, the last three, finest first.

    Coarse rungs that are the same to the last bit have none, as before an impact.
    """
    d = [metric.largest(b - a) for a, b in itertools.pairwise(rungs)]
    pairs = itertools.pairwise(d)
    return [math.log2(coarse / fine) for fine, coarse in pairs if fine > floor and coarse][:LAST]


def _noise(rungs: Sequence[Array]) -> float:
    """The finest difference, if it is no smaller than the next: then it is not the step's."""
    fine, coarse = (metric.largest(b - a) for a, b in itertools.pairwise(rungs[:3]))
    return fine if fine > NOISE * coarse else 0.0


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
    return column[0], metric.largest(column[0] - before)
