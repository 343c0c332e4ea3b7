"""The optimality of soft constraints' forces, after E. Todorov's convex law of contact.

Convex and analytically-invertible dynamics with contacts and constraints, ICRA 2014. The law as it
is documented there and with the engine that has it: the forces are

    f = arg min ½ λᵀ R λ + λᵀ (J a − a_ref)   among λ in Ω,

Ω being what bounds them: |f| ≤ loss of dry friction, f ≥ 0 of limits and of a pyramid's edges,
f₁² ≥ Σ f_j² / μ_j² of an elliptic cone, and nothing of equalities. So f is −R⁻¹ (J a − a_ref),
projected into Ω in the metric of R. With M a = smooth + Jᵀ f these are all conditions of a convex
problem: who meets them has its one solution, whatever it was found by.
"""

from collections.abc import Iterator

import numpy as np

from ...cases.constraints import Constrained, Constraint
from ..system import Array


def balance(state: Constrained) -> tuple[Array, Array]:
    """Returns M a − smooth − Jᵀ f (n,), and the largest (n,) that it could be, whatever cancels.

    A component of a force is at most √M_ii √(Fᵀ M⁻¹ F) (Cauchy–Schwarz).
    """
    M, J, a, smooth = state.M, state.J, state.a, state.smooth
    forces = np.abs(state.f)
    for constraint, _, size in differences(state):
        rows = constraint.rows
        forces[rows] = np.maximum(forces[rows], size * _units(constraint))
    terms = np.column_stack([M @ a, smooth, J.T * forces])
    lengths = np.sqrt(np.abs((terms * np.linalg.solve(M, terms)).sum(axis=0)))
    return M @ a - smooth - J.T @ state.f, np.sqrt(np.diag(M)) * lengths.sum()


def differences(state: Constrained) -> Iterator[tuple[Constraint, float, float]]:
    """Yields each constraint with how far off its force is from the law's, and of what size.

    Components of a cone count as they do in it: by the normal force that they need.
    """
    J, a, R = state.J, state.a, state.R
    free = (state.a_ref - J @ a) / R  # what the forces were if nothing bounded them
    sizes = (np.abs(J) @ np.abs(a) + np.abs(state.a_ref)) / R
    for constraint in state.constraints:
        rows, unit = constraint.rows, _units(constraint)
        force = projected(constraint, free[rows], R[rows])
        error = np.abs(state.f[rows] - force) / unit
        yield constraint, float(error.max()), float((sizes[rows] / unit).max())


def _units(constraint: Constraint) -> Array:
    return np.array([1.0, *constraint.bounds]) if constraint.bound == "cone" else np.ones(1)


def projected(constraint: Constraint, free: Array, R: Array) -> Array:
    """Returns the force (k,) of Ω that is nearest to a free one in the metric of R (k,)."""
    if constraint.bound == "none":
        return free
    if constraint.bound == "one way":
        return np.maximum(free, 0.0)
    if constraint.bound == "loss":
        return np.clip(free, -constraint.bounds, constraint.bounds)
    return _in_cone(free, constraint.bounds, R)


def _in_cone(free: Array, mu: Array, R: Array) -> Array:
    """Returns the force (k,) nearest to a free one among those with f₁ ≥ |y|, y_j = f_j / μ_j.

    The law makes all R_j μ_j² of friction equal: in y the metric is R₁ beside one ρ.
    """
    normal, y, rho = free[0], free[1:] / mu, R[1] * mu[0] ** 2
    aside = np.linalg.norm(y)
    if aside <= normal:  # it sticks
        return free
    if R[0] * normal + rho * aside <= 0.0:  # beyond the tip, whose side is that cone's dual
        return np.zeros_like(free)
    pressed = (R[0] * normal + rho * aside) / (R[0] + rho)  # it slips, along the nearest ray
    return np.concatenate([[pressed], mu * y / aside * pressed])
