"""What a generated right side costs: calls, which are as many on every machine.

No test tells its time. Beside a product of numpy's it took so differently on two processors that no
bound told one computation from three.
"""

import sys
from types import FrameType

import numpy as np
import pytest
from given.skew_chain import chain

from textmech.reference.mechanism.constraints.equation_table import Table
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody

MOST = 37  # it is 31, and 43 where the table is filled for each who asks


def calls() -> int:
    """Of functions, in one right side of five bodies."""
    mode = SpatialMultibody(chain(), (np.zeros(0), np.zeros(0)))
    q, v = np.zeros(len(mode.coordinates)), np.linspace(-1.0, 1.0, mode.where.size)
    for at in mode.where.slots.values():
        assert at.attitude is not None
        q[at.attitude] = 1.0
    mode.accelerations(0.0, q, v)  # what is kept from the first on is not counted
    counted: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        noting = frame.f_code.co_name == "noted"  # which equations run
        if event in ("call", "c_call") and not noting:
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


def test_a_table_that_is_filled_for_each_who_asks_would_be_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    once = Table.numbers

    def again(self: Table, *given: object) -> object:
        self._at = None  # what was found at this state is forgotten
        return once(self, *given)

    monkeypatch.setattr(Table, "numbers", again)
    assert calls() > MOST
