"""A motion that repeats itself: the fixed point of its return map, by Newton's method.

The map leads from the state after an event to the state after the next one of its kind.
"""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from ..system import Array

Map = Callable[[Array], Array]
"""A state (n,) on the section → the next one."""

TURNS = 30  # of Newton's method; from a guess that is 10 % off it takes six
RAW = 1e-4  # of the state's size: how far it is moved for a derivative that is good to 1e-7
# The same for a central difference of eighth order. Of two walkers, whose maps are steep where they
# are about to stumble, 1e-3 is off by 5e-12 and 2e-10, 5e-4 by 1e-11; rounding is 3e-12.
FINE = 2.5e-4
STENCIL = ((1, 4 / 5), (2, -1 / 5), (3, 4 / 105), (4, -1 / 280))
ENDS = 1e-13  # of the state's size: steps that only rounding makes


class NoCycle(ArithmeticError):
    """Where Newton's method finds no fixed point."""


@dataclass(frozen=True)
class Cycle:
    """The fixed point (n,), how far the map leads away from it, and its multipliers (n,).

    By size, the largest first: below 1 a disturbance dies away.
    """

    state: Array
    error: float
    multipliers: NDArray[np.complex128]

    @property
    def stable(self) -> bool:
        """Whether all disturbances die away."""
        return bool(np.abs(self.multipliers[0]) < 1.0)


def cycle(step: Map, guess: Array) -> Cycle:
    """The fixed point near the guess. Raises NoCycle."""
    x = np.array(guess, dtype=np.float64)
    change = np.full(len(x), np.inf)
    for _ in range(TURNS):
        change[:] = np.linalg.solve(np.eye(len(x)) - _raw(step, x), step(x) - x)
        x += change
        if np.max(np.abs(change)) <= ENDS * np.max(np.abs(x)):
            values = np.linalg.eigvals(derivative(step, x)).astype(complex)
            order = np.argsort(-np.abs(values))
            return Cycle(x, float(np.max(np.abs(step(x) - x))), values[order])
    raise NoCycle(f"no cycle near {guess}: the last step was still {np.max(np.abs(change)):.2g}")


def derivative(step: Map, x: Array, *, part: float = FINE) -> Array:
    """∂ step/∂x (n, n) by a difference of eighth order; part: of the state's size."""
    columns = []
    for h in np.eye(len(x)) * part * np.max(np.abs(x)):
        both = [weight * (step(x + k * h) - step(x - k * h)) for k, weight in STENCIL]
        columns.append(np.sum(both, axis=0) / np.max(h))
    return np.array(columns).T


def _raw(step: Map, x: Array) -> Array:
    """∂ step/∂x (n, n) by a plain difference, which is enough for Newton's method."""
    columns = []
    for h in np.eye(len(x)) * RAW * np.max(np.abs(x)):
        columns.append((step(x + h) - step(x - h)) / (2 * np.max(h)))
    return np.array(columns).T
