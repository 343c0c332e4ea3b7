"""How a mode is held: its rows, the friction that leans on them, and their equations, factored."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ... import lapack
from ...system import Array
from .constraint import row
from .contact import Coulomb
from .equation_table import Rows
from .factorization import Dependent, Held, full


class Holding:
    """The rows f_a (r, n) of a mode; `coulomb` with the number of each normal row."""

    def __init__(self, rows: Rows, M: Array, coulomb: Sequence[tuple[int, Coulomb]]) -> None:
        self.rows, self.M, self._coulomb = rows, M, coulomb
        self.band = None if coulomb else band(rows, M)
        self._constant = rows.constant and all(
            law.tangent.alone.constant(np.arange(law.tangent.size)) for _, law in coulomb
        )
        self._always: Held | None = None

    def at(self, t: float, q: Array, v: Array) -> Held:
        """At a state; where no row changes with the state, as at the first. Raises Dependent."""
        if self._always is not None:
            return self._always
        if self.band is not None:
            return self.band.held(t, q, v)
        rows, _, gamma = self.rows(t, q, v)
        by_mass = self.columns(t, q, v, rows) / self.M
        held = full(rows, gamma, by_mass, leans=bool(self._coulomb))
        if self._constant:
            self._always = held
        return held

    def columns(self, t: float, q: Array, v: Array, rows: Array) -> Array:
        """Generalized force of a unit of each multiplier, (r, n): its row and its friction.

        With λ_t = factor λ_n (2.87) the force of a normal row leans against the slip.
        """
        if not self._coulomb:
            return rows
        columns = np.array(rows)
        for at, law in self._coulomb:
            columns[at] += law.factor * row(law.tangent, t, q, v)[0]
        return columns


# The multipliers of many rows of which few share a body, as along a chain: in r steps, not r³.


MANY = 16  # rows: fewer are a matter of microseconds, in whatever way
NARROW = 0.25  # of the rows: a wider band is a full matrix

Index = NDArray[np.intp]


@dataclass(frozen=True)
class Band:
    """Where f_a (r, n) has entries, and which pairs of them meet in f_a M⁻¹ f_bᵀ.

    place: the row's place in an order in which only neighbours share a body, (r,).
    row, column: of each entry. one, two, at: entries of one column, and where their product stands
    in the `width` + 1 diagonals of the matrix, the main one first.
    """

    rows: Rows
    M: Array
    place: Index
    width: int
    row: Index
    column: Index
    one: Index
    two: Index
    at: Index

    def held(self, t: float, q: Array, v: Array) -> "Banded":
        """The rows at a state, factored by Cholesky. Raises Dependent."""
        f, gamma = self.rows.entries(t, q, v)
        r, by_mass = len(self.place), f / self.M[self.column]
        diagonals = _sums(self.at, f[self.one] * by_mass[self.two], (self.width + 1) * r)
        # LAPACK counts a matrix down its columns: the diagonals of a place stand together.
        diagonals = diagonals.reshape(r, self.width + 1).T
        factor, fails = lapack.dpbtrf(diagonals, lower=1, overwrite_ab=1)
        if fails:
            raise Dependent(int(np.flatnonzero(self.place == fails - 1)[0]))
        return Banded(self, f, gamma, by_mass, factor)


@dataclass(frozen=True)
class Banded:
    """The rows at one state, by their entries; see `Held`."""

    band: Band
    f: Array
    gamma: Array
    by_mass: Array
    factor: Array

    def along(self, a: Array) -> Array:
        """f_a aᵃ."""
        return _sums(self.band.row, self.f * a[self.band.column], len(self.gamma))

    def pulled(self, multipliers: Array) -> Array:
        """M⁻¹ f_bᵀ λ_b."""
        return _sums(self.band.column, self._each(multipliers), len(self.band.M))

    def acceleration_sizes(self, multipliers: Array) -> Array:
        """Σ |M⁻¹ f_bᵀ λ_b|."""
        return _sums(self.band.column, np.abs(self._each(multipliers)), len(self.band.M))

    def _each(self, multipliers: Array) -> Array:
        return self.by_mass * multipliers[self.band.row]

    def solve(self, right: Array) -> Array:
        """By the factor."""
        ordered = np.empty_like(right)
        ordered[self.band.place] = right
        return lapack.dpbtrs(self.factor, ordered, lower=1)[0][self.band.place]


def band(rows: Rows, M: Array) -> Band | None:
    """The banded form of these rows; None where a full matrix is as good."""
    row, column = rows.pattern
    r = rows.size
    if r < MANY:
        return None
    from scipy.sparse import csr_array

    pattern = csr_array((np.ones(len(row)), (row, column)), shape=(r, len(M)))
    place, width = _order(pattern @ pattern.T)
    if width > NARROW * r:
        return None
    first, second = _pairs(column)
    lower = place[row[first]] <= place[row[second]]
    first, second = first[lower], second[lower]
    near, far = place[row[first]], place[row[second]]
    return Band(rows, M, place, width, row, column, first, second, near * (width + 1) + far - near)


def _sums(at: Index, values: Array, count: int) -> Array:
    """The values that belong to each of `count` places, added up."""
    sums: Any = np.bincount(at, values, count)
    return sums


def _order(shared: Any) -> tuple[Index, int]:
    """An order of the rows with a small bandwidth, and that bandwidth."""
    from scipy.sparse.csgraph import reverse_cuthill_mckee

    row, column = shared.nonzero()
    orders = []  # as written, or better
    for order in (np.arange(shared.shape[0]), reverse_cuthill_mckee(shared.tocsr(), True)):
        place = np.argsort(order)
        orders.append((place, int(np.max(np.abs(place[row] - place[column])))))
    return min(orders, key=lambda pair: pair[1])


def _pairs(column: Index) -> tuple[Index, Index]:
    """Two arrays of indices: every pair of entries that stand in one column, in both orders."""
    pairs = [
        (first, second)
        for k in np.unique(column)
        for entries in [np.flatnonzero(column == k)]
        for first in entries
        for second in entries
    ]
    first, second = np.transpose(pairs)
    return first, second
