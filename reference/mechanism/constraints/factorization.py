"""The rows of a mode at one state, factored: f_a M⁻¹ (f_bᵀ λ_b) = right side (r,)."""

from typing import Any, NamedTuple, Protocol

import numpy as np

from ... import lapack
from ...system import Array


class Dependent(ArithmeticError):
    """Rows that depend on each other; the number of the first that does."""

    def __init__(self, row: int) -> None:
        super().__init__()
        self.row = row


class Held(Protocol):
    """The rows at one state."""

    @property
    def gamma(self) -> Array:
        """γ (r,) of f_a q̈ᵃ = γ."""
        ...

    def along(self, a: Array) -> Array:
        """f_a aᵃ (r,) of accelerations a (n,)."""
        ...

    def pulled(self, multipliers: Array) -> Array:
        """M⁻¹ f_bᵀ λ_b (n,): what the multipliers (r,) accelerate."""
        ...

    def acceleration_sizes(self, multipliers: Array) -> Array:
        """Σ |M⁻¹ f_bᵀ λ_b| (n,): the sizes of what each multiplier accelerates alone."""
        ...

    def solve(self, right: Array) -> Array:
        """The multipliers λ (r,) with f_a M⁻¹ (f_bᵀ λ_b) = right (r,)."""
        ...


class Full(NamedTuple):  # made at every state: a frozen dataclass costs three times as much
    """By a full matrix; symmetric, unless forces lean against the slip (2.87)."""

    rows: Array
    gamma: Array
    by_mass: Array
    leans: bool
    factors: tuple[Any, ...]

    def along(self, a: Array) -> Array:
        """f_a aᵃ."""
        return self.rows.dot(a)

    def pulled(self, multipliers: Array) -> Array:
        """M⁻¹ f_bᵀ λ_b."""
        return multipliers.dot(self.by_mass)

    def acceleration_sizes(self, multipliers: Array) -> Array:
        """Σ |M⁻¹ f_bᵀ λ_b|."""
        return np.abs(multipliers).dot(np.abs(self.by_mass))

    def solve(self, right: Array) -> Array:
        """By the factors."""
        return (lapack.dgetrs if self.leans else lapack.dpotrs)(*self.factors, right)[0]


def full(rows: Array, gamma: Array, by_mass: Array, *, leans: bool) -> Full:
    """The rows f_a (r, n) and γ (r,), and what a unit of each multiplier accelerates (r, n).

    Raises Dependent.
    """
    *factors, fails = (lapack.dgetrf if leans else lapack.dpotrf)(rows.dot(by_mass.T))
    if fails:  # singular, or not positive definite
        raise Dependent(fails - 1)
    return Full(rows, gamma, by_mass, leans, tuple(factors))
