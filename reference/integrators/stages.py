"""The linear equations of an implicit step: all stages together, 1 − h A ⊗ J."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from .. import lapack
from .radau import Collocation

Matrix = NDArray[np.float64]
FEW = 64  # rows of all stages: their one matrix is solved with faster than several smaller ones


class Factors:
    """The LU factors of a matrix; straight from LAPACK, whose wrappers cost more than the work."""

    def __init__(self, matrix: Any) -> None:
        if matrix.dtype.kind == "c":
            factor, self._solve = lapack.zgetrf, lapack.zgetrs
        else:
            factor, self._solve = lapack.dgetrf, lapack.dgetrs
        self._lu, self._pivots, _ = factor(matrix)

    def solve(self, right: Any) -> Any:
        """Not finite if the matrix was singular; the callers look at that anyway."""
        return self._solve(self._lu, self._pivots, right)[0]


class Whole:
    """1 − h A ⊗ J of all stages, as one matrix of s n rows: cheapest where these are few."""

    def __init__(self, table: Collocation, scaled: Matrix) -> None:
        rows = len(table.c) * len(scaled)
        blocks = np.multiply.outer(table.a, scaled).transpose(0, 2, 1, 3)
        self._factors = Factors(np.eye(rows) - blocks.reshape(rows, rows))

    def solve(self, right: Matrix) -> Matrix:
        """(s, n) for (s, n)."""
        return self._factors.solve(right.ravel()).reshape(right.shape)


class ByEigenvalues:
    """Solver of the equations of all stages: one matrix 1 − h λ J for each eigenvalue λ of A.

    One matrix of s n rows would cost s³ n³; these are s n³ in all, half of them by conjugation.
    """

    def __init__(self, table: Collocation, scaled: Matrix) -> None:
        one = np.eye(len(scaled))
        self.table = table
        self.factors = [
            Factors(one - (value if value.imag else value.real) * scaled)
            for value in table.values.tolist()
        ]

    def solve(self, right: Matrix) -> Matrix:
        """(s, n) for (s, n)."""
        rows = self.table.into @ right
        for k, (value, factors) in enumerate(zip(self.table.values, self.factors, strict=True)):
            rows[k] = factors.solve(rows[k] if value.imag else rows[k].real)
        return (self.table.back @ rows).real


def stage_factors(table: Collocation, scaled: Matrix) -> Whole | ByEigenvalues:
    """A solver of the equations of all stages together."""
    few = len(table.c) * len(scaled) <= FEW
    return Whole(table, scaled) if few else ByEigenvalues(table, scaled)
