"""Numbers as letters: what is read back is what was meant, to within half a level."""

import numpy as np
import pytest

from textmech.reports.page.pack import LEVELS, packed, packed_around_zero, unpacked


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e9])
def test_a_curve_comes_back_to_half_a_level(scale: float) -> None:
    curve = scale * np.random.default_rng(1).normal(size=77)
    for pack in (packed, packed_around_zero):
        found = pack(curve)
        step = found[1]
        assert np.max(np.abs(unpacked(found) - curve)) <= 0.5001 * step + 1e-5 * scale
        assert step <= 2.001 * np.max(np.abs(curve)) / (LEVELS - 2)


def test_an_error_of_zero_stays_zero() -> None:
    assert unpacked(packed_around_zero(np.array([0.0, 1e-3, -7.0])))[0] == 0.0
    assert unpacked(packed_around_zero(np.zeros(3))).tolist() == [0.0, 0.0, 0.0]


def test_what_stays_stays() -> None:
    assert unpacked(packed(np.full(4, 2.5))).tolist() == [2.5] * 4


def test_two_letters_a_number_that_no_markup_knows() -> None:
    letters = packed(np.linspace(0, 1, 50))[2]
    assert len(letters) == 100
    assert not set(letters) & set("<>&\"'\\")


@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_what_is_not_finite_is_refused(wrong: float) -> None:
    with pytest.raises(ValueError, match="not finite"):
        packed(np.array([0.0, wrong]))
