"""M v̇ − λ_b f_aᵇ = Q with f_aᵇ v̇ᵃ = γᵇ (2.60): solved for both, M being always the same."""

from typing import Any

import numpy as np

from ... import lapack
from ...system import Array

TURNS = 1  # of refinement: what the factors lose of a light body beside a heavy one comes back
NARROW = (
    1e-3  # of the largest pivot of f_a M⁻¹ f_b; a smaller one costs λ more than one turn brings
)


class Equations:
    """The equations of one mechanism. Those of λ alone, f_a M⁻¹ f_b, are by far the fewest.

    But M may be singular, as of a slender bar, which its neighbours keep from turning about itself:
    there, and wherever digits would be lost, v̇ and λ are solved for at once.
    """

    def __init__(self, M: Array, tensors: Array, count: int) -> None:
        n = len(M)
        self._n, self._saddle = n, np.zeros((n + count, n + count))
        self._saddle[:n, :n] = M
        regular = all(np.linalg.matrix_rank(J) == len(J) for J in tensors)
        self._inverse = np.linalg.inv(M) if regular else None

    def solve(self, rows: Array, gamma: Array, Q: Array) -> tuple[Array, Array]:
        """v̇ (n,) and λ (r,) of f_a (r, n), γ (r,) and Q (n,)."""
        if self._inverse is None:
            return self._together(rows, gamma, Q)
        a: Any = self._inverse.dot(Q)
        if not len(rows):
            return a, gamma
        by_mass: Any = rows.dot(self._inverse)
        factor, fails = lapack.dpotrf(by_mass.dot(rows.T))
        pivots = factor.diagonal().tolist()
        if fails or min(pivots) < NARROW * max(pivots):
            return self._together(rows, gamma, Q)
        multipliers = 0.0
        for _ in range(1 + TURNS):  # the nearest v̇, in M, that meets the rows
            change = lapack.dpotrs(factor, gamma - rows.dot(a))[0]
            a, multipliers = a + change.dot(by_mass), multipliers + change
        return a, np.asarray(multipliers)

    def _together(self, rows: Array, gamma: Array, Q: Array) -> tuple[Array, Array]:
        """By one matrix that knows nothing of M⁻¹."""
        n, matrix = self._n, self._saddle.copy()
        matrix[n:, :n], matrix[:n, n:] = rows, rows.T
        right = np.concatenate((Q, gamma))
        lu, pivots, _ = lapack.dgetrf(matrix.T)  # symmetric: its transpose needs no copy
        found, _ = lapack.dgetrs(lu, pivots, right)
        for _ in range(TURNS):
            found = found + lapack.dgetrs(lu, pivots, right - matrix @ found)[0]
        return found[:n], -found[n:]
