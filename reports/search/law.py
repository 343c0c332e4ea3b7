"""How an error follows one number: a power law, where there is one."""

from collections.abc import Mapping

import numpy as np

FEWEST, MOST = 3, 5  # values of the number, the finest of those that are known
FITS = 0.1  # of each error: how far it may be off the line
FLAT = 0.05  # of a power: below it the number makes no difference


def law(name: str, errors: Mapping[float, float]) -> str:
    """`h^2`, `impratio^-1`: the slope of log error over log number; nothing where none fits.

    errors: by the number, in the order in which a cure is approached.
    """
    x, y = np.array(list(errors)[-MOST:]), np.array(list(errors.values())[-MOST:])
    if len(x) < FEWEST or not np.all(np.isfinite(y)) or np.any(x <= 0) or np.any(y <= 0):
        return ""
    power, factor = np.polyfit(np.log(x), np.log(y), 1)
    off = np.abs(np.exp(factor) * x**power / y - 1)
    return f"{name}^{power:.2g}" if abs(power) >= FLAT and np.all(off <= FITS) else ""
