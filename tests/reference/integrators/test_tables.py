"""The figures of both methods against the conditions of their orders, and against print."""

import numpy as np
import pytest

from textmech.reference.integrators.dop853 import DOP853, STAGES
from textmech.reference.integrators.radau import Collocation, radau_table


def test_explicit_table_conditions():
    a, b, c = DOP853.a, DOP853.b, DOP853.c
    assert np.abs(a.sum(axis=1) - c).max() < 1e-14
    for k in range(8):
        assert b @ c**k == pytest.approx(1.0 / (k + 1), abs=1e-14)
    for k in range(1, 7):  # two conditions of trees that are not bushes, for each order up to 8
        assert b @ a @ c**k == pytest.approx(1.0 / ((k + 1) * (k + 2)), abs=1e-14)
        assert (b * c) @ a @ c ** (k - 1) == pytest.approx(1.0 / (k * (k + 2)), abs=1e-14)
    assert np.array_equal(a, np.tril(a, -1))
    assert len(b) == STAGES


@pytest.mark.parametrize(("row", "order"), [("e5", 5), ("e3", 3)])
def test_error_rows_vanish_up_to_their_order(row: str, order: int):
    weights = getattr(DOP853, row)
    moments = [abs(weights @ DOP853.c**k) for k in range(order + 1)]
    assert max(moments[:order]) < 1e-14
    assert moments[order] > 1e-5


@pytest.mark.parametrize("stages", range(1, 10))
def test_radau_conditions(stages: int):
    table: Collocation = radau_table(stages)
    a, c, b = table.a, table.c, table.a[-1]
    assert c[-1] == 1.0
    for figures in (a, c, table.gamma, table.error, table.leading):
        assert np.isrealobj(figures)
    for k in range(1, 2 * stages):  # B(2s - 1)
        assert b @ c ** (k - 1) == pytest.approx(1.0 / k, abs=2e-15)
    assert abs(b @ c ** (2 * stages - 1) - 0.5 / stages) > 1e-12  # and not B(2s)
    for k in range(1, stages + 1):  # C(s)
        assert np.abs(a @ c ** (k - 1) - c**k / k).max() < 2e-15
    weights = b + table.error @ a  # of the embedded formula, with gamma at the start
    assert weights.sum() + table.gamma == pytest.approx(1.0, abs=1e-13)
    for k in range(2, stages + 1):
        assert weights @ c ** (k - 1) == pytest.approx(1.0 / k, abs=1e-13)


def test_radau_with_three_stages_is_the_published_one():
    r = np.sqrt(6.0)
    table = radau_table(3)
    assert np.abs(table.c - [(4 - r) / 10, (4 + r) / 10, 1.0]).max() < 1e-15
    assert np.abs(table.a[2] - [(16 - r) / 36, (16 + r) / 36, 1 / 9]).max() < 1e-15
    published = table.gamma / 3.0 * np.array([-13.0 - 7.0 * r, -13.0 + 7.0 * r, -1.0])
    assert np.abs(table.error - published).max() < 1e-13
    assert 1.0 / table.gamma == pytest.approx(3.0 + 3.0 ** (2 / 3) - 3.0 ** (1 / 3), abs=1e-13)


@pytest.mark.parametrize("stages", [1, 2, 3, 5, 7])
def test_the_spectrum_of_radau_is_its_matrix(stages: int):
    """One eigenvalue of each pair, the real one first: γ, where the number of stages is odd."""
    table = radau_table(stages)
    assert len(table.values) == (stages + 1) // 2
    back = (table.back * table.values) @ table.into
    np.testing.assert_allclose(back.real, table.a, atol=1e-13)
    if stages % 2:
        assert table.values[0].imag == 0.0
        assert table.values[0].real == pytest.approx(table.gamma, rel=1e-12)
