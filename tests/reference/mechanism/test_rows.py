"""The three terms of rows against planar formulas typed here, with S = [[0, −1], [1, 0]]."""

import numpy as np
import pytest

from textmech.cases.scene import GROUND, Anchor, GroundPoint, Scene, shape
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import Along, Line, Term, Turning
from textmech.reference.mechanism.constraints.equation_table import G
from textmech.reference.mechanism.kinematics.coordinates import Coordinates
from textmech.reference.system import Array

P, Q = np.array([0.3, 0.2]), np.array([-0.2, 0.4])  # on the bar and on the block, in body axes
HOOK, HOOK_DOT = np.array([0.2, 0.5]), np.array([0.8, -1.1])
S = np.array([[0.0, -1.0], [1.0, 0.0]])
EXACT = 1e-13  # a few roundings of terms of size 1 to 100
WHERE = Coordinates(
    Scene(
        gravity=(0.0, 0.0),
        points={"hook": GroundPoint((0.2, 0.5), (0.8, -1.1))},
        bodies={
            "bar": shape.bar(name="bar", mass=1.2, length=0.9, points={"P": (0.3, 0.2)}),
            "block": shape.block(
                name="block", mass=0.7, width=0.5, height=0.3, points={"Q": (-0.2, 0.4)}
            ),
            "dot": shape.particle(name="dot", mass=0.4),
        },
        joints={},
        contacts={},
        forces={},
    )
)
BAR, BLOCK, DOT = Anchor("bar", "P"), Anchor("block", "Q"), Anchor("dot", "center")
END, GIVEN = Anchor("bar", "end"), Anchor(GROUND, "hook")
U = (0.6, -0.8)


def E(phi: float) -> Array:
    return np.array([[np.cos(phi), -np.sin(phi)], [np.sin(phi), np.cos(phi)]])


def held(term: Term, ends: tuple[Anchor, ...]) -> Constraint:
    return Constraint("j", ends, ((term,),), (("fx", "fy"),), None, WHERE)


def row(term: Term, ends: tuple[Anchor, ...], t: float, q: Array, v: Array) -> Array:
    """f_a, g and γ, (n + 2,)."""
    (f,), (g,), (gamma,) = held(term, ends).alone.rows(t, q, v)
    return np.array([*f, g, gamma])


@pytest.fixture(params=range(10))
def state(request: pytest.FixtureRequest) -> tuple[float, Array, Array]:
    """t, and q and v of bar (x, y, φ), block (x, y, φ) and dot (x, y)."""
    random = np.random.default_rng(request.param)
    return random.uniform(0.0, 3.0), random.uniform(-3.0, 3.0, 8), random.uniform(-5.0, 5.0, 8)


def test_along(state: tuple[float, Array, Array]) -> None:
    """u·(ẋ, ẏ) + u·S d φ̇ = 0 and γ = φ̇² u·d; a particle has no arm, the ground a velocity."""
    t, q, v = state
    d, u = E(q[2]) @ P, np.array(U)
    expected = [*u, u @ S @ d, 0, 0, 0, 0, 0, 0, v[2] ** 2 * u @ d]
    np.testing.assert_allclose(row(Along(0, U), (BAR,), t, q, v), expected, atol=EXACT)
    d = E(q[2]) @ [0.45, 0.0]
    expected = [*u, u @ S @ d, 0, 0, 0, 0, 0, 0, v[2] ** 2 * u @ d]
    np.testing.assert_allclose(row(Along(0, U), (END,), t, q, v), expected, atol=EXACT)
    np.testing.assert_array_equal(row(Along(0, U), (DOT,), t, q, v), [0, 0, 0, 0, 0, 0, *U, 0, 0])
    fixed = np.zeros(10)
    fixed[G] = -u @ HOOK_DOT
    np.testing.assert_allclose(row(Along(0, U), (GIVEN,), t, q, v), fixed, atol=EXACT)


def test_turning(state: tuple[float, Array, Array]) -> None:
    """The angle's column; particles and the ground do not turn."""
    t, q, v = state
    expected = [0, 0, 0, 0, 0, -0.7, 0, 0, 0, 0]
    np.testing.assert_array_equal(row(Turning(1, -0.7), (BAR, BLOCK), t, q, v), expected)
    for end in (DOT, GIVEN):
        assert not np.any(row(Turning(0), (end,), t, q, v))


def test_line_from_a_body(state: tuple[float, Array, Array]) -> None:
    """d/dt u·(r_Q − r_c), r_c the bar's centre: in its axes the point of the bar does not move."""
    t, q, v = state
    u, d = E(q[2]) @ U, E(q[5]) @ Q
    lever, rate = q[3:5] + d - q[:2], v[3:5] + v[5] * S @ d - v[:2]
    f = [*-u, (S @ u) @ lever, *u, u @ S @ d, 0, 0]
    gamma = v[2] ** 2 * u @ lever - 2 * v[2] * (S @ u) @ rate + v[5] ** 2 * u @ d
    found = row(Line(0, 1, U), (BAR, BLOCK), t, q, v)
    np.testing.assert_allclose(found, [*f, 0, gamma], atol=10 * EXACT)


def test_line_from_and_to_the_ground(state: tuple[float, Array, Array]) -> None:
    """From the ground u does not turn; to it, only u does, and the point of the ground moves."""
    t, q, v = state
    u, d = np.array(U), E(q[5]) @ Q
    expected = [0, 0, 0, *u, u @ S @ d, 0, 0, u @ HOOK_DOT, v[5] ** 2 * u @ d]
    found = row(Line(0, 1, U), (GIVEN, BLOCK), t, q, v)
    np.testing.assert_allclose(found, expected, atol=EXACT)
    u = E(q[2]) @ U
    lever, rate = HOOK + t * HOOK_DOT - q[:2], HOOK_DOT - v[:2]
    f = [*-u, (S @ u) @ lever, 0, 0, 0, 0, 0]
    gamma = v[2] ** 2 * u @ lever - 2 * v[2] * (S @ u) @ rate
    found = row(Line(0, 1, U), (BAR, GIVEN), t, q, v)
    np.testing.assert_allclose(found, [*f, -u @ HOOK_DOT, gamma], atol=10 * EXACT)


def test_places(state: tuple[float, Array, Array]) -> None:
    """u·r of a point, φ times the axis, u·Δ: what the rows are the rates of."""
    t, q, _ = state
    r_P, r_Q = q[:2] + E(q[2]) @ P, q[3:5] + E(q[5]) @ Q
    u = E(q[2]) @ U

    def place(term: Term) -> float:
        return held(term, (BAR, BLOCK)).places(t, q.tolist())[0]

    assert place(Along(1, U)) == pytest.approx(np.dot(U, r_Q), abs=EXACT)
    assert place(Turning(1, 0.25)) == 0.25 * q[5]
    assert place(Line(0, 1, U)) == pytest.approx(u @ (r_Q - r_P), abs=EXACT)
    force = held(Line(0, 1, U), (BAR, BLOCK)).reactions(t, q.tolist(), [2.0])
    assert (force["j.fx"], force["j.fy"]) == pytest.approx(tuple(2.0 * u), abs=EXACT)
