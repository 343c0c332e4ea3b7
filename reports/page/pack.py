"""Numbers as letters: twelve bits each, two letters of an alphabet that no markup knows.

A picture has some hundred points across, so 4096 levels are more than it shows; as decimal digits
the same curves would be three times as long.
"""

from collections.abc import Sequence

import numpy as np

from ...cases.trajectory import Array

LETTERS = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_"
BASE = len(LETTERS)
LEVELS = BASE**2
DIGITS = 6  # of the ends of a range: more would be other digits on another machine

Packed = tuple[float, float, str]
"""The number of level 0, what a level is, and two letters a number."""


def packed(numbers: Array) -> Packed:
    """Over the range of the numbers (N,). Raises ValueError where one is not finite."""
    return _between(numbers, float(np.min(numbers)), float(np.max(numbers)))


def packed_around_zero(numbers: Array) -> Packed:
    """Over a range around zero, which has a level of its own: an error of 0 stays 0."""
    largest = float(np.max(np.abs(numbers), initial=0.0))
    step = _few(2 * largest / (LEVELS - 2))
    return _levels(numbers, -step * (LEVELS // 2), step)  # a power of two: nothing is rounded


def unpacked(found: Sequence[float | str]) -> Array:
    """(N,) to within half a level."""
    low, step, letters = found
    places = np.array([LETTERS.index(letter) for letter in str(letters)], dtype=np.int64)
    levels = (places[0::2] * BASE + places[1::2]).astype(np.float64)
    return float(low) + float(step) * levels


def _between(numbers: Array, low: float, high: float) -> Packed:
    return _levels(numbers, _few(low), _few((high - low) / (LEVELS - 1)))


def _levels(numbers: Array, low: float, step: float) -> Packed:
    if not np.all(np.isfinite(numbers)):
        raise ValueError("a number that is not finite has no level")
    levels = np.zeros(len(numbers)) if step == 0.0 else np.round((numbers - low) / step)
    levels = np.clip(levels, 0, LEVELS - 1).astype(np.int64)
    return low, step, "".join(LETTERS[k // BASE] + LETTERS[k % BASE] for k in levels.tolist())


def _few(number: float) -> float:
    return float(f"{number:.{DIGITS}g}")
