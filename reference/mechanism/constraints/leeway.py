"""The forces that equilibrium leaves open: all that the laws allow, by linear programmes.

Forces are one + z₁ way₁ + …: each way exerts nothing in sum.  The laws (a contact only pushes,
friction stays within its cone) are margins, affine in the forces and so in z, that are not to be
negative.
"""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...system import Array

LEANS = 1e-9  # of the forces' size: a margin that changes less with z does not depend on it
FITS = 1e-10  # of the forces' size: as well as a linear programme's bounds are kept
UNBOUNDED = 3  # HiGHS: as far as one likes

Margins = Callable[[Mapping[str, float]], list[float]]
"""Margins that forces leave until a law is broken, negative where one is: affine in the forces."""


@dataclass(frozen=True)
class Inmost:
    """Forces, and the smallest of their margins, relative to their size."""

    forces: dict[str, float]
    least: float


@dataclass(frozen=True)
class Leeway:
    """Open forces: margins + slope z (m,) ≥ 0, relative to the forces' size; z (k,)."""

    forces: Mapping[str, float]
    ways: Sequence[Mapping[str, float]]
    margins: Array
    slope: Array
    size: float

    @cached_property
    def leans(self) -> NDArray[np.bool_]:
        """(m,) which margins z changes."""
        return np.max(np.abs(self.slope), axis=1, initial=0.0) > LEANS

    @cached_property
    def inmost(self) -> Inmost:
        """The forces whose least margin is the largest; of its size at most."""
        if not np.any(self.leans):
            return Inmost(dict(self.forces), 1.0)
        slope, margins = self.slope[self.leans], self.margins[self.leans]
        m, k = slope.shape
        x = _best(np.append(np.zeros(k), -1.0), np.hstack([-slope, np.ones((m, 1))]), margins, 1.0)
        z, least = x[:-1], float(np.min(slope @ x[:-1] + margins))
        return Inmost({name: self._force_at(name, z) for name in self.forces}, least)

    @property
    def fits(self) -> bool:
        """Whether there are forces that keep all laws that z can change."""
        return self.inmost.least >= -FITS

    def open(self, name: str) -> bool:
        """Whether the equations leave this force open; the laws may hold it all the same."""
        return any(abs(way[name] - self.forces[name]) > LEANS * self.size for way in self.ways)

    def span(self, name: str) -> tuple[float, float]:
        """The least and the largest value that the laws allow a force."""
        return self.spanned(self.forces[name], [way[name] for way in self.ways])

    def spanned(self, own: float, others: Sequence[float]) -> tuple[float, float]:
        """The least and the largest value that the laws allow anything linear in the forces.

        It is `own` for `forces`, and `others` for those of each way.
        """
        along = (np.array(others) - own) / self.size
        if np.max(np.abs(along)) <= LEANS:
            return own, own
        slope, margins = self.slope[self.leans], self.margins[self.leans]
        margins = margins + max(0.0, -self.inmost.least)
        low, high = (self._farthest(sense * along, slope, margins) for sense in (1.0, -1.0))
        return own + self.size * low, own - self.size * high

    def _farthest(self, along: Array, slope: Array, margins: Array) -> float:
        """The least of along · z."""
        z = _best(along, -slope, margins)
        return -math.inf if z is None else float(along @ z)

    def _force_at(self, name: str, z: Array) -> float:
        own = self.forces[name]
        return own + float(np.array([way[name] - own for way in self.ways]) @ z)


def _best(cost: Array, rows: Array, bound: Array, most: float | None = None) -> Any:
    """The x with the least cost · x and rows x ≤ bound, the last of it ≤ most; None: no end."""
    from scipy.optimize import linprog

    limits = [(None, None)] * (len(cost) - 1) + [(None, most)]
    programme: Any = linprog
    result = programme(cost, A_ub=rows, b_ub=bound, bounds=limits, options=EXACT)
    if result.status == UNBOUNDED:
        return None
    if result.x is None:
        raise ArithmeticError(f"a linear programme has no answer: {result.message}")
    return result.x


def sized(ways: Array, size: float) -> Array:
    """Ways (k, r), the largest part of each of this size, so that margins can be seen in them."""
    return ways * (size / np.max(np.abs(ways), axis=1, keepdims=True))


EXACT = {"primal_feasibility_tolerance": FITS, "dual_feasibility_tolerance": FITS}


def leeway(
    forces_of: Callable[[Array], Mapping[str, float]], lam: Array, ways: Array, margins_of: Margins
) -> Leeway:
    """The forces left open by ways (k, r) that move nothing, from those of multipliers (r,)."""
    forces = forces_of(lam)
    size = max(map(abs, forces.values()), default=0.0) or 1.0
    others = [forces_of(lam + way) for way in sized(ways, size)]
    margins = np.array(margins_of(forces), dtype=float)
    slope = np.array([margins_of(other) for other in others], dtype=float)
    slope = slope.reshape(len(others), len(margins)).T  # a bar between two hinges has no margins
    return Leeway(forces, others, margins / size, (slope - margins[:, None]) / size, size)
