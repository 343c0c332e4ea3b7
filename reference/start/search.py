"""The search for the start, in the plane and in space: Newton's method from many guesses.

Residuals are counted in rad and in the mechanism's size, so that a watch and a crane are alike.
"""

from collections.abc import Callable, Iterable, Sequence
from typing import Any, Protocol

import numpy as np
from numpy.typing import NDArray

from ..system import Array

CLOSED = 1e-12  # residual in sizes or rad; Newton reaches rounding or fails
RANK = 1e-9  # singular values below this part of the largest count as zero
DEAD = 1e-5  # and below this, a rounding of 1e-16 already moves the start by more than 1e-11
SAME = 1e-6  # solutions nearer than this (in sizes and rad) are the same one
NEAR = 0.5  # rad or sizes: of ways this close to `near` only nearer ones are looked for
BESIDE = 20  # starts around it: two ways this close to each other draw about as many each
FAR = np.pi / 2  # rad, or as many sizes: what `near` says and is so far off, is a mistake
STEPS = 50  # of Newton: quadratic, more only where nothing closes
LONGEST = 1.0  # size or rad in one step
NO_STEP = 1e-16  # of sizes and rad


class Closing(Protocol):
    """The equations of a start. free: the columns that nothing gives. units: of the rates.

    rounding: of places, in sizes.
    """

    free: NDArray[np.intp]
    units: Array
    rounding: float

    def equations(self, q: Array) -> tuple[Array, Array]:
        """Residuals (k,) in sizes or rad, and their rows (k, n) in these units."""
        ...

    def moved(self, q: Array, change: Array) -> Array:
        """q after a small change (n,)."""
        ...

    def settled(self, q: Array) -> Array:
        """q with its angles on the turns on which a start has them."""
        ...

    def difference(self, a: Array, b: Array) -> float:
        """The largest difference of two solutions, in sizes and rad."""
        ...


def search(
    closure: Closing,
    guesses: Callable[[list[Array]], Iterable[Array]],
    accepts: Callable[[Array], bool] = lambda q: True,
) -> tuple[list[Array], tuple[float, Array]]:
    """Every way that was found from the guesses, and of all that they led to the nearest to one.

    guesses: may ask what has been found. accepts: whether a solution of the equations is a way.
    """
    ways: list[Array] = []
    nearest: tuple[float, Array] | None = None
    for guess in guesses(ways):
        q, gap = newton(closure, guess)
        if nearest is None or gap < nearest[0]:
            nearest = gap, q
        closes = gap < CLOSED * closure.rounding and accepts(q)
        if closes and all(closure.difference(q, other) > SAME for other in ways):
            ways.append(q)
    assert nearest is not None
    return ways, nearest


def least_of(ways: Sequence[Array], sizes: Sequence[float], same: float) -> list[Array]:
    """The ways of the smallest size, up to what is the same."""
    return [q for q, size in zip(ways, sizes, strict=True) if size < min(sizes) + same]


def newton(closure: Closing, q: Array) -> tuple[Array, float]:
    """The root near the guess, and the residual that is left, in sizes or rad."""
    for _ in range(STEPS):
        with np.errstate(divide="ignore", invalid="ignore"):  # of a rim that lies flat
            residual, rows = closure.equations(q)
        if not np.all(np.isfinite(residual)):
            return q, np.inf
        gap = float(np.max(np.abs(residual), initial=0.0))
        if gap < 1e-3 * CLOSED * closure.rounding or not len(closure.free):
            break
        change = least(rows[:, closure.free], residual)
        largest = float(np.max(np.abs(change), initial=0.0))
        if largest < NO_STEP:
            break
        step = np.zeros(len(closure.units))
        step[closure.free] = -change * min(1.0, LONGEST / largest)
        q = closure.moved(q, closure.units * step)
    residual, _ = closure.equations(q)
    return closure.settled(q), float(np.max(np.abs(residual), initial=0.0))


def least(rows: Array, right: Array) -> Array:
    """(n,) the smallest solution of rows · x = right, or what comes nearest to one."""
    solution: Any = np.linalg.lstsq(rows, right, rcond=RANK)[0]
    return solution


def null(rows: Array, n: int, below: float = RANK) -> Array:
    """(k, n) directions that the rows leave open; singular values `below` count as zero."""
    if not rows.size:
        return np.eye(n)
    _, s, vt = np.linalg.svd(rows)
    return vt[int(np.sum(s > below * s[0])) :]


def rank(rows: Array, below: float = RANK) -> int:
    """The number of singular values that are not zero: `below` of the largest."""
    if not rows.size:
        return 0
    s = np.linalg.svd(rows, compute_uv=False)
    return int(np.sum(s > below * s[0]))
