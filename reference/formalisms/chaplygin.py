"""Chaplygin's equations (2.67): where nothing depends on q^{a2} the others move as if alone."""

from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode
from .dependent import dependent
from .lagrange import derivative, momentum
from .voronets import slopes_of

ROUNDING = 1e-14  # of the largest derivative: what is below it comes from terms that cancel


@equation
def accelerations(system: Mode, t: float, q: Array, v: Array) -> Array | None:
    """(2.67) d/dt ∂T'/∂q̇ − ∂T'/∂q = Π + ∂T/∂q̇^{a2} (∂α_{a1}/∂q^d − ∂α_d/∂q^{a1}) q̇^d, of a1.

    v̇ (n,), or None where it does not apply: T and the constraints depend on too many coordinates.
    Of α and γ that depend on time or a right side there is ∂α_{a1}/∂t − ∂γ/∂q^{a1} more.
    """
    by = dependent(system, t, q, len(v), ignorable(system, t, q, v))
    if by is None or not len(by.a2):
        return None
    q_dot = system.rates(t, q, v)
    independent = q_dot[by.a1]
    alone = np.zeros(len(q))  # q^{a2} stays where it is: it is not asked for
    alone[by.a1] = independent
    drift = derivative(lambda t, q: by.momentum(t, q, independent), (t, q), (1.0, alone))
    slopes, bends = (array[..., by.a1] for array in slopes_of(by, t, q, independent))
    turned = bends[:, :-1] - np.swapaxes(bends[:, :-1], 1, 2)
    driven = derivative(lambda t: by.alpha(t, q), (t,), (1.0,)) - bends[:, -1]
    right = slopes + by.forces(t, q, v) - drift
    p_2 = momentum(system, t, q, q_dot, even=True)[by.a2]
    right = right + p_2 @ (turned @ independent + driven)
    q_ddot: Any = np.linalg.solve(by.inertia(t, q), right)
    return by.changed(t, q, v, q_ddot)


def ignorable(system: Mode, t: float, q: Array, v: Array) -> list[int]:
    """The coordinates on which neither T nor the constraints depend, as far as this state tells."""

    def ingredients(q: Any) -> Any:
        q_dot = system.rates(t, q, v)
        parts = (system.T(t, q, q_dot), momentum(system, t, q, q_dot), q_dot)
        bound = (system.f_a(t, q), system.g(t, q))
        return np.concatenate([np.ravel(part) for part in (*parts, *bound)])

    largest, nonzero = np.zeros(()), list[tuple[Any, Any]]()
    for e in np.eye(len(q)):
        slopes = np.abs(derivative(ingredients, (q,), (e,)))
        largest = np.maximum(largest, slopes)
        where = np.flatnonzero(slopes)  # few: a chain's constraints each depend on two bodies
        nonzero.append((where, slopes[where]))
    below = (np.all(slopes <= ROUNDING * largest[where]) for where, slopes in nonzero)
    return [k for k, ignored in enumerate(below) if ignored]
