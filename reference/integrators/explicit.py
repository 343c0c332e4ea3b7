"""The explicit integrator: Dormand and Prince, order 8, error control 8(5,3).

Its slopes are usually cheap plain Python, so the work around each of them is kept to one product
of a row with a matrix.
"""

import math

import numpy as np
from numpy.typing import ArrayLike

from .dop853 import DOP853, STAGES, Table
from .march import EPS, Integration, Slope, Vector, integrate


class DormandPrince:
    """One equation bound to the method, with the room its stages need."""

    power = 1.0 / 8.0

    def __init__(self, f: Slope, n: int, tolerance: float, table: Table = DOP853) -> None:
        if not 0.0 < tolerance < 1.0:
            raise ValueError("the tolerance must lie between 0 and 1")
        self.f = f
        self.tolerance = max(tolerance, 4.0 * EPS)
        self.evaluations = 0
        self._from: Vector | None = None
        self._h = 0.0
        self._errors = np.zeros((2, n))
        # Row 0 is the state and the slopes follow; with weight 1 on row 0 and h a[i] on the rest a
        # stage is a single product.
        self._rows = np.zeros((STAGES + 1, n))
        self._k = self._rows[1:]
        self._a = table.a
        self._weights = np.ones((STAGES, STAGES + 1))
        self._scaled = self._weights[:, 1:]
        self._results = np.array([table.b, table.e5, table.e3])
        self._stages = [
            (float(table.c[i]), self._weights[i, : i + 1], self._rows[: i + 1], self._k[i])
            for i in range(1, STAGES)
        ]

    def begin(self, t: float, y: Vector) -> Vector:
        """Slope at the start; kept for as long as attempts start from this same array."""
        self._from = y
        self._rows[0] = y
        self._k[0] = self.f(t, y)
        self.evaluations += 1
        return self._k[0]

    def attempt(self, t: float, y: Vector, h: float, peak: Vector) -> Vector:
        """Run the stages; the increment and both error rows come from one product."""
        if y is not self._from:
            self.begin(t, y)
        f = self.f
        np.multiply(self._a, h, out=self._scaled)
        for c, weights, rows, k in self._stages:
            k[:] = f(t + c * h, weights.dot(rows))
        self.evaluations += STAGES - 1
        results = self._results.dot(self._k)
        self._errors = results[1:]
        self._h = h
        return results[0] * h

    def error(self, size: Vector) -> float:
        """Hairer's mixture: the order 5 estimate, lowered by its ratio to the order 3 one.

        The mixture behaves as h ** 8, and rounding in the order 5 estimate is damped along with it.
        """
        scaled = self._errors / size
        five, three = scaled[0], scaled[1]
        fifth, third = float(five.dot(five)), float(three.dot(three))
        if fifth == 0.0:
            return 0.0
        # 0.01 is the square of the published 0.1 that weights the lower estimate.
        mixed = fifth / math.sqrt((fifth + 0.01 * third) * five.size)
        return self._h * mixed / self.tolerance


def dormand_prince(
    f: Slope, times: ArrayLike, y0: ArrayLike, *, tolerance: float = 1e-13, most: int = 1_000_000
) -> Integration:
    """Integrate y' = f(t, y) through `times`, starting from `y0` at `times[0]`."""
    method = DormandPrince(f, np.size(y0), tolerance)
    return integrate(method, times, y0, most=most)


def dormand_prince_step(
    f: Slope, t: float, y: Vector, h: float, *, table: Table = DOP853
) -> Vector:
    """The state after one step of exactly `h`, whatever its error."""
    method = DormandPrince(f, len(y), EPS, table)
    return y + method.attempt(t, y, h, np.abs(y))
