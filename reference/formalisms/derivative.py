"""Derivatives by the complex step: exact to rounding, no difference of near numbers.

It fails silently (derivative 0) where a function drops the imaginary part, so real results are
refused; functions with abs, norm, hypot, sign, max or conjugates must not come here.
"""

from collections.abc import Callable
from typing import Any

import numpy as np

EPS = 1e-30  # far below rounding: f(x) itself is untouched, and eps² never shows


def along(function: Callable[..., Any], at: tuple[Any, ...], direction: tuple[Any, ...]) -> Any:
    """d/ds function(at + s direction) at s = 0, for any number of array arguments.

    Raises TypeError if the function answers with a real number: it lost the derivative.
    """
    shifted = [np.asarray(a) + 1j * EPS * np.asarray(d) for a, d in zip(at, direction, strict=True)]
    result = np.asarray(function(*shifted))
    if not np.iscomplexobj(result):
        raise TypeError(f"{function} lost its complex step: its result is real")
    return np.imag(result) / EPS


def gradient(function: Callable[[Any], Any], at: Any) -> Any:
    """(..., n): the derivatives by each entry of the vector `at`, in the last axis."""
    return np.stack([along(function, (at,), (unit,)) for unit in np.eye(len(at))], axis=-1)
