"""Lagrange's equations of the 2nd kind (2.44), and with multipliers (2.60), from T, U, D, Q₄."""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..system import Array, Mode
from .derivative import along


def multipliers(system: Mode, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """(2.60) d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ = Q_a + λ_b f_aᵇ with f_a q̇ᵃ = g: q̈ (n,), λ (r,).

    The constraint is differentiated once: f_a q̈ᵃ = ġ − ḟ_a q̇ᵃ. Without constraints it is (2.44).
    """
    rows = np.asarray(system.f_a(t, q), dtype=np.float64)
    n, r = len(q), len(rows)
    matrix = np.block([[mass_matrix(system, t, q), -rows.T], [rows, np.zeros((r, r))]])
    right = np.concatenate([forces(system, t, q, v), constraint_acceleration(system, t, q, v)])
    solution: Any = np.linalg.solve(matrix, right)
    return solution[:n], solution[n:]


def accelerations(system: Mode, t: float, q: Array, v: Array) -> Array:
    """(2.44) d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ = Q_a: q̈ (n,). Raises ValueError if there are constraints."""
    if len(system.f_a(t, q)):
        raise ValueError("the coordinates are constrained: use multipliers (2.60)")
    q_ddot: Any = np.linalg.solve(mass_matrix(system, t, q), forces(system, t, q, v))
    return q_ddot


def momentum(system: Mode, t: Any, q: Any, v: Any) -> Any:
    """p_a = ∂T/∂q̇ᵃ (n,): the central difference is exact, because T is quadratic in q̇.

    Its width is the largest rate: beside a much larger or smaller one T would lose its digits.
    """
    h = float(np.max(np.abs(np.real(v)), initial=0.0)) or 1.0
    rates, steps = np.asarray(v)[:, None], h * np.eye(len(v))  # a column for each difference
    return (system.T(t, q, rates + steps) - system.T(t, q, rates - steps)) / (2 * h)


def mass_matrix(system: Mode, t: float, q: Array) -> Array:
    """M_ab (n, n) of T = ½ M_ab q̇ᵃ q̇ᵇ + …, by polarisation: column b is p(e_b) − p(0)."""
    still = momentum(system, t, q, np.zeros(len(q)))
    return np.stack([momentum(system, t, q, e) - still for e in np.eye(len(q))], axis=1)


def forces(system: Mode, t: float, q: Array, v: Array) -> Array:
    """Q_a + ∂T/∂qᵃ − (d/dt ∂T/∂q̇ᵃ at q̈ = 0), (n,), Q_a from (2.45), (2.46) and (2.50)."""
    drift = derivative(lambda t, q: momentum(system, t, q, v), (t, q), (1.0, v))
    conservative = gradient(lambda q: system.T(t, q, v) - system.U(t, q), q)
    dissipative = gradient(lambda v: system.D(t, q, v), v)
    return conservative - dissipative + np.asarray(system.Q4(t, q, v), dtype=np.float64) - drift


def constraint_acceleration(system: Mode, t: float, q: Array, v: Array) -> Array:
    """ġ − ḟ_a q̇ᵃ (r,): what f_a q̈ᵃ must be."""
    return derivative(lambda t, q: system.g(t, q) - system.f_a(t, q) @ v, (t, q), (1.0, v))


def gradient(function: Callable[[Any], Any], at: Array) -> Array:
    """(n,): the derivatives of a number by each entry of `at`."""
    return np.array([derivative(function, (at,), (e,)) for e in np.eye(len(at))], dtype=np.float64)


def derivative(
    function: Callable[..., Any], at: tuple[Any, ...], direction: tuple[Any, ...]
) -> Any:
    """`along`, where a constant is no mistake: T of a wheel does not depend on q.

    A real result is taken for a constant only if the function is the same farther along.
    """
    try:
        return along(function, at, direction)
    except TypeError:
        arguments = [(np.asarray(a), np.asarray(d)) for a, d in zip(at, direction, strict=True)]
        here, *beyond = (function(*(a + s * d for a, d in arguments)) for s in (0.0, -0.1, 0.1))
        if not all(np.array_equal(value, here) for value in beyond):
            raise
        return np.zeros(np.shape(here))
