"""Rates that others determine: q̇^{a2} = α^{a2}_{a1} q̇^{a1} + γ^{a2} (2.61), erratum 13.

What binds the rates is f_a v = g, and q̇ = N v + n₀ where v is not q̇ itself: the rates of a unit
quaternion are bound, too.  Which are the dependent ones is free where the others determine them:
they are chosen so that this is as well conditioned as can be, or told.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..coverage import Numbered
from ..system import Array, Mode, Vector
from .lagrange import (
    constraint_rows,
    curvature,
    derivative,
    gradient,
    of_potential,
    rate_matrix,
    slope,
)

Places = NDArray[np.int64]
REGULAR = 1e-6  # of the largest pivot: what a smaller one determines has lost half of its digits


@dataclass(frozen=True)
class Dependent(Numbered):
    """a1 (k,) independent rates, a2 (m − k,) those that depend on them.

    `bound` (r,) are as many velocities, for which f_a v = g is solved: a2 where q̇ = v is `plain`.
    """

    system: Mode
    n: int
    plain: bool
    bound: Places
    a1: Places
    a2: Places

    def alpha(self, t: Any, q: Vector) -> Vector:
        """(2.61) α (m − k, k) of q̇^{a2} = α^{a2}_{a1} q̇^{a1} + γ^{a2}."""
        return self.solved(t, q)[0]

    def solved(self, t: Any, q: Vector) -> tuple[Vector, Vector]:
        """α, and γ (m − k,), which is 0 if all f_a v are; q̇ = B w + b, its rows a1 solved for w."""
        B, b = self.admissible(t, q)
        if self.plain:
            return B[self.a2], b[self.a2]
        alpha = np.linalg.solve(B[self.a1].T, B[self.a2].T).T
        return alpha, b[self.a2] - alpha @ b[self.a1]

    def rates(self, t: Any, q: Vector, independent: Vector) -> Vector:
        """q̇ (m,) of the independent rates (k,)."""
        return self.joined(independent, *self.solved(t, q))

    def joined(self, independent: Vector, alpha: Vector, gamma: Vector) -> Vector:
        """q̇ (m,) or (m, K) in its order, γ (m − k,) or (m − k, 1)."""
        return np.concatenate([independent, alpha @ independent + gamma])[self._order]

    def reduced(self, t: Any, q: Vector) -> Callable[..., Any]:
        """(2.63) T' = T(t, q, q̇^{a1}, α q̇^{a1} + γ) [J] of many q̇^{a1} (k, K), at this t and q."""
        alpha, gamma = self.solved(t, q)
        return lambda t, q, independent: self.system.T(
            t, q, self.joined(independent, alpha, gamma[:, None])
        )

    def momentum(self, t: Any, q: Vector, independent: Vector) -> Vector:
        """∂T'/∂q̇^{a1} (k,)."""
        return slope(self.reduced(t, q), t, q, independent, even=True)

    def inertia(self, t: float, q: Array) -> Array:
        """∂²T'/∂q̇^{a1}∂q̇^{d} (k, k)."""
        return curvature(self.reduced(t, q), t, q, len(self.a1))

    def condition(self, t: float, q: Array) -> float:
        """How many times larger the rounding of q̈^{a1} is than that of its equations.

        Of ∂²T'/∂q̇² in units in which its diagonal is 1: a light body that is counted from a heavy
        one has little of it. Raises LinAlgError where a rate has no inertia at all.
        """
        M = self.inertia(t, q)
        if not np.all(np.diag(M) > 0.0):
            raise np.linalg.LinAlgError("a rate without inertia")
        size = np.sqrt(np.diag(M))
        return float(np.linalg.cond(M / np.outer(size, size)))

    def velocities(self, t: Any, q: Vector, independent: Vector) -> Vector:
        """v (n,) of the independent rates (k,)."""
        V, v_0 = self._free(t, q)
        B, b = self.admissible(t, q)
        return V @ np.linalg.solve(B[self.a1], independent - b[self.a1]) + v_0

    def ways(self, t: float, q: Array) -> Array:
        """∂v/∂q̇^{a1} (n, k): f_a ∂v/∂q̇^{a1} = 0."""
        B, _ = self.admissible(t, q)
        return self._free(t, q)[0] @ np.linalg.inv(B[self.a1])

    def forces(self, t: float, q: Array, v: Array) -> Array:
        """(2.78) Π_{a1} = Q_{a1} + Q_{a2} α^{a2}_{a1} (k,), Q of (2.45)–(2.50)."""
        slopes = gradient(lambda q: self.system.U(t, q), q)
        slopes = slopes - of_potential(self.system, t, q, self.system.rates(t, q, v))
        along = np.asarray(self.system.Q4(t, q, v), dtype=np.float64)
        along = along - gradient(lambda v: self.system.D(t, q, v), v)
        conservative = slopes[self.a1] + slopes[self.a2] @ self.alpha(t, q)
        return self.ways(t, q).T @ along - conservative

    def changed(self, t: float, q: Array, v: Array, independent: Array) -> Array:
        """v̇ (n,) of the accelerations q̈^{a1} (k,)."""
        q_dot = self.system.rates(t, q, v)
        at, direction = (t, q, q_dot[self.a1]), (1.0, q_dot, independent)
        return derivative(self.velocities, at, direction)

    def admissible(self, t: Any, q: Vector) -> tuple[Vector, Vector]:
        """q̇ = B w + b, of the same w."""
        V, v_0 = self._free(t, q)
        N = rate_matrix(self.system, t, q, np.zeros(self.n))
        if N is None:
            return V, v_0
        return N @ V, N @ v_0 + self.system.rates(t, q, np.zeros(self.n))

    @cached_property
    def _unbound(self) -> Places:
        return np.setdiff1d(np.arange(self.n), self.bound)

    @cached_property
    def _order(self) -> Places:
        return np.argsort(np.concatenate([self.a1, self.a2]))

    def _free(self, t: Any, q: Vector) -> tuple[Vector, Vector]:
        """v = V w + v₀ for w of those velocities that are not bound."""
        rows, g = constraint_rows(self.system, t, q, self.n), np.asarray(self.system.g(t, q))
        free = self._unbound
        solved = np.linalg.solve(rows[:, self.bound], np.column_stack([-rows[:, free], g]))
        V = np.zeros((self.n, len(free)), solved.dtype)
        v_0 = np.zeros(self.n, solved.dtype)
        V[free, np.arange(len(free))] = 1.0
        V[self.bound], v_0[self.bound] = solved[:, :-1], solved[:, -1]
        return V, v_0


def dependent(
    system: Mode, t: float, q: Array, n: int, among: Sequence[int] | None = None
) -> Dependent | None:
    """The rates that depend on the others, of n velocities: the best conditioned `among` some.

    None if the others do not determine as many of those, if constraints say the same twice, or if
    nothing is left free.
    """
    rows = np.asarray(constraint_rows(system, t, q, n), dtype=np.float64)
    bound, independent = _pivots(rows, np.max(np.abs(rows), initial=0.0))
    if not independent:
        return None
    plain = rate_matrix(system, t, q, np.zeros(n)) is None
    split = Dependent(system, n, plain, np.sort(bound), np.arange(n), np.arange(0))
    B = np.asarray(split.admissible(t, q)[0], dtype=np.float64)
    m, k = B.shape
    allowed = np.arange(m) if among is None else np.asarray(among, dtype=np.int64)
    across = np.linalg.svd(B)[0][:, k:].T  # (m − k, m): along these q̇ cannot be
    chosen, regular = _pivots(across[:, allowed], 1.0)
    if k == 0 or not regular:
        return None
    a2 = np.sort(allowed[chosen])
    a1 = np.setdiff1d(np.arange(m), a2)
    return Dependent(system, n, plain, a2 if plain else split.bound, a1, a2)


def _pivots(rows: Array, size: float) -> tuple[Places, bool]:
    """The best r columns of the rows (r, m), and whether they are regular, beside their size."""
    r, m = rows.shape
    if r == 0:
        return np.arange(0), True
    if r > m:
        return np.arange(0), False
    from scipy.linalg import qr

    triangle: Any
    order: Any
    _, triangle, order = qr(rows, mode="economic", pivoting=True)
    return order[:r], bool(abs(triangle[-1, r - 1]) > REGULAR * size)
