"""Elliptic functions and integrals of the closed forms, by another library with more digits."""

import math

import mpmath
import pytest

from textmech.reference.systems.elliptic import Amplitude, amplitude, first, third

K1 = (1.0, 0.8, 0.1, 1e-3, 1e-7)  # from circles to the neighbourhood of the separatrix
ANGLES = (-3.1, -math.pi / 2, -0.4, 0.0, 1e-9, 1.2, math.pi / 2, 2.5, math.pi)
COUNTED = [*((angle, 0) for angle in ANGLES), (0.7, 2), (-2.0, -3)]


@pytest.mark.parametrize("k1", K1)
def test_integrals_of_the_first_and_third_kind(k1: float):
    """F, and (Π − F)/n, counted over turns; p = 1 − n on both sides of 1."""
    with mpmath.workdps(30):
        m = 1 - mpmath.mpf(k1) ** 2
        for phi, turns in COUNTED:
            am = Amplitude(math.sin(phi), math.cos(phi), turns)
            whole = mpmath.mpf(phi) + 2 * mpmath.pi * turns
            F = mpmath.ellipf(whole, m)
            assert first(am, k1) == pytest.approx(float(F), rel=5e-15, abs=1e-300)
            for p in (0.03, 2.5):
                n = 1 - mpmath.mpf(p)
                known = (mpmath.ellippi(n, whole, m) - F) / n
                assert third(am, k1, p) == pytest.approx(float(known), rel=2e-14, abs=1e-35)


@pytest.mark.parametrize("k1", K1)
@pytest.mark.parametrize("u", [-40.0, -1.3, 0.0, 0.2, 7.0, 55.0])
def test_the_amplitude_is_the_inverse_of_the_first_integral(u: float, k1: float):
    """F(am u) = u, also where the angle is so near 90° that its own digits do not tell."""
    am = amplitude(u, k1)
    assert am.sin**2 + am.cos**2 == pytest.approx(1.0, abs=5e-16)
    assert first(am, k1) == pytest.approx(u, rel=1e-14, abs=1e-15)


@pytest.mark.parametrize("k1", K1[:-1])
def test_jacobi_functions_keep_their_digits(k1: float):
    """sn and cn to 1e-14 of themselves, also a cn of 1e-3 beside a quarter of the period."""
    with mpmath.workdps(30):
        m = 1 - mpmath.mpf(k1) ** 2
        K = mpmath.ellipk(m)
        for part in (0.1, 0.5, 0.9, 1.2, -1.7):
            u = float(part * K)
            sn, cn = (mpmath.ellipfun(f, mpmath.mpf(u), m=m) for f in ("sn", "cn"))
            am = amplitude(u, k1)
            assert (am.sin, am.cos) == pytest.approx((float(sn), float(cn)), rel=1e-14)


def test_turns_are_counted():
    """A circle: am(u) = u."""
    assert amplitude(20.0, 1.0) == pytest.approx((math.sin(20.0), math.cos(20.0), 3), abs=1e-14)
