"""Equations with known solutions for the integrators, and scipy's answers to others."""

from collections.abc import Callable
from math import asin, cos, sin
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipj, ellipk

from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.integrators.implicit import radau
from textmech.reference.integrators.march import Slope, Vector

Solution = Callable[[float], Vector]
BOTH = pytest.mark.parametrize("method", [dormand_prince, radau])


def linear(t: float, y: Vector) -> Vector:
    """y' = -2 t y + 2 t + cos t exp(-t^2): it depends on time, and the solution is known."""
    return -2.0 * t * y + 2.0 * t + cos(t) * np.exp(-t * t)


def linear_solution(t: float) -> Vector:
    return np.array([1.0 + sin(t) * np.exp(-t * t)])


def oscillator(t: float, y: Vector) -> Vector:
    return np.array([y[1], -y[0]])


def oscillator_solution(t: float) -> Vector:
    return np.array([cos(t), -sin(t)])


ECCENTRICITY = 0.3


def kepler(t: float, y: Vector) -> Vector:
    cube = (y[0] * y[0] + y[1] * y[1]) ** 1.5
    return np.array([y[2], y[3], -y[0] / cube, -y[1] / cube])


def kepler_solution(t: float) -> Vector:
    e, b = ECCENTRICITY, np.sqrt(1.0 - ECCENTRICITY**2)
    angle = t
    for _ in range(20):  # Newton on Kepler's equation, far more often than needed
        angle -= (angle - e * sin(angle) - t) / (1.0 - e * cos(angle))
    rate = 1.0 / (1.0 - e * cos(angle))
    return np.array([cos(angle) - e, b * sin(angle), -sin(angle) * rate, b * cos(angle) * rate])


def pendulum(t: float, y: Vector) -> Vector:
    return np.array([y[1], -sin(y[0])])


def pendulum_solution(t: float) -> Vector:
    """Released at rest from 2 rad."""
    k = sin(1.0)
    sn, cn, *_ = ellipj(float(ellipk(k * k)) - t, k * k)
    return np.array([2.0 * asin(k * float(sn)), -2.0 * k * float(cn)])


def double_pendulum(t: float, y: Vector) -> Vector:
    """Unit masses and lengths, angles from the vertical."""
    a, b, u, v = y.tolist()
    s, c, g = sin(a - b), cos(a - b), 9.81
    d = 2.0 - c * c
    return np.array(
        [
            u,
            v,
            (-2.0 * g * sin(a) + g * sin(b) * c - s * (v * v + u * u * c)) / d,
            (2.0 * s * u * u + 2.0 * g * sin(a) * c - 2.0 * g * sin(b) + s * c * v * v) / d,
        ]
    )


# With the time over which the order is measured; for Kepler it ends before the errors of the two
# halves of the orbit begin to cancel.
PROBLEMS = {
    "linear": (linear, linear_solution, 2.0),
    "oscillator": (oscillator, oscillator_solution, 6.0),
    "kepler": (kepler, kepler_solution, 1.5),
    "pendulum": (pendulum, pendulum_solution, 6.0),
}


def by_scipy(f: Slope, times: Vector, start: list[float], **options: Any) -> Vector:
    return solve_ivp(f, (times[0], times[-1]), start, t_eval=times, **options).y.T
