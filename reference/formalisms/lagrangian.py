"""Lagrange's equations from one function, L = T − U − V (2.51), (2.52).

They say what `lagrange` says of T, U and V one by one; that V is a force there, and a part of the
momentum ∂L/∂q̇ here, makes them two derivations of it.
"""

from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode, Vector
from .derivative import along
from .lagrange import gradient, inertia, rate_matrix, slope


def left_side(system: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """The left side of (2.51), d/dt ∂L/∂q̇ᵃ − ∂L/∂qᵃ (m,), at v̇ = a."""
    q_dot = system.rates(t, q, v)

    def L(t: Any, q: Vector, q_dot: Vector) -> Any:
        return system.T(t, q, q_dot) - system.U(t, q) - system.V(t, q, q_dot)

    change = along(
        lambda t, q, v: slope(L, t, q, system.rates(t, q, v)), (t, q, v), (1.0, q_dot, a)
    )
    return change - gradient(lambda q: L(t, q, q_dot), q)


@equation
def unbalanced(system: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """(2.51), (2.52) d/dt ∂L/∂q̇ᵃ − ∂L/∂qᵃ = −∂D/∂q̇ᵃ + Q_a⁴, or 0: by what v̇ = a misses it (n,).

    Of coordinates that nothing binds.
    """
    N, missed = rate_matrix(system, t, q, v), left_side(system, t, q, v, a)
    if N is not None:
        missed = N.T @ missed
    missed = missed + gradient(lambda v: system.D(t, q, v), v) - system.Q4(t, q, v)
    misfit: Any = np.linalg.solve(inertia(system, t, q, v), missed)
    return misfit
