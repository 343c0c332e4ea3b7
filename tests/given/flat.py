"""When a falling parallelogram lies flat."""

import numpy as np


def time_to_flat() -> float:
    """When [s] `parallelogram` lies flat: ½ J α̇² = 2 m g a (sin α₀ − sin α), so that t = ∫ dα/α̇."""
    J, weight = 2 * 0.3**2 / 3 + 0.3**2, 2 * 9.80665 * 0.3  # two cranks, one coupler of 1 kg
    # α = α₀ − s², by Gauss: the integrand is then smooth at the start
    s, weights = np.polynomial.legendre.leggauss(40)
    half = np.sqrt(np.radians(70)) / 2
    s, weights = half * (s + 1), half * weights
    fallen = np.sin(np.radians(70)) - np.sin(np.radians(70) - s**2)
    return float(np.sum(weights * 2 * s / np.sqrt(2 * weight * fallen / J)))
