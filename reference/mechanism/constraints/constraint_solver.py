"""How a mode is held: its rows, the friction that leans on them, and their equations, factored."""

from collections.abc import Sequence

import numpy as np

from ...system import Array
from .banded_solver import band
from .constraint import row
from .contact import Coulomb
from .equation_table import Rows
from .factorization import Held, full


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
        found = full(rows, gamma, by_mass, leans=bool(self._coulomb))
        if self._constant:
            self._always = found
        return found

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
