"""What a generated right side costs, beside a product of numpy's in the same moments."""

from collections.abc import Callable
from time import perf_counter

import numpy as np
import pytest
from given.skew_chain import chain

from textmech.reference.generated.space import assembled
from textmech.reference.generated.space.mode import SpatialMultibody

MOST = 90.0  # of ten small products, 190 µs; it is 65


def took(does: Callable[[], object], times: int) -> float:
    """[s] of one call."""
    begin = perf_counter()
    for _ in range(times):
        does()
    return (perf_counter() - begin) / times


def beside_numpy() -> float:
    mode = SpatialMultibody(chain(), (np.zeros(0), np.zeros(0)))
    q, v = np.zeros(len(mode.coordinates)), np.linspace(-1.0, 1.0, mode.where.size)
    for at in mode.where.columns.values():
        assert at.attitude is not None
        q[at.attitude] = 1.0
    blocks = np.ones((10, 3, 3))
    # Others use the machine, too: the quickest of many, in turns, each too short to be interrupted.
    pairs = [
        (
            took(lambda: mode.accelerations(0.0, q, v), 1),
            took(lambda: np.matmul(blocks, blocks), 20),
        )
        for _ in range(500)
    ]
    whole, one = np.min(pairs, axis=0)
    return float(whole / one)


def test_five_bodies_cost_little() -> None:
    assert beside_numpy() < MOST


def test_a_kind_computed_thrice_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    once = assembled.SpatialRows.at

    def thrice(self: assembled.SpatialRows, t: float, bodies: object) -> object:
        return [once(self, t, bodies) for _ in range(3)][-1]  # type: ignore[arg-type]

    monkeypatch.setattr(assembled.SpatialRows, "at", thrice)
    assert beside_numpy() > MOST
