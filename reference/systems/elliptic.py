"""Elliptic functions and integrals for the closed forms: mathematics, and no mechanics.

All take the modulus k and its complement k1 = √(1 − k²) apart, or k1 alone: 1 − k² would lose its
digits near the separatrix, where k1 is small. An amplitude is counted: φ in [−π, π] and n whole
turns stand for φ + 2πn.
"""

import math
from collections.abc import Callable

from scipy.special import elliprf, elliprj

Amplitude = tuple[float, int]


def amplitude(u: float, k: float, k1: float) -> Amplitude:
    """am(u) of modulus k, k1 = √(1 − k²) > 0, by Gauss' descending transformation.

    Abramowitz and Stegun, 16.4: sin(2φₙ₋₁ − φₙ) = (cₙ/aₙ) sin φₙ. It takes the modulus and its
    complement apart, which `scipy.special.ellipj` does not, and reduces u by whole periods. The
    angle of that sine comes from its cosine too, aₙ² − cₙ² = bₙ²: near 90° the sine is not enough.
    """
    a, b, c = 1.0, k1, k
    means: list[tuple[float, float, float]] = []  # aₙ, bₙ, cₙ from n = 1 on
    while abs(c) > 1e-16:  # half a unit in the last place of a: what is left is rounding
        a, b, c = (a + b) / 2, math.sqrt(a * b), (a - b) / 2
        means.append((a, b, c))
    period = 2 * math.pi / a  # 4 K
    rest = math.remainder(u, period)
    phi = rest * a * 2 ** len(means)
    for a_n, b_n, c_n in reversed(means):
        sin, cos = math.sin(phi), math.cos(phi)
        phi = (phi + math.atan2(c_n * sin, math.hypot(a_n * cos, b_n * sin))) / 2
    return phi, round((u - rest) / period)


def jacobi(u: float, k: float, k1: float) -> tuple[float, float]:
    """sn(u), cn(u) of modulus k, k1 = √(1 − k²) > 0."""
    phi, _ = amplitude(u, k, k1)
    return math.sin(phi), math.cos(phi)


def first(phi: float, turns: int, k1: float) -> float:
    """F = ∫₀ dφ/Δ, Δ² = cos² φ + k1² sin² φ = 1 − k² sin² φ: the u of an amplitude.

    By Carlson's form (DLMF 19.25.5), F = s R_F(c², Δ², 1).
    """

    def quarter(s: float, c: float) -> float:
        return s * float(elliprf(c * c, c * c + k1 * k1 * s * s, 1.0))

    return _counted(quarter, phi, turns)


def third(phi: float, turns: int, k1: float, p: float) -> float:
    """∫₀ sin² φ dφ/((1 − n sin² φ) Δ), p = 1 − n > 0: what Π differs from F by, divided by n.

    By Carlson's form (DLMF 19.25.14), s³/3 R_J(c², Δ², 1, c² + p s²).
    """

    def quarter(s: float, c: float) -> float:
        c2, s2 = c * c, s * s
        return s * s2 / 3 * float(elliprj(c2, c2 + k1 * k1 * s2, 1.0, c2 + p * s2))

    return _counted(quarter, phi, turns)


def _counted(quarter: Callable[[float, float], float], phi: float, turns: int) -> float:
    """An odd integral over half turns, and from the last of them: by sin and cos of −π/2 … π/2."""
    half = round(phi / math.pi)
    rest = phi - half * math.pi
    return 2 * (half + 2 * turns) * quarter(1.0, 0.0) + quarter(math.sin(rest), math.cos(rest))
