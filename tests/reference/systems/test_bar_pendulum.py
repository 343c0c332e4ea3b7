"""The closed form of the pendulum, by elliptic functions of another library."""

import math

import mpmath
import numpy as np
import pytest
from given.examples import example

_RATIOS = ("cd", "sd", "nd")  # Glaisher's cn/dn, sn/dn, 1/dn


@pytest.mark.parametrize("degrees", [24.6, -200.0, -89.0, 89.0, 89.999, 271.0, -269.999])
def test_bar_pendulum_closed_form_against_mpmath(degrees: float):
    """To 1e-13 over 10 s, if it is not released near the top.

    There the rounding of the angle of release, 1e-16 of 1, moves the later fall by
    1e-16 / cos(θ₀/2) s and more.
    """
    phi0 = math.radians(degrees)
    system = example("bar_pendulum", phi0=phi0)
    with mpmath.workdps(40):
        theta0 = mpmath.mpf(phi0) + mpmath.pi / 2
        theta0 -= 2 * mpmath.pi * mpmath.nint(theta0 / (2 * mpmath.pi))
        k, k1 = mpmath.sin(theta0 / 2), mpmath.cos(theta0 / 2)
        Omega = mpmath.sqrt(3 * mpmath.mpf(9.80665) / (2 * mpmath.mpf(0.8)))
        for t in np.linspace(0.0, 10.0, 21):
            cd, sd, nd = (mpmath.ellipfun(f, Omega * mpmath.mpf(t), m=k**2) for f in _RATIOS)
            theta = 2 * mpmath.asin(k * cd)
            rate = -2 * Omega * k * k1**2 * sd * nd / mpmath.sqrt(1 - (k * cd) ** 2)
            known = system.closed_form(float(t))
            assert known is not None
            margin = 1e-13 + 3e-15 / float(k1)
            assert abs(known[0][0] - (mpmath.mpf(phi0) + theta - theta0)) < margin
            assert abs(known[1][0] - rate) < Omega * margin
