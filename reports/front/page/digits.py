"""Rounds numbers to the digits that a picture shows; the page's gzip packs what is left of them."""

import math

import numpy as np

from ....cases.trajectory import Array

CURVE, POSE = 4, 6  # digits of a range: a hundred turns in four would be seen to jump
NARROWEST = 1e-12  # of the numbers themselves: a narrower range is rounding's
LARGEST = 300  # decimals: a double has no larger power of ten
ERROR = 3  # significant digits of an error, which is drawn over decades


def few_digits(numbers: Array, digits: int = CURVE) -> list[float]:
    """Returns numbers (N,) to so many digits of their range. Raises ValueError of nan and inf."""
    _check_finite(numbers)
    span = max(float(np.ptp(numbers)), NARROWEST * float(np.max(np.abs(numbers)))) or 1.0
    decimals = min(digits - math.ceil(math.log10(span)), LARGEST)
    return (np.round(numbers, decimals) + 0.0).tolist()  # no minus zero


def few_digits_of_each(errors: Array) -> list[float]:
    """Returns errors (N,), each to ERROR significant digits. Raises ValueError of nan and inf."""
    _check_finite(errors)
    return [float(f"{error:.{ERROR}g}") for error in errors.tolist()]


def _check_finite(numbers: Array) -> None:
    if not np.all(np.isfinite(numbers)):
        raise ValueError("a number that is not finite cannot be drawn")
