"""The Radau IIA collocation methods: s stages, order 2s - 1, L-stable, last node at the step's end.

E. Hairer, G. Wanner, Solving Ordinary Differential Equations II, 2nd ed. (1996), sections IV.5
(the methods) and IV.8 (the error estimate).  Every figure is computed from the definition.
"""

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.polynomial import Legendre
from numpy.polynomial.legendre import leggauss
from numpy.typing import NDArray


@dataclass(frozen=True)
class Collocation:
    """Stage matrix, nodes, and what judges a step from its stage increments z.

    The weights of the step itself are the last row of `a`, since the last node is 1.  The error
    estimate is `gamma` h f(t, y) + `error` . z, and `leading` . z measures the last term of the
    Taylor series that the stages resolve.

    `values` are the eigenvalues of `a`, one of each pair, the real ones first; with the rows `into`
    and the columns `back` a product a x is the real part of back (values * (into x)).
    """

    a: NDArray[np.float64]
    c: NDArray[np.float64]
    gamma: float
    error: NDArray[np.float64]
    leading: NDArray[np.float64]
    values: NDArray[np.complex128]
    into: NDArray[np.complex128]
    back: NDArray[np.complex128]

    def continued(self, ratio: float) -> NDArray[np.float64]:
        """(s, s) What makes of a step's increments those of its polynomial in the next step.

        The next step is `ratio` times as long, and all of its nodes lie beyond those of the last:
        with x their places, ℓ_i(x) = ω(x) w_i / (x - x_i), ω being the product of all x - x_j.
        """
        nodes, weights = _barycentric(len(self.c))
        gaps = (1.0 + ratio * self.c)[:, None] - nodes
        return (gaps.prod(axis=1)[:, None] * weights / gaps)[:, 1:]


def lagrange(nodes: NDArray[np.float64], at: NDArray[np.float64]) -> NDArray[np.float64]:
    """Values of the Lagrange polynomials of `nodes` (columns) at the points `at` (rows).

    The products are formed factor by factor: no Vandermonde matrix, so nothing is lost to rounding.
    """
    own = np.eye(len(nodes), dtype=bool)
    gaps = np.where(own, 1.0, nodes[:, None] - nodes)
    factors = np.where(own, 1.0, at[:, None, None] - nodes)
    return np.prod(factors / gaps, axis=2)


def _nodes(stages: int) -> NDArray[np.float64]:
    """Zeros of P_(s-1) - P_s, of Legendre's polynomials, moved to [0, 1]: the last is the end."""
    polynomial = Legendre.basis(stages - 1) - Legendre.basis(stages)
    zeros = polynomial.roots().real  # of a kind with Jacobi's: all are real, whatever their type
    zeros -= polynomial(zeros) / polynomial.deriv()(zeros)  # eigenvalues, to the last bit
    return np.append((1.0 + zeros[:-1]) / 2.0, 1.0)


@cache
def _barycentric(stages: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """0 and the nodes x_i, and w_i: one over the product of all x_i - x_j, j other than i."""
    nodes = np.append(0.0, _nodes(stages))
    gaps = nodes[:, None] - nodes + np.eye(len(nodes))
    return nodes, 1.0 / gaps.prod(axis=1)


def _stage_matrix(c: NDArray[np.float64]) -> NDArray[np.float64]:
    """Integrals of the Lagrange polynomials from 0 to each node.

    Gauss quadrature with as many points as stages is exact well beyond their degree.
    """
    points, weights = leggauss(len(c))
    return np.array([end / 2.0 * weights @ lagrange(c, end / 2.0 * (1.0 + points)) for end in c])


def _gamma(a: NDArray[np.float64]) -> float:
    """The real eigenvalue of `a`; an even number of stages has none, then a modulus serves."""
    values = np.linalg.eigvals(a)
    return float(abs(values[np.argmin(np.abs(values.imag))]))


Spectrum = tuple[NDArray[np.complex128], NDArray[np.complex128], NDArray[np.complex128]]


def _spectrum(a: NDArray[np.float64]) -> Spectrum:
    """Eigenvalues without their conjugates, and what leads into their vectors and back."""
    eigen: Any = np.linalg.eig(a.astype(np.complex128))
    values, vectors = eigen
    real = np.abs(values.imag) < 1e-8 * np.abs(values)  # pairs are far from it
    values = np.where(real, values.real, values)
    kept = [*np.flatnonzero(real), *np.flatnonzero(~real & (values.imag > 0.0))]
    weights = np.where(real, 1.0, 2.0)  # Re(2 w) is w and its conjugate together
    return values[kept], np.linalg.inv(vectors)[kept], (vectors * weights)[:, kept]


@cache
def radau_table(stages: int) -> Collocation:
    """The table for any number of stages from 1; odd numbers make the better error estimate."""
    if stages < 1:
        raise ValueError(f"a Radau IIA method needs at least one stage, not {stages}")
    c = _nodes(stages)
    a = _stage_matrix(c)
    gamma = _gamma(a)
    # The embedded formula gives the slope at the start the weight gamma and has order s.  Its other
    # weights then differ from the method's by d with sum d_i p(c_i) = -gamma p(0) for every
    # polynomial p of degree below s, which the Lagrange polynomials at 0 solve.  The slopes follow
    # from the stage increments z = h a f, hence the inverse.
    d = -gamma * lagrange(c, np.zeros(1))[0]
    # Applied to the increments themselves, d is a divided difference over 0 and the nodes: the
    # h^s term of the solution, with the factor the h^(s + 1) term has in the estimate.
    values, into, back = _spectrum(a)
    return Collocation(a, c, gamma, np.linalg.solve(a.T, d), d, values, into, back)
