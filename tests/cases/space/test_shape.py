"""Tensors and points of the shapes in space against sums over small pieces of the shape."""

import math

import numpy as np
import pytest

from textmech.cases.scene import solid
from textmech.cases.scene.body import Body
from textmech.cases.trajectory import Array

N = 60  # pieces a side
BY_MIDPOINTS = 1.01 / N**2  # a sum at midpoints is off by 1/N² of the integral
U = (0.48, 0.6, 0.64)


def midpoints(length: float) -> Array:
    return ((np.arange(N) + 0.5) / N - 0.5) * length


def cloud(*sides: Array) -> Array:
    """(…, 3) all points whose coordinates these are."""
    return np.stack([axis.ravel() for axis in np.meshgrid(*sides)], axis=1)


def tensor(mass: float, points: Array) -> Array:
    """Σ (r·r 1 − r rᵀ) dm (2.32) of equal pieces around the origin, typed entry by entry."""
    x, y, z = points.T
    assert np.abs(points.mean(axis=0)).max() < 1e-12
    entries = [
        [y * y + z * z, -x * y, -x * z],
        [-x * y, x * x + z * z, -y * z],
        [-x * z, -y * z, x * x + y * y],
    ]
    return np.array([[mass * entry.mean() for entry in row] for row in entries])


def same(body: Body, expected: Array, error: float) -> None:
    np.testing.assert_allclose(body.tensor, expected, atol=error * np.abs(expected).max(), rtol=0)


def test_bar() -> None:
    body = solid.bar(name="b", mass=1.2, length=0.8, points={"P": (0.1, 0.2, 0.3)})
    same(body, tensor(1.2, cloud(midpoints(0.8), np.zeros(1), np.zeros(1))), BY_MIDPOINTS)
    assert body.points == {
        "center": (0.0, 0.0, 0.0),
        "start": (-0.4, 0.0, 0.0),
        "end": (0.4, 0.0, 0.0),
        "P": (0.1, 0.2, 0.3),
    }


@pytest.mark.parametrize("axle", [(0.0, 1.0, 0.0), U])
def test_disk(axle: tuple[float, float, float]) -> None:
    """Rings of equal mass, whose radii are those of the middle of their mass, about the axle."""
    body = solid.disk(name="d", mass=1.3, radius=0.25, axle=axle, points={})
    u = np.array(axle)
    e = np.cross(u, (1.0, 0.0, 0.0))
    e = e / np.linalg.norm(e)
    turns = (np.arange(N) + 0.5) * math.tau / N
    radii = 0.25 * np.sqrt((np.arange(N) + 0.5) / N)
    around = np.cos(turns)[:, None] * e + np.sin(turns)[:, None] * np.cross(u, e)
    same(body, tensor(1.3, (radii[:, None, None] * around).reshape(-1, 3)), 1e-12)
    assert (body.radius, body.axle) == (0.25, axle)


def test_sphere() -> None:
    body = solid.sphere(name="s", mass=2.0, radius=0.3, points={})
    points = cloud(midpoints(0.6), midpoints(0.6), midpoints(0.6))
    inside = points[np.linalg.norm(points, axis=1) < 0.3]
    same(body, tensor(2.0, inside), 2e-3)  # a jagged surface
    assert (body.radius, body.axle) == (0.3, None)


def test_block() -> None:
    body = solid.block(name="b", mass=2.0, size=(0.3, 0.1, 0.7), points={})
    points = cloud(midpoints(0.3), midpoints(0.1), midpoints(0.7))
    same(body, tensor(2.0, points), BY_MIDPOINTS)


def test_given() -> None:
    six = (0.5, 0.6, 0.7, -0.01, 0.02, -0.03)
    body = solid.rigid(name="r", mass=1.0, inertia=six, points={}, radius=0.2, axle=U)
    expected = [[0.5, -0.01, 0.02], [-0.01, 0.6, -0.03], [0.02, -0.03, 0.7]]
    np.testing.assert_array_equal(body.tensor, expected)
    assert (body.radius, body.axle) == (0.2, U)
    bob = solid.particle(name="p", mass=1.0)
    assert not bob.turns
    assert not bob.tensor.any()


def test_how_easily_a_point_moves() -> None:
    """A unit force at the point for a unit time, in every direction, on the free body."""
    body = solid.rigid(
        name="r", mass=1.7, inertia=(0.5, 0.6, 0.7, -0.1, 0.1, -0.05), points={"P": (0.3, 0.2, 0.9)}
    )
    d = np.array(body.points["P"])
    forces = np.random.default_rng(1).normal(size=(2000, 3))
    forces /= np.linalg.norm(forces, axis=1)[:, None]
    omega = np.linalg.solve(body.tensor, np.cross(d, forces).T).T
    moved = np.sum((forces / 1.7 + np.cross(omega, d)) * forces, axis=1)
    assert moved.max() == pytest.approx(body.mobility("P"), rel=1e-2)
    assert moved.max() <= body.mobility("P")


def test_hung_up_at_a_point() -> None:
    """The least moment of inertia about an axis through the point, of many across its arm."""
    body = solid.rigid(
        name="r", mass=1.7, inertia=(0.5, 0.6, 0.7, -0.1, 0.1, -0.05), points={"P": (0.3, 0.2, 0.9)}
    )
    d = np.array(body.points["P"])
    axes = np.cross(d, np.random.default_rng(1).normal(size=(2000, 3)))
    axes /= np.linalg.norm(axes, axis=1)[:, None]
    about = np.sum((axes @ body.tensor) * axes, axis=1) + 1.7 * d @ d
    assert about.min() == pytest.approx(body.about("P"), rel=1e-4)
    assert about.min() >= body.about("P")


def test_a_bar_is_moved_as_in_the_plane() -> None:
    bar = solid.bar(name="b", mass=1.2, length=0.8, points={})
    assert bar.mobility("end") == pytest.approx(4 / 1.2, rel=1e-12)  # as in the plane
    assert bar.about("end") == pytest.approx(1.2 * 0.8**2 / 3, rel=1e-12)
