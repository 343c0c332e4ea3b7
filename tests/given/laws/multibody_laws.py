"""The laws of any generated mode, relative to the largest term."""

from collections.abc import Callable

import numpy as np

from textmech.reference.formalisms import energy, lagrange
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.system import Array

EXACT = 1e-12  # of the largest term


def lagrangian(mechanism: Multibody, t: float, q: Array, v: Array) -> float:
    """(2.60) Explicit accelerations against T, U, D, Q₄, f_a, g, relative to the largest term."""
    a, lam = lagrange.multipliers(mechanism, t, q, v)
    terms = [np.abs(a), *(np.abs(mechanism.f_a(t, q) * lam[:, None]) / mechanism.where.masses)]
    return float(np.max(np.abs(mechanism.accelerations(t, q, v) - a)) / np.max(terms))


def balance(mechanism: Multibody, t: float, q: Array, v: Array) -> float:
    """(2.51) The power that is not accounted for, relative to the power of all forces together."""
    lam = lagrange.multipliers(mechanism, t, q, v)[1]
    power = np.abs(mechanism.f_a(t, q) * lam[:, None] * v).sum()
    power += np.abs(mechanism.accelerations(t, q, v) * mechanism.where.masses * v).sum()
    return abs(energy.power_balance(mechanism, t, q, v)) / (power or 1.0)  # 0: nothing can move


Law = Callable[[Multibody, float, Array, Array], float]
