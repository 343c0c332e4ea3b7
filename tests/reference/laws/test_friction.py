"""Force laws against typed values; the book's friction laws and what approximates them."""

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest

from textmech.reference.laws.force import damper, spring, weight
from textmech.reference.laws.friction import (
    Dry,
    H,
    boxcar,
    coulomb,
    h_interval,
    h_signs,
    karnopp,
    power_law,
    smooth,
    stiction,
    stribeck,
    velocity_dependent,
    viscous,
)

# The book's friction laws: their branches, their edges, and what the approximations are of.

BOOK = Dry(F_minus=3.0, F_plus=3.0, Fs_minus=6.0, Fs_plus=6.0)
UNEVEN = Dry(F_minus=3.0, F_plus=1.0, Fs_minus=4.0, Fs_plus=2.0)
DELTA, A = 5e-4, 1e5  # of Examples 2.3 and 2.4
Law = Callable[[Dry, float, float], float]

# (2.89) as a table of v, F_a, F_fr for UNEVEN.
STICTION = [
    (-2.0, 9.0, 3.0), (-1e-300, 0.0, 3.0), (2.0, -9.0, -1.0), (1e-300, 0.0, -1.0),
    (0.0, 0.0, 0.0), (0.0, 1.9, -1.9), (0.0, -3.9, 3.9), (-0.0, 1.0, -1.0),
    (0.0, 2.0, -2.0), (0.0, -4.0, 4.0),  # the band is closed
    (0.0, 2.0000001, -1.0), (0.0, -4.0000001, 3.0),
]  # fmt: skip


def violations(law: Law) -> list[tuple[float, float]]:
    """The rows of (2.89) that a law does not meet."""
    return [(v, F_a) for v, F_a, F_fr in STICTION if law(UNEVEN, v, F_a) != F_fr]


def test_extended_coulomb_law():
    assert violations(stiction) == []


@pytest.mark.mutant("dry friction (2.89): {mistake}")
@pytest.mark.parametrize(
    ("mistake", "law"),
    [
        ("sign while sliding", lambda d, v, f: -stiction(d, v, f) if v else stiction(d, v, f)),
        ("sign of stiction", lambda d, v, f: -stiction(d, v, f) if v == 0.0 else stiction(d, v, f)),
        ("F₋ and F₊ exchanged", lambda d, v, f: stiction(Dry(1.0, 3.0, 4.0, 3.0), v, f)),
        ("no stick mode", lambda d, v, f: stiction(d, v or math.copysign(1.0, f), f)),
        ("band open", lambda d, v, f: d.F_minus if v == 0.0 and f == -4.0 else stiction(d, v, f)),
    ],
)  # fmt: skip
def test_mistakes_in_the_extended_law_are_seen(mistake: str, law: Law):
    assert violations(law), mistake


def test_velocity_dependent_friction_has_its_own_values_while_sliding_only():
    def law(v: float, F_a: float) -> float:
        return velocity_dependent(lambda v: 3.0 - v, lambda v: 1.0 + v / 2, UNEVEN, v, F_a)

    assert (law(-2.0, 0.0), law(2.0, 0.0)) == (5.0, -2.0)
    for F_a in (-5.0, -4.0, 0.5, 2.0, 7.0):
        assert law(0.0, F_a) == stiction(UNEVEN, 0.0, F_a)


@pytest.mark.parametrize(
    ("v", "F"), [(0.0, 6.0), (0.5, 4.103638323514327), (-0.5, 4.103638323514327), (1e3, 3.0)]
)
def test_friction_falls_from_static_to_kinetic(v: float, F: float):
    """Fig 2.25, even in v: 3 + 3/e at v_s."""
    assert stribeck(3.0, 6.0, 0.5, v) == pytest.approx(F, rel=1e-15)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ((-1.0, 1.0, 2.0, 2.0), "negative"),
        ((1.0, 1.0, 2.0, math.nan), "negative"),
        ((3.0, 1.0, 2.0, 2.0), "kinetic friction must not be above"),
        ((1.0, 3.0, 2.0, 2.0), "kinetic friction must not be above"),
    ],
)
def test_impossible_friction_is_refused(values: tuple[float, ...], words: str):
    with pytest.raises(ValueError, match=words):
        Dry(*values)


def test_coulomb_says_nothing_at_rest():
    assert coulomb(0.4, 10.0, -0.1) == 4.0
    assert coulomb(0.4, 10.0, 0.1) == -4.0
    with pytest.raises(ValueError, match=r"\(2\.89\)"):
        coulomb(0.4, 10.0, 0.0)


def test_viscous_friction_opposes_the_velocity():
    v = np.array([3.0, -4.0])
    np.testing.assert_allclose(viscous(lambda v: 2 * float(v @ v), v), [-30.0, 40.0], rtol=1e-15)
    np.testing.assert_array_equal(viscous(lambda v: 7.0, np.zeros(2)), np.zeros(2))
    for alpha in (0.5, 1.0, 2.0, 2.7):
        for speed in (-1.7, 1.7):
            known = viscous(lambda v, alpha=alpha: 0.3 * abs(v[0]) ** alpha, [speed])
            assert power_law(0.3, alpha, speed) == pytest.approx(known[0], rel=1e-15)
        assert power_law(0.3, alpha, 0.0) == 0.0
    with pytest.raises(ValueError, match="positive"):
        power_law(0.3, 0.0, 1.0)


def test_edges_on_which_the_forms_disagree():
    """Erratum 9: at v = 0, F_a = 6 the three forms give −6, −3 and −4.5."""
    assert karnopp(BOOK, DELTA, 0.0, 6.0) == -6.0
    assert boxcar(BOOK, DELTA, 0.0, 6.0, h=h_interval) == -3.0
    assert boxcar(BOOK, DELTA, 0.0, 6.0, h=h_signs) == -4.5
    assert karnopp(BOOK, DELTA, DELTA, 2.0) == -2.0
    assert boxcar(BOOK, DELTA, DELTA, 2.0, h=h_interval) == -3.0
    assert boxcar(BOOK, DELTA, DELTA, 2.0, h=h_signs) == -2.5


@pytest.mark.parametrize("dry", [BOOK, UNEVEN], ids=["book", "uneven"])
def test_away_from_the_edges_all_forms_agree(dry: Dry):
    """(2.91), (2.92), (2.93) Karnopp's law, and the boxcar's with either interval."""
    random = np.random.default_rng(1)
    for _ in range(500):
        v, F_a = random.uniform(-3 * DELTA, 3 * DELTA), random.uniform(-9.0, 9.0)
        known = karnopp(dry, DELTA, v, F_a)
        for h in (h_interval, h_signs):
            assert boxcar(dry, DELTA, v, F_a, h=h) == pytest.approx(known, abs=1e-14)
        # e^{−2 A 2e-4} = 4e-18 of the step is what the smooth form leaves at that distance.
        near = [abs(abs(v) - DELTA), abs(F_a + dry.Fs_minus), abs(F_a - dry.Fs_plus)]
        if min(near) > 2e-4:
            assert smooth(dry, DELTA, A, v, F_a) == pytest.approx(known, abs=1e-13)


def test_infinite_limits_of_an_interval():
    for h in (h_interval, h_signs, H(A)):
        assert [h(-math.inf, 1.0, x) for x in (0.0, 2.0)] == pytest.approx([1.0, 0.0])
        assert [h(1.0, math.inf, x) for x in (0.0, 2.0)] == pytest.approx([0.0, 1.0])


def test_smooth_interval_is_the_mean_on_its_edges():
    edges: list[Any] = [H(A)(-1.0, 1.0, x) for x in (-1.0, 1.0)]
    assert edges == pytest.approx([0.5, 0.5])


# Force laws against typed values.


def test_weight_points_along_gravity():
    np.testing.assert_array_equal(weight(2.0, (0.0, -9.5)), [0.0, -19.0])


def test_spring_pulls_when_stretched_and_pushes_when_compressed():
    np.testing.assert_allclose(spring(10.0, 2.0, (3.0, 4.0)), [18.0, 24.0], rtol=1e-15)
    np.testing.assert_allclose(spring(10.0, 6.0, (3.0, 4.0)), [-6.0, -8.0], rtol=1e-15)
    np.testing.assert_allclose(spring(10.0, 5.0, (3.0, 4.0)), [0.0, 0.0], atol=1e-15)


def test_spring_without_a_length_of_its_own_has_no_force_where_its_ends_meet():
    np.testing.assert_array_equal(spring(10.0, 0.0, (0.0, 0.0)), [0.0, 0.0])
    np.testing.assert_array_equal(spring(10.0, 0.0, (3.0, -4.0)), [30.0, -40.0])


def test_damper_pulls_while_it_lengthens_and_ignores_turning():
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (0.3, 0.4)), [0.6, 0.8], rtol=1e-15)
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (-0.3, -0.4)), [-0.6, -0.8], rtol=1e-15)
    np.testing.assert_allclose(damper(2.0, (3.0, 4.0), (-4.0, 3.0)), [0.0, 0.0], atol=1e-15)
