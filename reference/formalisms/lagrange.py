"""Lagrange's equations of the 2nd kind (2.44), and with multipliers (2.60), from T, U, V, D, Q₄.

Where q̇ = N v + n₀ they are Hamel's: those of the rates q̇ (m,), seen along the columns of N,

    Nᵀ (d/dt ∂T/∂q̇ − ∂T/∂q + ∂U/∂q) = Q + λ_b f_aᵇ,

all of its n rows at once. N = 1 gives the book's form, N = (1, α) Voronets' equations (2.66), a
unit quaternion with ω in body axes Euler's (2.33).
"""

from collections.abc import Callable
from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode, Vector
from .derivative import along

LARGER = 4  # tries: with the last it is 1e18 rad/s, or m/s
NUMBERS = 4_000_000  # of rates at once: 32 MB, of all pairs of 100 rates
MOST = 1e6  # times the energy of what is driven: T is quadratic, so large rates cost no digits


@equation
def multipliers(system: Mode, t: float, q: Array, v: Array) -> tuple[Array, Array]:
    """(2.60) d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ = Q_a + λ_b f_aᵇ with f_a v = g: v̇ (n,), λ (r,).

    The constraint is differentiated once: f_a v̇ = ġ − ḟ_a v. Without constraints it is (2.44).
    """
    n = len(v)
    rows = np.asarray(constraint_rows(system, t, q, n), dtype=np.float64)
    r = len(rows)
    matrix = np.block([[inertia(system, t, q, v), -rows.T], [rows, np.zeros((r, r))]])
    right = np.concatenate([forces(system, t, q, v), constraint_acceleration(system, t, q, v)])
    solution: Any = np.linalg.solve(matrix, right)
    return solution[:n], solution[n:]


@equation
def accelerations(system: Mode, t: float, q: Array, v: Array) -> Array:
    """(2.44) d/dt ∂T/∂q̇ᵃ − ∂T/∂qᵃ = Q_a: v̇ (n,). Raises ValueError if there are constraints."""
    if len(system.f_a(t, q)):
        raise ValueError("the coordinates are constrained: use multipliers (2.60)")
    v_dot: Any = np.linalg.solve(inertia(system, t, q, v), forces(system, t, q, v))
    return v_dot


def momentum(system: Mode, t: Any, q: Any, q_dot: Any, *, even: bool = False) -> Any:
    """p_a = ∂T/∂q̇ᵃ (m,); even: with digits where rates or masses are of very different sizes."""
    return slope(system.T, t, q, q_dot, even=even)


def slope(T: Callable[..., Any], t: Any, q: Any, q_dot: Any, *, even: bool = False) -> Any:
    """∂T/∂q̇ of any T(t, q, q̇): the central difference is exact, because T is quadratic in q̇.

    Its width is the largest rate, or what has the energy of that: beside a much larger or smaller
    one T would lose its digits.
    """
    fast = np.abs(np.real(q_dot))
    h: Any = float(np.max(fast, initial=0.0)) or 1.0
    if even:
        h = _widths(T, t, q, fast, h)
    rates, steps = np.asarray(q_dot)[:, None], h * np.eye(len(q_dot))  # a column each
    return (T(t, q, rates + steps) - T(t, q, rates - steps)) / (2 * h)


def _widths(T: Callable[..., Any], t: Any, q: Any, fast: Array, most: float) -> Array:
    """(m,) rates, each with the largest energy that one of the rates has alone.

    A ball of a micrometre turns by 1e6 rad/s where it goes 1 m/s; a flywheel has all of T.
    """
    M, _ = _diagonal(T, t, q, len(fast))
    return _equal_energy_rates(M, float(np.max(M * fast**2)), most)


def _diagonal(T: Callable[..., Any], t: Any, q: Any, n: int) -> tuple[Array, float]:
    """|M_aa| (n,) of the ½ M_aa q̇ᵃ² in T, and the T of driven parts, without any rate.

    By unit rates, or by ever larger ones until they have more energy than what is driven, which
    would take their digits: a molecule at 1 rad/s hardly turns beside its hook at 100 m/s.
    """
    rates, M, driven = np.ones(n), np.zeros(n), 0.0
    for _ in range(LARGER):
        each = np.diag(rates)
        values = np.real(T(t, q, np.hstack([each, -each, np.zeros((n, 1))])))
        values = np.broadcast_to(values, 2 * n + 1)
        twice, driven = np.abs(values[:n] + values[n:-1] - 2 * values[-1]), abs(float(values[-1]))
        M, hidden = twice / rates**2, twice <= driven
        if not (driven and np.any(hidden)):
            break
        rates[hidden] *= MOST
    return M, driven


def _equal_energy_rates(M: Array, energy: float, most: float) -> Array:
    """(n,) rates that alone have that energy; `most` where a rate has none."""
    with np.errstate(divide="ignore", invalid="ignore"):
        rates = np.sqrt(energy / M)
    return np.where(np.isfinite(rates) & (rates > 0.0), rates, most)


def mass_matrix(system: Mode, t: float, q: Array) -> Array:
    """M_ab (m, m) of T = ½ M_ab q̇ᵃ q̇ᵇ + …."""
    return curvature(system.T, t, q, len(q))


def curvature(T: Callable[..., Any], t: float, q: Array, n: int) -> Array:
    """∂²T/∂q̇ᵃ∂q̇ᵇ (n, n) by polarisation, of rates that alone have the same energy.

    It is far above what T has without rates, where parts are driven, which would take its digits.
    """
    M, driven = _diagonal(T, t, q, n)
    widths = _equal_energy_rates(M, float(np.max(M)) + MOST * driven, 1.0)
    rates, height = np.diag(widths), max(1, NUMBERS // (4 * n * n))
    rows = [_cross(T, t, q, rates[:, k : k + height], rates) for k in range(0, n, height)]
    return np.concatenate(rows) / (4.0 * np.outer(widths, widths))


def _cross(T: Callable[..., Any], t: float, q: Array, first: Array, second: Array) -> Array:
    """T(a + b) − T(a − b) − T(b − a) + T(−a − b) for the columns a of `first` and b of `second`."""
    shape = first.shape[1], second.shape[1]
    a, b = np.repeat(first, shape[1], axis=1), np.tile(second, shape[0])
    values = T(t, q, np.hstack([a + b, a - b, b - a, -a - b]))
    pp, pm, mp, mm = np.broadcast_to(values, 4 * shape[0] * shape[1]).reshape(4, *shape)
    return pp - pm - mp + mm


def inertia(system: Mode, t: float, q: Array, v: Array) -> Array:
    """Nᵀ M N (n, n): what Lagrange's equations multiply v̇ with."""
    M, N = mass_matrix(system, t, q), rate_matrix(system, t, q, v)
    return M if N is None else N.T @ M @ N


def rate_matrix(system: Mode, t: Any, q: Vector, v: Vector) -> Vector | None:
    """N (m, n) of q̇ = N v + n₀, or None where q̇ is v itself."""
    if system.rates(t, q, v) is v:
        return None
    still = system.rates(t, q, np.zeros(len(v)))
    return np.stack([system.rates(t, q, e) - still for e in np.eye(len(v))], axis=1)


def forces(system: Mode, t: float, q: Array, v: Array) -> Array:
    """Q_a + ∂T/∂qᵃ − (d/dt ∂T/∂q̇ᵃ at v̇ = 0) along N, (n,): Q_a from (2.45)–(2.50)."""
    q_dot, N = system.rates(t, q, v), rate_matrix(system, t, q, v)
    drift = derivative(
        lambda t, q: momentum(system, t, q, system.rates(t, q, v)), (t, q), (1.0, q_dot)
    )
    conservative = gradient(lambda q: system.T(t, q, q_dot) - system.U(t, q), q)
    conservative = conservative + of_potential(system, t, q, q_dot)
    if N is not None:
        conservative, drift = N.T @ conservative, N.T @ drift
    dissipative = gradient(lambda v: system.D(t, q, v), v)
    return conservative - dissipative + np.asarray(system.Q4(t, q, v), dtype=np.float64) - drift


def of_potential(system: Mode, t: float, q: Array, q_dot: Array) -> Array:
    """The generalized forces of class 3 (m,): zero in a system without V."""
    if np.ndim(slope(system.V, t, q, q_dot)):
        return _from_potential(system, t, q, q_dot)
    return np.zeros(len(q))


@equation
def _from_potential(system: Mode, t: float, q: Array, q_dot: Array) -> Array:
    """(2.48) Q_a = d/dt ∂V/∂q̇ᵃ − ∂V/∂qᵃ (m,): V is linear in q̇, so that no q̈ is in it."""
    change = derivative(lambda t, q: slope(system.V, t, q, q_dot), (t, q), (1.0, q_dot))
    return change - gradient(lambda q: system.V(t, q, q_dot), q)


def constraint_rows(system: Mode, t: Any, q: Vector, n: int) -> Vector:
    """f_a (r, n) for n velocities; without constraints a mode does not know how many they are."""
    return np.reshape(system.f_a(t, q), (-1, n))


def constraint_acceleration(system: Mode, t: float, q: Array, v: Array) -> Array:
    """ġ − ḟ_a v (r,): what f_a v̇ must be."""

    def slip(t: Any, q: Any) -> Any:
        return system.g(t, q) - constraint_rows(system, t, q, len(v)) @ v

    return derivative(slip, (t, q), (1.0, system.rates(t, q, v)))


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
