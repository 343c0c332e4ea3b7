"""Numbers as letters: what is read back is what was meant."""

from collections.abc import Callable

import numpy as np
import pytest

from textmech.reports.page.pack import (
    BASE,
    Packed,
    packed,
    packed_by_size,
    unpacked,
    unpacked_by_size,
)


@pytest.mark.parametrize("width", [2, 3])
@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e9])
def test_a_curve_comes_back_to_half_a_level(scale: float, width: int) -> None:
    curve = scale * np.random.default_rng(1).normal(size=77)
    found = packed(curve, width)
    assert np.max(np.abs(unpacked(found, width) - curve)) <= 0.501 * found[1] + 1e-5 * scale
    assert found[1] == pytest.approx(np.ptp(curve) / (BASE**width - 1), rel=1e-5)
    assert len(found[2]) == 77 * width


@pytest.mark.parametrize("scale", [1e-12, 1.0, 1e9])
def test_an_error_comes_back_to_half_a_percent_of_itself(scale: float) -> None:
    sizes = 10 ** np.random.default_rng(2).uniform(-8.9, 0, size=200)
    errors = scale * sizes * np.where(np.arange(200) % 3, 1, -1)
    found = unpacked_by_size(packed_by_size(errors))
    assert np.max(np.abs(found / errors - 1)) < 0.0052


def test_an_error_of_zero_stays_zero_and_what_is_next_to_nothing_becomes_it() -> None:
    assert unpacked_by_size(packed_by_size(np.zeros(3))).tolist() == [0.0, 0.0, 0.0]
    found = unpacked_by_size(packed_by_size(np.array([0.0, 1e-10, -1e-10, -1.0, 1e-8])))
    assert found[:3].tolist() == [0.0, 0.0, 0.0]
    assert found[3:] == pytest.approx([-1.0, 1e-8], rel=0.006)


@pytest.mark.mutant("where levels begin by six digits, however narrow their range is")
@pytest.mark.parametrize("share", [1e-3, 1e-5, 1e-7])
def test_a_narrow_curve_far_from_zero_is_no_line(share: float) -> None:
    curve = 1234.5671 * (1.0 + share * np.random.default_rng(3).uniform(size=77))
    found = packed(curve)
    assert np.max(np.abs(unpacked(found) - curve)) <= 0.52 * found[1]


def test_what_stays_stays() -> None:
    assert unpacked(packed(np.full(4, 2.5))).tolist() == [2.5] * 4


def test_two_letters_a_number_that_no_markup_knows() -> None:
    for pack in (packed, packed_by_size):
        letters = pack(np.linspace(-1, 1, 50))[2]
        assert len(letters) == 100
        assert not set(letters) & set("<>&\"'\\")


@pytest.mark.parametrize("pack", [packed, packed_by_size])
@pytest.mark.parametrize("wrong", [np.nan, np.inf])
def test_what_is_not_finite_is_refused(wrong: float, pack: Callable[..., Packed]) -> None:
    with pytest.raises(ValueError, match="not finite"):
        pack(np.array([0.0, wrong]))
