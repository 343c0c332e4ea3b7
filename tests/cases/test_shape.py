"""Inertias and points of the shapes against sums over small pieces of the shape."""

import numpy as np
import pytest

from textmech.cases.scene import Body, shape
from textmech.cases.trajectory import Array

N = 2000  # pieces a side: a sum at midpoints is then off by 1/N² of itself or less


def midpoints(length: float) -> Array:
    return ((np.arange(N) + 0.5) / N - 0.5) * length


def inertia(mass: float, x: Array, y: Array, weight: Array) -> float:
    """Σ (x² + y²) dm about the centre of mass, which is checked to be the origin."""
    dm = mass * weight / weight.sum()
    assert abs((dm * x).sum()) < 1e-12
    assert abs((dm * y).sum()) < 1e-12
    return float((dm * (x**2 + y**2)).sum())


def test_bar() -> None:
    body = shape.bar(name="b", mass=1.2, length=0.8, points={"P": (0.1, 0.2)})
    x = midpoints(0.8)
    assert body.moment == pytest.approx(inertia(1.2, x, 0 * x, np.ones(N)), rel=1e-6)
    assert body.points == {
        "center": (0.0, 0.0),
        "start": (-0.4, 0.0),
        "end": (0.4, 0.0),
        "P": (0.1, 0.2),
    }


@pytest.mark.slow
def test_disk() -> None:
    body = shape.disk(name="d", mass=1.3, radius=0.25, points={})
    x, y = np.meshgrid(midpoints(0.5), midpoints(0.5))
    inside = (x**2 + y**2 < 0.25**2).astype(float)
    assert body.moment == pytest.approx(inertia(1.3, x, y, inside), rel=1e-4)  # a jagged rim
    assert body.radius == 0.25


@pytest.mark.slow
def test_block() -> None:
    body = shape.block(name="b", mass=2.0, width=0.3, height=0.1, points={})
    x, y = np.meshgrid(midpoints(0.3), midpoints(0.1))
    assert body.moment == pytest.approx(inertia(2.0, x, y, np.ones_like(x)), rel=1e-6)


@pytest.mark.parametrize(
    ("body", "turns"),
    [
        (shape.particle(name="p", mass=1.0), False),
        (shape.rigid(name="r", mass=1.0, inertia=0.2, points={}), True),
    ],
)
def test_given(body: Body, turns: bool) -> None:
    assert body.turns == turns
    assert body.points == {"center": (0.0, 0.0)}
    assert body.inertia == ((0.2,) if turns else ())


def test_about_a_point_it_resists_by_the_pieces_that_it_has() -> None:
    """Σ d² dm of a bar about its end and about a point off its line: J of its centre + m d²."""
    rod = shape.bar(name="rod", mass=1.3, length=2.0, points={"off": (0.3, 0.8)})
    x, dm = midpoints(2.0), 1.3 / N
    assert rod.about("start") == pytest.approx(float(np.sum((x + 1.0) ** 2) * dm), rel=1e-6)
    off = float(np.sum((x - 0.3) ** 2 + 0.8**2) * dm)
    assert rod.about("off") == pytest.approx(off, rel=1e-6)


def test_corners_of_a_block() -> None:
    """Its mass lies between them, and they are where their names say."""
    box = shape.block(name="box", mass=1.0, width=0.4, height=0.6, points={})
    assert {name: box.points[name] for name in shape.CORNERS} == {
        "lower_left": (-0.2, -0.3),
        "lower_right": (0.2, -0.3),
        "upper_left": (-0.2, 0.3),
        "upper_right": (0.2, 0.3),
    }


@pytest.mark.mutant("an angle that is no number read as zero")
def test_a_point_of_a_body_at_no_angle_is_nowhere() -> None:
    """Else a run that has broken down would still be within: NaN is within nothing."""
    rod = shape.bar(name="rod", mass=1.0, length=2.0, points={})
    states = np.array([[0.5, 0.2, np.nan, 1.0, 0.0, 3.0]])
    for point in ("center", "start", "end"):
        assert np.isnan(rod.point(states, point)).all()
    assert np.isnan(rod.observe(states, "", "angle")).all()
    read = np.nan_to_num(states)
    assert not np.isnan(rod.point(read, "end")).any()
