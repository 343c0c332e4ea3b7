"""Appell's equations (2.80): the energy of the accelerations, by the accelerations left free.

The bodies' accelerations come from `poses`; T plays no part.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from ..coverage import equation
from ..system import Array, Mode, Vector
from .dependent import Dependent, dependent
from .derivative import along
from .wrench import gyroscopic, velocity


@equation
def accelerations(
    system: Mode, t: float, q: Array, v: Array, among: Sequence[int] | None = None
) -> Array | None:
    """(2.80) ∂S/∂q̈^{a1} = Π_{a1}: v̇ (n,), with dependent rates chosen `among` some, or all.

    None if those cannot be it.
    """
    by = dependent(system, t, q, len(v), among)
    if by is None:
        return None
    k = len(by.a1)
    still = body_accelerations(system, t, q, v, by.changed(t, q, v, np.zeros(k)))
    free = free_accelerations(by, t, q, v)
    gyro = np.array([gyroscopic(mass, pose) for mass, pose in _bodies(system, t, q, v)])

    def slope(rates: Array, gyro: Array) -> Array:
        """∂S/∂q̈^{a1} (k,): a column for each, and all of them at once."""
        return along(lambda rates: energy(system, rates, gyro), (rates[..., None],), (free,))

    bend = [slope(free[..., i], 0.0 * gyro) for i in range(k)]
    right = by.forces(t, q, v) - slope(still, gyro)
    q_ddot: Any = np.linalg.solve(np.stack(bend, axis=1), right)
    return by.changed(t, q, v, q_ddot)


@equation
def energy(system: Mode, rates: Vector, gyro: Array) -> Any:
    """(2.77) S = ½ ∫ r̈² dm = Σ ½ m r̈_c² + ½ ω̇ · J ω̇ + ω̇ · (ω × J ω), and what has no q̈ [W/s].

    Of r̈_c and ω̇ (N, 3) or (N, 6), and of ω × J ω in the same columns; or of many at once, (…, K).
    """
    S = 0.0
    for mass, rate, turning in zip(system.masses.values(), rates, gyro, strict=True):
        d = (len(rate) + 1) // 2
        S = S + mass.m * (rate[:d] * rate[:d]).sum(axis=0) / 2
        if mass.J is not None:
            S = S + (rate[d:] * np.dot(mass.J, rate[d:])).sum(axis=0) / 2 + turning[d:] @ rate[d:]
    return S


@equation
def body_accelerations(system: Mode, t: float, q: Array, v: Array, a: Array) -> Array:
    """(2.73) r̈_c and ω̇ of every body (N, 3) or (N, 6) of v̇ = a, by differentiating `poses`."""
    direction = (1.0, system.rates(t, q, v), a)
    return along(_velocities(system), (t, q, v), direction)


@equation
def free_accelerations(by: Dependent, t: float, q: Array, v: Array) -> Array:
    """(2.74) ∂r̈/∂q̈^{a1} = g_{a1} (N, ·, k): how the bodies go along each independent rate."""
    ways, still = by.ways(t, q).T, 0.0 * q
    velocities = _velocities(by.system)
    return np.stack([along(velocities, (t, q, v), (0.0, still, way)) for way in ways], axis=-1)


def _velocities(system: Mode) -> Callable[..., Any]:
    def velocities(t: Any, q: Any, v: Any) -> Any:
        poses = system.poses(t, q, v)
        return np.array([velocity(poses[name]) for name in system.masses])

    return velocities


def _bodies(system: Mode, t: float, q: Array, v: Array) -> list[Any]:
    poses = system.poses(t, q, v)
    return [(mass, poses[name]) for name, mass in system.masses.items()]
