"""Methods are compared at one error, each between the two tolerances around it."""

import math
from collections.abc import Sequence

import numpy as np
import pytest

from bench import integrators
from bench.integrators import bracket, compared
from textmech.cases.trajectory import Array

TRUTH = np.zeros(2)


def off(tolerance: float) -> Array:
    """Always thirty times worse than its tolerance."""
    return np.array([0.0, 30 * tolerance])


def test_an_error_lies_between_two_tolerances() -> None:
    found = bracket(off, TRUTH, 1e-8)
    assert found
    assert (found.loose, found.tight) == pytest.approx((1e-9, 1e-10))
    assert found.weight == pytest.approx(math.log10(3))
    between = found.loose ** (1 - found.weight) * found.tight**found.weight
    assert 30 * between == pytest.approx(1e-8)


def test_what_is_good_enough_at_once_is_taken_as_it_is() -> None:
    found = bracket(off, TRUTH, 1.0)
    assert found
    assert (found.loose, found.tight) == (1e-6, 1e-6)


def test_what_never_comes_there_is_not_compared() -> None:
    assert bracket(lambda tolerance: np.ones(2), TRUTH, 1e-8) is None
    assert bracket(off, TRUTH, 1e-8, patience=-1.0) is None


@pytest.mark.slow
def test_a_case_is_compared(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(integrators, "ERRORS", {"bar_pendulum": 1e-6})
    monkeypatch.setattr(integrators, "TOLERANCES", (1e-6, 1e-7, 1e-9))
    (row,) = compared(1)
    assert row.ratio
    assert row.ours > 0
    assert row.best in integrators.SCIPYS


@pytest.mark.slow
def test_the_fastest_of_scipys_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of made-up seconds: ours takes one, scipy's first two, and each next one more."""

    def took(works: Sequence[object], rounds: int) -> Array:
        return np.array([[1.0 + i // 2] * rounds for i in range(len(works))])

    monkeypatch.setattr(integrators, "turns", took)
    monkeypatch.setattr(integrators, "ERRORS", {"bar_pendulum": 1e-6})
    monkeypatch.setattr(integrators, "TOLERANCES", (1e-6, 1e-7, 1e-9))
    (row,) = compared(3)
    assert (row.ours, row.best) == (pytest.approx(1.0), integrators.SCIPYS[0])
    assert row.ratio
    assert row.ratio.median == pytest.approx(0.5)
