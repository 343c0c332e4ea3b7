"""The size of a difference between two motions, where it is largest, and its digits."""

import math
from dataclasses import dataclass

import numpy as np

from ....cases.trajectory import Array

AS_LARGE = 0.999  # of the largest: a constant error is largest at its first sample, not at a random


@dataclass(frozen=True)
class Error:
    """A difference over the samples: its largest, its root mean square, and the last one."""

    largest: float
    rms: float
    final: float
    at: int  # the first sample where it is the largest, to three digits


def error(samples: Array, reference: Array) -> Error:
    """The error of samples (N,) against the reference (N,); for attitudes (N, 3) each."""
    d = sizes(samples - reference)
    largest = float(np.max(d))
    first = int(np.argmax(~(d < AS_LARGE * largest)))  # of NaN nothing is smaller
    return Error(largest, float(np.sqrt(np.mean(d * d))), float(d[-1]), first)


def sizes(d: Array) -> Array:
    """(N,) of differences (N,), or of turns (N, 3) the angles."""
    return np.abs(d) if d.ndim == 1 else np.linalg.norm(d, axis=1)


def largest(d: Array) -> float:
    """The largest of them."""
    return float(np.max(sizes(d)))


def round_to_floor(number: float, floor: float) -> float:
    """The number to the digits above the floor's power of ten; below it 0."""
    if not (math.isfinite(number) and 0 < floor < math.inf):
        return number
    return round(number, _digits(floor)) + 0.0  # a zero has no sign: rounding alone decides it


def round_up_to_floor(number: float, floor: float) -> float:
    """The number to the digits above the floor, but never less than one unit of the last digit."""
    return (
        round_to_floor(max(number, 10.0 ** -_digits(floor)), floor)
        if 0 < floor < math.inf
        else number
    )


def _digits(floor: float) -> int:
    return -math.ceil(math.log10(floor))
