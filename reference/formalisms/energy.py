"""The balance of power that follows from Lagrange's equations."""

import numpy as np

from ..system import Array, Mode
from .derivative import along
from .lagrange import derivative, gradient, momentum, multipliers


def power_balance(system: Mode, t: float, q: Array, v: Array) -> float:
    """(2.51) d/dt (q̇ᵃ ∂T/∂q̇ᵃ − T + U) − (Q_a q̇ᵃ + λ_b gᵇ + ∂(U − T)/∂t) [W]: must be 0.

    The bracket is T + U where T is quadratic in q̇; Q are the forces of classes 2 and 4, and the
    last two terms are the power of drives. The motion is the one of `system.accelerations`.
    """
    a = system.accelerations(t, q, v)
    change = along(
        lambda t, q, v: momentum(system, t, q, v) @ v - system.T(t, q, v) + system.U(t, q),
        (t, q, v),
        (1.0, v, a),
    )
    Q = np.asarray(system.Q4(t, q, v)) - gradient(lambda v: system.D(t, q, v), v)
    drives = derivative(lambda t: system.U(t, q) - system.T(t, q, v), (t,), (1.0,))
    g = np.asarray(system.g(t, q), dtype=np.float64)
    if g.any():
        drives += multipliers(system, t, q, v)[1] @ g
    return float(change - Q @ v - drives)
