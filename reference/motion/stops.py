"""Where steps end: at samples, at corners of what is given in time, and often enough."""

import math
from collections.abc import Callable, Iterable
from typing import Any

import numpy as np

from ..system import Array
from .crossing import TOGETHER

AT_ONCE = 256  # ulp: in so little time a force that grows from zero is nothing but rounding
Timed = Callable[[float, Array], Any]
"""(t, y) → a slope, or what guards a mode."""


def stops(now: float, samples: Array, corner: float, longest: float | None) -> Array:
    """Now and the samples to come up to the corner, and times between them, none `longest` [s]
    after the one before."""
    last = min(corner, samples[-1])
    found = np.array([now, *samples[(samples > now) & (samples < last)], last])
    if longest is None:
        return found
    pieces = np.ceil(np.diff(found) / longest).astype(int)
    spans = zip(found[:-1], found[1:], pieces, strict=True)
    between = [np.linspace(a, b, n, endpoint=False) for a, b, n in spans]
    return np.append(np.concatenate(between), found[-1])


def on_samples(corners: Iterable[float], samples: Array) -> list[float]:
    """The corners in their order; one that is a sample but for rounding is that sample."""
    found = []
    for corner in sorted(set(corners)):
        near = float(samples[np.argmin(np.abs(samples - corner))])
        found.append(near if abs(near - corner) <= TOGETHER else corner)
    return found


def on_sample(t: float, samples: Array) -> float:
    """The time of an event, or the sample that comes at once: no step leads there."""
    ahead = samples[samples >= t][:1].tolist()
    return next((sample for sample in ahead if sample - t <= AT_ONCE * math.ulp(sample)), t)


def between(passed: float, corner: float) -> Callable[[Timed], Timed]:
    """A function of t, y as it is between two corners: at the second it may jump."""
    if passed == -math.inf and corner == math.inf:
        return lambda g: g
    last = math.nextafter(corner, -math.inf)
    return lambda g: lambda t, y: g(min(max(t, passed), last), y)
