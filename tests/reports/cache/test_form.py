"""What is stored comes back the same, to the last bit; nothing that could be code is stored."""

import math
import pickle
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reports.cache.form import packed, unpacked
from textmech.reports.judge.compare import Outcome
from textmech.reports.row import Instant


def same(one: Any, other: Any) -> bool:
    if isinstance(one, np.ndarray):
        return one.dtype == other.dtype and one.tobytes() == other.tobytes()
    if is_dataclass(one):
        return type(one) is type(other) and all(
            same(getattr(one, f.name), getattr(other, f.name)) for f in fields(one)
        )
    if isinstance(one, dict):
        return list(one) == list(other) and all(same(one[k], other[k]) for k in one)
    if isinstance(one, list | tuple):
        alike = type(one) is type(other) and len(one) == len(other)
        return alike and all(map(same, one, other))
    return type(one) is type(other) and (one == other or (one != one and other != other))


def test_a_solution_comes_back() -> None:
    """With events: it has a record and phases."""
    solution = scenes.solved("rolling_wheel.pushed")
    assert same(unpacked(packed(solution)), solution)


def test_an_outcome_comes_back() -> None:
    instant = Instant("a", "e", "1", "own", "native", "lands", 1, math.nan, -math.inf)
    outcome = Outcome([], samples={"x.y": np.array([0.1, -0.0, np.nan])}, instants=[instant])
    assert same(unpacked(packed(outcome)), outcome)


@dataclass(frozen=True)
class Unknown:
    """Not one of ours."""

    x: float


@pytest.mark.parametrize("value", [Unknown(1.0), len, np.array([len], dtype=object)])
def test_what_has_no_form_is_refused(value: Any) -> None:
    with pytest.raises(TypeError, match="no form"):
        packed(value)


def test_a_pickle_is_not_read() -> None:
    with pytest.raises(ValueError, match="pickle"):
        unpacked(pickle.dumps(exit))
