"""Matrices of a reference are small: what shares them among threads waits, and rounds otherwise."""

import numpy as np
import pytest
from given import scenes

from textmech.reference import solve as door
from textmech.reference.solve import _libraries, one_thread


def counts() -> list[int]:
    return [count() for count, _ in _libraries()]


def test_there_is_one_within_and_afterwards_as_many_as_before() -> None:
    for _, put in _libraries():
        put(2)
    before = counts()
    with one_thread():
        assert counts() == [1] * len(before)
    assert counts() == before
    with pytest.raises(ZeroDivisionError), one_thread():
        raise ZeroDivisionError
    assert counts() == before


@pytest.mark.slow
def test_a_reference_is_solved_so(monkeypatch: pytest.MonkeyPatch) -> None:
    if not _libraries():
        pytest.skip("numpy brings no OpenBLAS here")
    for _, put in _libraries():
        put(2)
    seen: list[int] = []
    real = door.certify
    monkeypatch.setattr(door, "certify", lambda *a: (seen.extend(counts()), real(*a))[1])
    door.solve(next(iter(scenes.SHIPPED.values())))
    assert seen
    assert np.all(np.array(seen) == 1)
