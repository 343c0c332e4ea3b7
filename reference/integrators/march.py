"""The parts that explicit and implicit integrators share: step control, samples, errors.

A method only has to try one step and to judge it.  `march` picks the steps, so that each sample
time is the end of a step (nothing is interpolated), and yields them one by one; `integrate` keeps
the states at the samples.
"""

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .budget import spend
from .slope import EPS, POINTS, Slope, Vector, leaps, noise

SAFETY = 0.8  # aim below the tolerance: on chaotic motion 0.9 has a quarter of the steps refused
SHRINK, GROW = 0.2, 6.0  # one estimate is not trusted to change the step by more than this
FUTILE = 0.5  # an error that falls less than that with a shorter step is no error of the step
ROUNDED = 10.0  # an error row adds up to 8 slopes, each with its rounding
TICKS = 1024  # ulp of the time, of a first step: in a shorter one slopes leap as the clock does
AT_ONCE = 1e-3  # of the interval after it: a shorter first one says nothing of the motion
STRETCH = 0.05  # a step may be this much longer than wanted if that saves a step before a sample


class IntegrationError(RuntimeError):
    """The solution could not be continued; `time` is how far it got."""

    def __init__(self, reason: str, time: float) -> None:
        super().__init__(f"{reason} at t = {time!r}")
        self.time = time


@dataclass(frozen=True)
class Integration:
    """States at the sample times (one row each) and what they cost."""

    y: NDArray[np.float64]
    steps: int
    rejected: int
    evaluations: int


class Step(NamedTuple):
    """One accepted step and the number of attempts refused before it.

    Errors below `floor` times the tolerance are rounding.
    """

    t: float
    y: Vector
    h: float
    t_next: float
    y_next: Vector
    rejected: int
    floor: Vector


class Method(Protocol):
    """A one-step method bound to an equation."""

    f: Slope
    power: float  # the error estimate behaves as h ** (1 / power)
    tolerance: float
    evaluations: int

    def begin(self, t: float, y: Vector) -> Vector:
        """The slope at the start of a step."""
        ...

    def attempt(self, t: float, y: Vector, h: float, peak: Vector) -> Vector:
        """The increment of `y` over a step; not finite if the step failed."""
        ...

    def error(self, size: Vector) -> float:
        """Estimated error of the last attempt; at most 1 is acceptable."""
        ...


def sizes(peak: Vector, tolerance: float) -> Vector:
    """The size each component's error is measured against: the largest value it has taken so far.

    A component that stays small beside the others counts as a hundredth of the largest, and never
    so small that the tolerance falls below their rounding (4 ulp).  1e-300 serves a state at zero.
    """
    share = max(0.01, 4.0 * EPS / tolerance)
    return np.maximum(peak, share * max(peak.tolist()) + 1e-300)


def rms(values: Vector) -> float:
    """Root mean square, by a plain dot product: cheaper than a norm on a few components."""
    flat = values.ravel()
    return math.sqrt(flat.dot(flat) / flat.size)


@dataclass
class _Walker:
    """Where the march stands: `y + low` is the state, `low` holding what rounding cut off `y`."""

    method: Method
    t: float
    y: Vector
    low: Vector
    peak: Vector
    wanted: float
    noise: Vector
    least: Vector  # noise of what is at rest
    ahead: float  # s: in which a slope that begins at zero becomes more than its rounding
    until: float  # s: when it ends, where what begins gently is largest
    quiet: bool = True  # nothing is known of any noise
    begun: bool = False  # a step was accepted

    def start(self) -> None:
        """Listen before a short first step: its error may be rounding and yet acceptable."""
        if self.wanted < self.ahead:
            self._listen(self.wanted)

    def step(self, target: float) -> Step:
        """Take one step towards `target`, landing on it exactly with the last."""
        rejected, before = 0, math.inf
        while True:
            remaining = target - self.t
            pieces = max(1, math.ceil(remaining / self.wanted - STRETCH))
            h = remaining / pieces
            error, tried, problem = self._try(h)
            if not error < math.inf:
                factor = SHRINK
            else:
                factor = SAFETY * error**-self.method.power if error > 0.0 else GROW
                factor = min(1.0 if rejected else GROW, max(SHRINK, factor))
            if error <= 1.0:
                end = target if pieces == 1 else self.t + h
                return self._accept(h, factor, end, tried, rejected)
            rejected += 1
            if rejected > 1 and not error <= FUTILE * before:  # true for NaN
                self._listen(h)
            before = error
            self.wanted = h * min(factor, SAFETY)
            # Below 4 ulp the time no longer advances properly; at t = 0 some other bound is needed.
            if self.wanted < max(4.0 * math.ulp(self.t), 1e-30 * remaining):
                what = "the step size underflows" if error < math.inf else "values are not finite"
                raise IntegrationError(what, self.t) from problem

    def _listen(self, h: float) -> None:
        """Learn the rounding of the slopes: the error did not fall as the step did."""
        with np.errstate(all="ignore"):
            try:
                # A step this short may see no rounding at all.
                ahead = max(h, self.ahead)
                far = h if self.begun else ahead
                if self.quiet or not self.begun:
                    self.least = leaps(self.method.f, self.t, self.y, ahead)
                later = np.abs(self.method.f(self.until, self.y))
                rounding = noise(self.method.f, self.t, self.y, far, self.peak, self.least, later)
            except (ArithmeticError, ValueError):  # too far out, as in an attempt
                return
        self.method.evaluations += POINTS
        if rounding is not None:
            self.noise, self.quiet = rounding, False

    def _floor(self, h: float) -> Vector:
        """The size at which the tolerance is what rounding of the slopes does to a step of h."""
        return ROUNDED * h / self.method.tolerance * self.noise

    def _audible(self, peak: Vector, h: float) -> Vector:
        """The peaks, each at least as large as the floor of rounding."""
        return peak if self.quiet else np.maximum(peak, self._floor(h))

    def _try(self, h: float) -> tuple[float, tuple[Vector, Vector, Vector], Exception | None]:
        try:
            with np.errstate(all="ignore"):  # overflow shows as a step that is not finite
                measured = self._audible(self.peak, h)
                total = self.method.attempt(self.t, self.y, h, measured) + self.low
                y = self.y + total
                peak = np.maximum(self.peak, np.abs(y))
                size = sizes(self._audible(peak, h), self.method.tolerance)
                error = self.method.error(size)
                return error, (y, total - (y - self.y), peak), None
        except (ArithmeticError, ValueError) as problem:  # as of math.exp or math.sqrt, too far out
            return math.inf, (self.y, self.low, self.peak), problem

    def _accept(
        self, h: float, factor: float, t: float, tried: tuple[Vector, Vector, Vector], rejected: int
    ) -> Step:
        y, low, peak = tried
        floor = self.noise if self.quiet else self._floor(h)
        done = Step(self.t, self.y, h, t, y, rejected, floor)
        # A step cut short by a sample says little about how far the method could have gone.
        self.wanted = max(h * factor, self.wanted) if factor == GROW else h * factor
        self.t, self.y, self.low, self.peak = t, y, low, peak
        self.begun = True
        return done


def _first_step(t: float, y: Vector, slope: Vector, size: Vector, span: float) -> float:
    """A hundredth of the time in which the state changes by its own size, if that says anything."""
    with np.errstate(all="ignore"):
        value, rate = rms(y / size), rms(slope / size)
    if value == 0.0 or not 0.0 < rate < math.inf:
        return 1e-3 * span
    return min(span, max(0.01 * value / rate, TICKS * math.ulp(t)))


def span(samples: Sequence[float]) -> float:
    """The first interval [s]; the second one, where the first ends at once.

    A motion that begins anew just before a sample need not take steps as short as what is left.
    """
    first, *more = np.diff(samples[:3]).tolist()
    return max([first, *(span for span in more if first < AT_ONCE * span)])


def march(
    method: Method,
    times: ArrayLike,
    y0: ArrayLike,
    *,
    most: int = 100_000_000,
    anew: bool = False,
) -> Iterator[Step]:
    """The accepted steps from `times[0]` to `times[-1]`; every sample time ends one of them.

    anew: y0 is what another motion has left, and its size may say nothing of what comes.
    """
    grid, y = np.array(times, dtype=np.float64), np.array(y0, dtype=np.float64)
    if grid.ndim != 1 or not grid.size or not np.isfinite(grid).all() or (np.diff(grid) <= 0).any():
        raise ValueError("the sample times must be finite and strictly increasing")
    if y.ndim != 1 or not y.size:
        raise ValueError("the initial state must be a vector")
    samples: list[float] = grid.tolist()
    slope = method.begin(samples[0], y)
    if not (np.isfinite(y).all() and np.isfinite(slope).all()):
        raise IntegrationError("values are not finite", samples[0])
    if len(samples) == 1:
        return
    size = sizes(np.abs(y), method.tolerance)
    first = _first_step(samples[0], y, slope, size, span(samples))
    none = np.zeros_like(y)
    ahead = AT_ONCE * span(samples)
    walker = _Walker(method, samples[0], y, none, np.abs(y), first, none, none, ahead, samples[-1])
    if anew:
        walker.start()
    taken = 0
    for target in samples[1:]:
        while walker.t < target:
            if taken == most:
                raise IntegrationError(f"more than {most} steps", walker.t)
            taken += 1
            step = walker.step(target)
            spend(walker.t)
            yield step


def integrate(method: Method, times: ArrayLike, y0: ArrayLike, *, most: int) -> Integration:
    """March through the samples and keep the states there."""
    samples: list[float] = np.array(times, dtype=np.float64).tolist()
    rows = [np.array(y0, dtype=np.float64)]
    steps = rejected = 0
    for step in march(method, times, y0, most=most):
        steps += 1
        rejected += step.rejected
        if step.t_next == samples[len(rows)]:
            rows.append(step.y_next)
    return Integration(np.array(rows), steps, rejected, method.evaluations)
