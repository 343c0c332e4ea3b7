"""The size of a difference between two motions, and the floor below which it means nothing."""

from dataclasses import dataclass

import numpy as np

from ...cases.trajectory import Array

ROUNDING = 2.2e-16


@dataclass(frozen=True)
class Error:
    """A difference over the samples: its largest, its root mean square, and the last one."""

    largest: float
    rms: float
    final: float


def error(samples: Array, reference: Array) -> Error:
    """Of samples (N,) against the reference (N,)."""
    d = np.abs(samples - reference)
    return Error(float(np.max(d)), float(np.sqrt(np.mean(d * d))), float(d[-1]))


def floor(size: float, steps: float) -> float:
    """What rounding alone can make of a number of this size in so many steps."""
    return ROUNDING * size * steps
