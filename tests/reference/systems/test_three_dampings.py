"""The closed form of a damped spring by the roots of its characteristic equation."""

from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech.cases.trajectory import Array
from textmech.reference.systems.particles import spring_mass_damper

G = 9.80665  # m/s²
M, C, L0, Y0 = 1.3, 40.0, 0.4, -0.2
CRITICAL = 2 * np.sqrt(C * M)
TIMES = (0.1, 0.6, 1.7)


def by_roots(d: float, t: float) -> tuple[float, float]:
    """m r² + d r + c = 0: z = A e^{r₁t} + B e^{r₂t} about the rest, from rest."""
    one, other = np.roots([M, d, C]).astype(complex)
    rest = -L0 - M * G / C
    a, b = np.linalg.solve(np.array([[1, 1], [one, other]]), np.array([Y0 - rest, 0.0]))
    z = a * np.exp(one * t) + b * np.exp(other * t)
    return rest + z.real, (a * one * np.exp(one * t) + b * other * np.exp(other * t)).real


def off(part: float, module: Any = spring_mass_damper) -> float:
    """How far the closed form is from that, where damped so many times as critically."""
    d = part * CRITICAL
    system = module.SpringMassDamper(m=M, c=C, d=d, l0=L0, y0=Y0)
    found: list[Array] = [np.concatenate(system.closed_form(t)) for t in TIMES]
    return float(np.max(np.abs(np.array(found) - [by_roots(d, t) for t in TIMES])))


@pytest.mark.mutant("the hyperbolic cosine of an overdamped spring squared")
@pytest.mark.parametrize("part", [0.05, 0.7, 1.3, 8.0])
def test_the_closed_form_is_the_roots(part: float) -> None:
    assert off(part) < 1e-12  # 3e-15
    was = "(1 + math.exp(-2 * kappa * t)) / 2"
    squared = otherwise(spring_mass_damper, was, was.replace("/ 2", "** 2"))
    assert (off(part, squared) > 1e-2) == (part > 1)
