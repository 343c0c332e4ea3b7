"""Elliptic functions and integrals for the closed forms: mathematics, and no mechanics.

All take the modulus k and its complement k1 = √(1 − k²) apart, or k1 alone: 1 − k² would lose its
digits near the separatrix, where k1 is small. scipy's are imported where they are asked for: who
only reads a file does not wait for them.
"""

import math
from collections.abc import Callable
from typing import NamedTuple


class Amplitude(NamedTuple):
    """The angle φ + 2πn, |φ| ≤ π, by sin φ, cos φ and n.

    Near 90°, where k1 is small and the integrals are steep, its cosine has the digits that the
    angle itself has not.
    """

    sin: float
    cos: float
    turns: int = 0


def amplitude(u: float, k1: float) -> Amplitude:
    """am(u), k1 > 0: by Bulirsch's means of 1 and k1, from the cotangent of their limit back.

    R. Bulirsch, Numerische Mathematik 7 (1965) 78; u is reduced by whole periods. Of sine and
    cosine each keeps its digits, but for those of u.
    """
    a, b, means = 1.0, k1, list[tuple[float, float]]()
    while abs(a - b) > 1e-8 * a:  # one mean more is good to its square, half a unit in the last
        means.append((a, b))
        a, b = (a + b) / 2, math.sqrt(a * b)
    means.append((a, b))
    limit = (a + b) / 2
    period = 2 * math.pi / limit  # 4 K
    rest = math.remainder(u, period)
    turns = round((u - rest) / period)
    sin, cos = math.sin(rest * limit), math.cos(rest * limit)
    if sin == 0.0:
        return Amplitude(sin, cos, turns)
    ratio, dn = cos / sin, 1.0
    cot = limit * ratio
    for a, b in reversed(means):
        ratio *= cot
        cot *= dn
        dn = (b + ratio) / (a + ratio)
        ratio = cot / a
    sn = math.copysign(1 / math.sqrt(cot * cot + 1), sin)
    return Amplitude(sn, cot * sn, turns)


def jacobi(u: float, k1: float) -> tuple[float, float]:
    """sn(u), cn(u) of modulus √(1 − k1²), k1 > 0."""
    am = amplitude(u, k1)
    return am.sin, am.cos


def first(am: Amplitude, k1: float) -> float:
    """F = ∫₀ dφ/Δ, Δ² = cos² φ + k1² sin² φ = 1 − k² sin² φ: the u of an amplitude.

    By Carlson's form (DLMF 19.25.5), F = s R_F(c², Δ², 1).
    """
    from scipy.special import elliprf

    def quarter(s: float, c: float) -> float:
        return s * float(elliprf(c * c, c * c + k1 * k1 * s * s, 1.0))

    return _counted(quarter, am)


def third(am: Amplitude, k1: float, p: float) -> float:
    """∫₀ sin² φ dφ/((1 − n sin² φ) Δ), p = 1 − n > 0: what Π differs from F by, divided by n.

    By Carlson's form (DLMF 19.25.14), s³/3 R_J(c², Δ², 1, c² + p s²).
    """
    from scipy.special import elliprj

    def quarter(s: float, c: float) -> float:
        c2, s2 = c * c, s * s
        return s * s2 / 3 * float(elliprj(c2, c2 + k1 * k1 * s2, 1.0, c2 + p * s2))

    return _counted(quarter, am)


def _counted(quarter: Callable[[float, float], float], am: Amplitude) -> float:
    """An odd integral over half turns, and from the last of them on: an angle of −90° to 90°."""
    sin, cos, turns = am
    if cos >= 0.0:
        half = 0.0
    else:
        half, sin, cos = math.copysign(1.0, sin), -sin, -cos
    return 2 * (half + 2 * turns) * quarter(1.0, 0.0) + quarter(sin, cos)
