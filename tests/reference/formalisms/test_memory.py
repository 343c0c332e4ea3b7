"""What the equations of many rates take of memory, and that it changes no answer."""

import tracemalloc
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.scenes import typed

from textmech.reference.formalisms import lagrange
from textmech.reference.formalisms.chaplygin import ignorable
from textmech.reference.solve import mechanism


def chain(bars: int) -> str:
    """A scene of so many bars that hang on each other."""
    lines = [
        "scene:\n  points: {O: [0, 0]}\n  bodies:",
        *(f"    b{k}: {{bar: {{mass: {1 + k / 7}, length: 0.1}}}}" for k in range(bars)),
        "  joints:",
        "    j0: {pin: [ground.O, b0.start]}",
        *(f"    j{k}: {{pin: [b{k - 1}.end, b{k}.start]}}" for k in range(1, bars)),
        "initial: {" + ", ".join(f"b{k}: {{angle: {-80 + k} deg}}" for k in range(bars)) + "}",
        "allow: {b0.angle: 1.0e-3}\n",
    ]
    return "\n".join(lines)


def peak(call: Callable[[], Any]) -> tuple[Any, int]:
    """The call's value, and how many bytes it had at once."""
    tracemalloc.start()
    try:
        return call(), tracemalloc.get_traced_memory()[1]
    finally:
        tracemalloc.stop()


@pytest.mark.mutant("all pairs of a mechanism's rates are looked at at once")
def test_pairs_of_rates_are_looked_at_in_blocks() -> None:
    """All at once, those of 150 rates are 108 MB, and many times that with what is added up."""
    n = 150
    T = lambda t, q, v: sum(k * rate * rate for k, rate in enumerate(v, start=1)) / 2  # noqa: E731
    M, size = peak(lambda: lagrange.curvature(T, 0.0, np.zeros(n), n))
    assert np.allclose(M, np.diag(np.arange(1.0, n + 1.0)), atol=1e-12)
    assert size < 8 * 8 * lagrange.NUMBERS  # eight arrays of so many numbers


@pytest.mark.mutant("a block of rates is put in another's place")
@pytest.mark.parametrize("rates", [1, 3, 7])
def test_blocks_change_no_bit(rates: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    system = mechanism(typed(tmp_path, chain(bars=12)))
    mode, q, v = system.start()
    whole = lagrange.mass_matrix(system.modes[mode], 0.0, q)
    monkeypatch.setattr(lagrange, "NUMBERS", rates * 4 * len(v) ** 2)
    assert np.array_equal(lagrange.mass_matrix(system.modes[mode], 0.0, q), whole)


@pytest.mark.mutant("all derivatives of a mechanism's constraints are kept at once")
def test_what_no_coordinate_changes_is_found_in_little_memory(tmp_path: Path) -> None:
    """n derivatives of n r constraints each are mostly zeros: 90 × 90 × 60 here."""
    system = mechanism(typed(tmp_path, chain(bars=30)))
    mode, q, v = system.start()
    found, size = peak(lambda: ignorable(system.modes[mode], 0.0, q, v))
    assert size < 90 * 90 * 60 * 8
    assert found == [k for k in range(90) if k % 3 != 2]  # all but the angles
