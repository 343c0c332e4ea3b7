"""Voronets' equations (2.66): the multipliers are gone, and only independent rates are left.

They hold for constraints with a right side, too, with one term more (erratum 13), and where the
constraints depend on time. ∂T/∂q̇^{a2} is that of the full T, with the constraints put in after.
"""

from collections.abc import Sequence
from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode
from .dependent import Dependent, dependent
from .lagrange import derivative, momentum


@equation
def accelerations(
    system: Mode, t: float, q: Array, v: Array, among: Sequence[int] | None = None
) -> Array | None:
    """(2.66) d/dt ∂T'/∂q̇^{a1} − ∂T'/∂q^{a1} − ∂T'/∂q^{a2} α = Π_{a1} + ∂T/∂q̇^{a2} (β q̇^d + …).

    v̇ (n,), or None where no rate depends on others, as everywhere where q̇ = v is free. The
    dependent ones are chosen `among` some, or all; None, too, if those cannot be it.
    """
    by = dependent(system, t, q, len(v), among)
    if by is None or not len(by.a2):
        return None
    q_dot = system.rates(t, q, v)
    independent, alpha = q_dot[by.a1], by.alpha(t, q)
    drift = derivative(lambda t, q: by.momentum(t, q, independent), (t, q), (1.0, q_dot))
    slopes, bends = slopes_of(by, t, q, independent)
    right = slopes[by.a1] + slopes[by.a2] @ alpha + by.forces(t, q, v)
    p_2 = momentum(system, t, q, q_dot, even=True)[by.a2]
    right = right + p_2 @ (beta(by, alpha, bends) @ independent + drives(by, t, q, bends)) - drift
    q_ddot: Any = np.linalg.solve(by.inertia(t, q), right)
    return by.changed(t, q, v, q_ddot)


@equation
def beta(by: Dependent, alpha: Array, bends: Array) -> Array:
    """(2.65) β^{a2}_{a1 d} = ∂α_{a1}/∂q^d + ∂α_{a1}/∂q^c α^c_d − ∂α_d/∂q^{a1} − ∂α_d/∂q^c α^c_{a1}.

    (m − k, k, k), skew in the last two; bends as of `slopes_of`.
    """
    slopes = bends[:, :-1]
    turned = slopes[..., by.a1] + slopes[..., by.a2] @ alpha
    return turned - np.swapaxes(turned, 1, 2)


def drives(by: Dependent, t: float, q: Array, bends: Array) -> Array:
    """∂α_{a1}/∂q^c γ^c − ∂γ/∂q^{a1} − ∂γ/∂q^c α^c_{a1} + ∂α_{a1}/∂t (erratum 13): (m − k, k)."""
    alpha, gamma = by.solved(t, q)
    of_alpha, of_gamma = bends[:, :-1], bends[:, -1]
    changed = derivative(lambda t: by.alpha(t, q), (t,), (1.0,))
    return of_alpha[..., by.a2] @ gamma - of_gamma[:, by.a1] - of_gamma[:, by.a2] @ alpha + changed


def slopes_of(by: Dependent, t: float, q: Array, independent: Array) -> tuple[Array, Array]:
    """∂T'/∂q (m,), and ∂/∂q of α with γ behind it, (m − k, k + 1, m)."""

    def all_of(q: Any) -> Any:
        alpha, gamma = by.solved(t, q)
        T = by.system.T(t, q, by.joined(independent, alpha, gamma))
        return np.concatenate([np.atleast_1d(T), np.column_stack([alpha, gamma]).ravel()])

    slopes = np.stack([derivative(all_of, (q,), (e,)) for e in np.eye(len(q))], axis=-1)
    return slopes[0], slopes[1:].reshape(len(by.a2), len(by.a1) + 1, len(q))
