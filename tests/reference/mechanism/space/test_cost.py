"""What a generated right side costs: calls, which are as many on every machine.

No test tells its time. Beside a product of numpy's it took so differently on two processors that no
bound told one computation from three.
"""

import sys
from types import FrameType

import numpy as np
import pytest
from given.skew_chain import chain

from textmech.reference.mechanism.constraints.space import constraint_jacobian as assembled
from textmech.reference.mechanism.modes.space.mode import SpatialMultibody

MOST = 100  # it is 83


def calls() -> int:
    """Of functions, in one right side of five bodies."""
    mode = SpatialMultibody(chain(), (np.zeros(0), np.zeros(0)))
    q, v = np.zeros(len(mode.coordinates)), np.linspace(-1.0, 1.0, mode.where.size)
    for at in mode.where.columns.values():
        assert at.attitude is not None
        q[at.attitude] = 1.0
    mode.accelerations(0.0, q, v)  # what is kept from the first on is not counted
    counted: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        if event in ("call", "c_call"):
            counted.append(event)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        mode.accelerations(0.0, q, v)
    finally:
        sys.setprofile(before)
    return len(counted)


def test_five_bodies_cost_little() -> None:
    assert calls() < MOST


def test_a_kind_computed_thrice_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    once = assembled.SpatialRows.at

    def thrice(self: assembled.SpatialRows, t: float, bodies: object) -> object:
        return [once(self, t, bodies) for _ in range(3)][-1]  # type: ignore[arg-type]

    monkeypatch.setattr(assembled.SpatialRows, "at", thrice)
    assert calls() > MOST
