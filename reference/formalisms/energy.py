"""The balance of power that follows from Lagrange's equations."""

from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode
from .derivative import along
from .lagrange import derivative, gradient, momentum, multipliers
from .lagrangian import left_side


def power_balance(system: Mode, t: float, q: Array, v: Array) -> float:
    """The sum of the terms of (2.51) [W]: must be 0."""
    return float(np.sum(power_terms(system, t, q, v)))


@equation
def power_terms(system: Mode, t: float, q: Array, v: Array) -> Array:
    """(2.51) d/dt (q̇ᵃ ∂T/∂q̇ᵃ − T + U) − (Q_a vᵃ + λ_b gᵇ + ∂(U + V − T)/∂t) [W], by terms.

    The bracket is T + U where T is quadratic in q̇: V, linear in q̇, drops out but for ∂V/∂t. Q are
    the forces of classes 2 and 4, and the last two terms are the power of drives. A drive that is
    part of q̇ = N v + n₀ has the power n₀ · (d/dt ∂L/∂q̇ − ∂L/∂q) besides. The motion is that of
    `system.accelerations`.
    """
    a, q_dot = system.accelerations(t, q, v), system.rates(t, q, v)

    def energy(t: Any, q: Any, v: Any) -> Any:
        rates = system.rates(t, q, v)
        p = momentum(system, t, q, rates, even=True)
        return p @ rates - system.T(t, q, rates) + system.U(t, q)

    change = along(energy, (t, q, v), (1.0, q_dot, a))
    Q = np.asarray(system.Q4(t, q, v)) - gradient(lambda v: system.D(t, q, v), v)
    given = derivative(
        lambda t: system.U(t, q) + system.V(t, q, q_dot) - system.T(t, q, q_dot), (t,), (1.0,)
    )
    drives = [np.atleast_1d(given)]
    g = np.asarray(system.g(t, q), dtype=np.float64)
    if g.any():
        drives.append(multipliers(system, t, q, v)[1] * g)
    if q_dot is not v and (n_0 := np.asarray(system.rates(t, q, np.zeros(len(v))))).any():
        drives.append(n_0 * left_side(system, t, q, v, a))
    return np.concatenate([np.atleast_1d(change), -Q * v, *(-each for each in drives)])
