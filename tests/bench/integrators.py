"""Compares the reference's integrators with the best of scipy's: CPU time to the same error."""

import math
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import partial
from typing import Literal

import numpy as np
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.cases.trajectory import Array
from textmech.reference.integrators.march import integrate
from textmech.reference.motion.follow import either
from textmech.reference.motion.stuck import slope
from textmech.reference.system import Mode
from textmech.reference.systems import SYSTEMS
from textmech.reports.batch.selection import choose_cases

from .turns import Ratio, Work, ratio, turns

ERRORS = {  # of the case, in its units: what all methods but the slowest reach
    "double_pendulum": 1e-9,
    "four_bar": 1e-9,
    "rhombus": 1e-9,
    "dynamometer_smooth": 1e-8,  # the stiff one
}
Method = Callable[[float], Array]
Name = Literal["DOP853", "LSODA", "Radau"]

SCIPYS: tuple[Name, ...] = ("DOP853", "LSODA", "Radau")
TOLERANCES = tuple(10.0**-k for k in range(6, 14))  # scipy takes none below 1e-13
HOPELESS = 4  # times as long as ours at a looser tolerance: it is not the best
MOST = 1_000_000  # steps


@dataclass(frozen=True)
class Compared:
    """ours: CPU seconds to the error; best: the fastest of scipy's methods that reach it."""

    case: str
    error: float
    ours: float
    best: str
    ratio: Ratio | None


def compared(rounds: int) -> Iterator[Compared]:
    """The four cases."""
    for name, error in ERRORS.items():
        yield _compared(choose_cases([name])[0], error, rounds)


def _compared(case: Case, error: float, rounds: int) -> Compared:
    assert case.system
    mode = SYSTEMS[case.system](**case.parameters)
    assert isinstance(mode, Mode)
    f, y0 = slope(mode), np.concatenate(mode.start())

    def ours(tolerance: float) -> Array:
        method = either(mode, f, len(y0), tolerance=tolerance)
        return integrate(method, case.times, y0, most=MOST).y

    def scipys(name: Name, tolerance: float) -> Array:
        span = (0.0, case.duration)
        return solve_ivp(f, span, y0, name, case.times, rtol=tolerance, atol=tolerance).y.T

    truth = ours(TOLERANCES[-1] / 100)
    own = bracket(ours, truth, error)
    if own is None:
        return Compared(case.name, error, math.nan, "ours does not reach it", None)
    methods = {name: partial(scipys, name) for name in SCIPYS}
    patience = HOPELESS * own.seconds
    found = {name: bracket(by, truth, error, patience) for name, by in methods.items()}
    reached = {name: b for name, b in found.items() if b is not None}
    works = [
        partial(_at, by, tolerance)
        for by, b in ((ours, own), *((methods[name], b) for name, b in reached.items()))
        for tolerance in (b.loose, b.tight)
    ]
    pairs = np.log(turns(works, rounds)).reshape(-1, 2, rounds)
    weights = np.array([b.weight for b in (own, *reached.values())])[:, None]
    seconds = np.exp((1 - weights) * pairs[:, 0] + weights * pairs[:, 1])
    medians = np.median(seconds, axis=1)
    if not reached:
        return Compared(case.name, error, float(medians[0]), "none of scipy's reaches it", None)
    fastest = int(np.argmin(medians[1:]))
    against = ratio(seconds[0], seconds[1 + fastest])
    return Compared(case.name, error, float(medians[0]), list(reached)[fastest], against)


def _at(method: Method, tolerance: float, k: int) -> Work:
    return lambda: method(tolerance)


@dataclass(frozen=True)
class Bracket:
    """Neighbouring tolerances, and where between their errors, as logarithms, the wanted one lies.

    seconds: what the tighter took.
    """

    loose: float
    tight: float
    weight: float
    seconds: float


def bracket(
    method: Method, truth: Array, error: float, patience: float = math.inf
) -> Bracket | None:
    """Where a method comes to the error; None if it does not, or takes longer than the patience."""
    before = (TOLERANCES[0], error)
    for tolerance in TOLERANCES:
        started = time.process_time()
        reached = max(float(np.max(np.abs(method(tolerance) - truth))), math.ulp(0.0))
        seconds = time.process_time() - started
        if reached <= error:
            loose, far = before
            span = math.log(reached / far)
            return Bracket(loose, tolerance, math.log(error / far) / span if span else 1.0, seconds)
        if seconds > patience:
            return None
        before = (tolerance, reached)
    return None
