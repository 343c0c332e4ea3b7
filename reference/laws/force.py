"""Force laws in the book's letters: weight, spring, viscous damper."""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..coverage import equation
from ..system import Array


@equation
def weight(m: float, g: ArrayLike) -> Array:
    """(2.81) F = m g [N]: g (2,) or (3,) the acceleration of gravity as a vector."""
    return m * np.asarray(g, dtype=np.float64)


@equation
def spring(c: float, l0: float, d: ArrayLike) -> Array:
    """(2.82) F = −c (λ − λ₀) along the spring [N]: the force on the first end: (2,), in space (3,).

    d runs from the first end to the second and λ = |d|: stretched, it pulls along d. λ > 0
    unless λ₀ = 0, where F = c d needs no direction.
    """
    entries = np.asarray(d, dtype=np.float64).tolist()
    if l0 == 0.0:
        return np.array([c * x for x in entries])
    l = math.sqrt(sum([x * x for x in entries]))
    return np.array(entries) * (c * (l - l0) / l)


@equation
def torsion(c: float, phi0: float, phi: float) -> float:
    """(2.45) M = −c (φ − φ₀) [N m] on the second part of a joint, φ its angle against the first."""
    return -c * (phi - phi0)


@equation
def torsion_damper(d: float, phi_dot: float) -> float:
    """(2.47) M = −d φ̇ [N m] on the second part of a joint."""
    return -d * phi_dot


@equation
def magnetic(e: float, B: float, v: ArrayLike) -> Array:
    """(2.49) F = e v × B [N], (2,): of a charge +e in B e_z, to its right for e B > 0."""
    x_dot, y_dot = np.asarray(v, dtype=np.float64).tolist()
    return np.array([e * B * y_dot, -e * B * x_dot])


@equation
def damper(d: float, r: ArrayLike, r_dot: ArrayLike) -> Array:
    """(2.47) F = −d λ̇ along the damper [N]: the force on the first end: (2,), in space (3,).

    r runs from the first end to the second, λ = |r| > 0, λ̇ = r·ṙ/λ.
    """
    entries = np.asarray(r, dtype=np.float64).tolist()
    speeds = np.asarray(r_dot, dtype=np.float64).tolist()
    along = sum([x * v for x, v in zip(entries, speeds, strict=True)])
    return np.array(entries) * (d * along / sum([x * x for x in entries]))


# Laws of a muscle's contractile element (figure 2.17): how fast it shortens under a force.


def hill(F_0: float, a: float, b: float, F: Any) -> Any:
    """v = b (F₀ − F)/(F + a) [m/s] of (F + a)(v + b) = (F₀ + a) b, F > −a: v < 0 above F₀."""
    return b * (F_0 - F) / (F + a)


def linear(F_0: float, b: float, F: Any) -> Any:
    """v = (F₀ − F)/b [m/s] of F = F₀ − b v."""
    return (F_0 - F) / b
