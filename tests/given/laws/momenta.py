"""Momentum and angular momentum of moving bodies, and what changes them, in integral form.

Each law is the largest difference along the motion between a change and the integral of what makes
it, relative to the largest value of that integral, or of the momentum itself. All vectors are in
ground axes, (N, 3) at the sample times.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from textmech.reference.laws.momentum import angular_momentum, moment_change
from textmech.reference.system import Array

from .spatial_laws import matrix


@dataclass(frozen=True)
class Moving:
    """A body: m, J (3, 3) in body axes, r, R (N, 3, 3), ṙ, ω in ground axes."""

    m: float
    J: Array
    r: Array
    R: Array
    v: Array
    omega: Array

    def D(self, A: Array, v_A: Array) -> Array:
        """(2.24) About a point A from the velocities relative to it, (N, 3)."""
        rows = zip(self.R, self.r - A, self.v - v_A, self.omega, strict=True)
        return np.array(
            [angular_momentum(self.m, R @ self.J @ R.T, r, v, w) for R, r, v, w in rows]
        )


@dataclass(frozen=True)
class Acting:
    """An outer force (N, 3) at a point (N, 3)."""

    at: Array
    force: Array


@dataclass(frozen=True)
class Point:
    """Any moving point: place, velocity and acceleration, (N, 3) each."""

    r: Array
    v: Array
    a: Array


def samples(duration: float, n: int) -> Array:
    """(n + 1,) Chebyshev points from 0: between them polynomials of degree n are known."""
    return duration / 2 * (1 - np.cos(np.pi * np.arange(n + 1) / n))


def spatial(m: float, J: Array, states: Array) -> Moving:
    """A body of these states (N, 13)."""
    R = np.array([matrix(e) for e in states[:, 3:7]])
    omega = np.einsum("nij,nj->ni", R, states[:, 10:])
    return Moving(m, J, states[:, :3], R, states[:, 7:10], omega)


def planar(m: float, J33: float, states: Array) -> Moving:
    """A body of the plane, states (N, 6), as one of space that stays in it."""
    x, y, angle, vx, vy, spin = states.T
    zero, one = np.zeros_like(x), np.ones_like(x)
    cos, sin = np.cos(angle), np.sin(angle)
    rows = [[cos, -sin, zero], [sin, cos, zero], [zero, zero, one]]
    R = np.moveaxis(np.array(rows), 2, 0)
    r, v, omega = (np.stack(z, axis=1) for z in ((x, y, zero), (vx, vy, zero), (zero, zero, spin)))
    return Moving(m, np.diag([0.0, 0.0, J33]), r, R, v, omega)


def wandering(times: Array) -> Point:
    """A point that belongs to nothing: r_A = (½ sin 3t, t², 0.2 + 0.4 cos 2t)."""
    t, zero = times, np.zeros_like(times)
    r = [np.sin(3 * t) / 2, t * t, 0.2 + 0.4 * np.cos(2 * t)]
    v = [1.5 * np.cos(3 * t), 2 * t, -0.8 * np.sin(2 * t)]
    a = [-4.5 * np.sin(3 * t), zero + 2, -1.6 * np.cos(2 * t)]
    return Point(*(np.stack(part, axis=1) for part in (r, v, a)))


@dataclass(frozen=True)
class System:
    """Bodies and the outer forces on them along a motion; what acts between them is no one's."""

    times: Array
    bodies: Mapping[str, Moving]
    forces: Sequence[Acting]

    @property
    def m(self) -> float:
        return math.fsum(body.m for body in self.bodies.values())

    @property
    def centre(self) -> Array:
        """(N, 3) r_c of all bodies together."""
        return sum(b.m * b.r for b in self.bodies.values()) / self.m  # type: ignore[return-value]

    @property
    def p(self) -> Array:
        """(2.22) p = Σ m ṙ_c, (N, 3)."""
        return np.sum([b.m * b.v for b in self.bodies.values()], axis=0)

    def D(self, A: Array | float, v_A: Array | float) -> Array:
        """(N, 3) about a point, of all bodies."""
        zero = np.zeros_like(self.centre)
        return np.sum([b.D(zero + A, zero + v_A) for b in self.bodies.values()], axis=0)

    def moment(self, A: Array | float) -> Array:
        """M_A (N, 3)."""
        return np.sum([np.cross(f.at - A, f.force) for f in self.forces], axis=0)

    def law(self, changes: Array, by: Array) -> float:
        """How far a momentum is from its first value and the integral of what changes it."""
        made = integral(self.times, by)
        size = max(np.abs(made).max(), np.abs(changes).max())
        return float(np.abs(changes - changes[0] - made).max() / size)


def integral(times: Array, values: Array) -> Array:
    """(N, 3) from the first sample on, of the polynomial through all of them."""
    n, T = len(times) - 1, times[-1]
    x = 2 * times / T - 1
    coefficients: Any = np.linalg.solve(np.polynomial.chebyshev.chebvander(x, n), values)
    whole = np.polynomial.chebyshev.chebint(coefficients, lbnd=-1, axis=0)
    return np.polynomial.chebyshev.chebval(x, whole).T * T / 2


def momentum(s: System) -> float:
    """(2.23) ṗ = F."""
    return s.law(s.p, np.sum([f.force for f in s.forces], axis=0))


def about_the_origin(s: System) -> float:
    """(2.25) Ḋ₀ = M₀."""
    return s.law(s.D(0.0, 0.0), s.moment(0.0))


def about_the_centre(s: System) -> float:
    """(2.27) Ḋ_c = M_c."""
    return s.law(s.D(s.centre, s.p / s.m), s.moment(s.centre))


def about_a_moving_point(s: System) -> float:
    """(2.28) Ḋ_A = M_A + m r̈_A × a, a = AC, D_A from velocities relative to A."""
    A = wandering(s.times)
    rows = zip(s.moment(A.r), A.a, s.centre - A.r, strict=True)
    by = np.array([moment_change(M, s.m, a_A, a) for M, a_A, a in rows])
    return s.law(s.D(A.r, A.v), by)


def from_absolute_velocities(s: System) -> float:
    """Erratum 3: D_A from absolute velocities obeys Ḋ_A = M_A − m v_A × v_C."""
    A = wandering(s.times)
    return s.law(s.D(A.r, 0.0), s.moment(A.r) - np.cross(A.v, s.p))


LAWS = (
    momentum, about_the_origin, about_the_centre, about_a_moving_point, from_absolute_velocities,
)  # fmt: skip
LIMIT = 1e-13  # of the largest momentum: rounding of the motion and of the integral, 2e-15 here
