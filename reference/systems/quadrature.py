"""Integrals of smooth known functions: what closed forms need where a path has no primitive."""

from collections.abc import Callable
from typing import Any

import numpy as np
from scipy.special import roots_legendre

from ..system import Array

NODES, WEIGHTS = roots_legendre(16)
Function = Callable[[Array], Any]


def integral(f: Function, to: float | Array, panels: int) -> Any:
    """∫₀ᵗ f ds, for each t of `to`, by Gauss and Legendre on equal panels: exact to 31st degree."""
    half = np.asarray(to)[..., None, None] / (2 * panels)
    middles = 2 * np.arange(panels)[:, None] + 1
    return np.sum(f(half * (middles + NODES)) * WEIGHTS * half, axis=(-2, -1))
