"""Inertias against integrals over the body, and what happens to them elsewhere."""

import numpy as np
import pytest

from textmech.reference.laws.inertia import bar, disk, rotated, steiner, tensor
from textmech.reference.system import Array


def points_of_bar(m: float, l: float) -> tuple[Array, Array]:
    """Gauss points along axis 1 and their masses: exact for polynomials."""
    node, weight = np.polynomial.legendre.leggauss(4)
    x = np.zeros((4, 3))
    x[:, 0] = node * l / 2
    return m * weight / 2, x


def points_of_disk(m: float, R: float) -> tuple[Array, Array]:
    """Gauss points in the radius, evenly spaced ones around: exact for squares."""
    node, weight = np.polynomial.legendre.leggauss(4)
    r, ring = R * (node + 1) / 2, m * weight * (node + 1) / 2  # dm = 2 m r dr / R²
    phi = np.arange(8) * np.pi / 4
    x = np.stack(
        [np.outer(r, np.cos(phi)), np.outer(r, np.sin(phi)), np.zeros((4, 8))], axis=-1
    ).reshape(-1, 3)
    return np.repeat(ring / 8, 8), x


BODIES = {"bar": (bar(1.3, 0.8), *points_of_bar(1.3, 0.8)),
          "disk": (disk(1.3, 0.8), *points_of_disk(1.3, 0.8))}  # fmt: skip


def some_axes() -> Array:
    """Rows: three orthonormal axes along nothing in particular."""
    E = np.linalg.qr(np.random.default_rng(3).normal(size=(3, 3)))[0]
    return E * np.linalg.det(E)


@pytest.mark.parametrize("body", BODIES)
def test_formula_is_the_integral(body: str):
    J, m, x = BODIES[body]
    assert m.sum() == pytest.approx(1.3, rel=1e-14)
    np.testing.assert_allclose(J, tensor(m, x), rtol=1e-14, atol=1e-16)


@pytest.mark.parametrize("body", BODIES)
def test_steiner_is_the_integral_about_another_point(body: str):
    J, m, x = BODIES[body]
    a = np.array([0.3, -0.7, 0.2])
    np.testing.assert_allclose(steiner(J, m.sum(), a), tensor(m, x - a), rtol=1e-13)


@pytest.mark.parametrize("body", BODIES)
def test_rotation_is_the_integral_in_other_axes(body: str):
    J, m, x = BODIES[body]
    E = some_axes()
    np.testing.assert_allclose(rotated(J, E), tensor(m, x @ E.T), rtol=1e-13, atol=1e-15)


def test_bar_about_its_end():
    end = steiner(bar(1.2, 0.8), 1.2, np.array([0.4, 0.0, 0.0]))
    assert end[2, 2] == pytest.approx(1.2 * 0.8**2 / 3, rel=1e-15)


def test_products_of_inertia_carry_the_minus_sign():
    m, x = np.array([2.0]), np.array([[1.0, 3.0, 0.0]])
    assert tensor(m, x)[0, 1] == -6.0
