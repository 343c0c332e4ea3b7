"""Elliptic functions and integrals of the closed forms, by another library with more digits."""

import math

import mpmath
import pytest

from textmech.reference.systems.elliptic import amplitude, first, third

K1 = (1.0, 0.8, 0.1, 1e-3, 1e-7)  # from circles to the neighbourhood of the separatrix
ANGLES = (-3.1, -math.pi / 2, -0.4, 0.0, 1e-9, 1.2, math.pi / 2, 2.5, math.pi)


@pytest.mark.parametrize("k1", K1)
def test_integrals_of_the_first_and_third_kind(k1: float):
    """F, and (Π − F)/n, counted over turns; p = 1 − n on both sides of 1."""
    with mpmath.workdps(40):
        m = 1 - mpmath.mpf(k1) ** 2
        for phi, turns in [*((angle, 0) for angle in ANGLES), (0.7, 2), (-2.0, -3)]:
            whole = mpmath.mpf(phi) + 2 * mpmath.pi * turns
            F = mpmath.ellipf(whole, m)
            assert first(phi, turns, k1) == pytest.approx(float(F), rel=5e-15, abs=1e-300)
            for p in (0.03, 0.6, 2.5):
                n = 1 - mpmath.mpf(p)
                known = (mpmath.ellippi(n, whole, m) - F) / n
                assert third(phi, turns, k1, p) == pytest.approx(float(known), rel=2e-14, abs=1e-35)


@pytest.mark.parametrize("k1", K1)
@pytest.mark.parametrize("u", [-40.0, -1.3, 0.0, 0.2, 7.0, 55.0])
def test_the_amplitude_is_the_inverse_of_the_first_integral(u: float, k1: float):
    """(φ, n) counted: F(φ + 2πn) = u, but for what φ's last digit is worth, dF = dφ/Δ."""
    phi, turns = amplitude(u, math.sqrt((1 - k1) * (1 + k1)), k1)
    assert abs(phi) <= math.pi
    digit = 2.2e-16 * max(abs(phi), 1.0) / math.hypot(math.cos(phi), k1 * math.sin(phi))
    assert abs(first(phi, turns, k1) - u) <= 5e-15 * abs(u) + 3 * digit


def test_turns_are_counted():
    """A circle: am(u) = u."""
    phi, turns = amplitude(20.0, 0.0, 1.0)
    assert turns == 3
    assert phi + 2 * math.pi * turns == pytest.approx(20.0, abs=1e-14)
