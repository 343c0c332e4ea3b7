"""What is stored comes back the same, to the last bit; nothing that could be code is stored."""

import json
import math
import pickle
from dataclasses import dataclass, fields, is_dataclass
from typing import Any

import numpy as np
import pytest
from given import scenes

from textmech.reports.batch.cache.form import packed, unpacked
from textmech.reports.compare.judge.compare import Outcome
from textmech.reports.data.row import Instant


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


@pytest.mark.slow
def test_a_solution_comes_back() -> None:
    """With events: it has a record and phases."""
    solution = scenes.solved("rolling_wheel.pushed")
    assert same(unpacked(packed(solution)), solution)


def test_an_outcome_comes_back() -> None:
    instant = Instant("a", "e", "1", "own", "native", "lands", 1, math.nan, -math.inf)
    outcome = Outcome([], samples={"x.y": np.array([0.1, -0.0, np.nan])}, instants=[instant])
    assert same(unpacked(packed(outcome)), outcome)


@pytest.mark.parametrize(
    "array",
    [
        np.zeros(0),
        np.zeros((3, 0), np.int64),
        np.array(1.5),
        np.array([True, False]),
        np.asfortranarray(np.arange(6.0).reshape(2, 3)),
        np.arange(3, dtype=">i4"),
    ],
)
def test_an_array_comes_back_with_its_shape_and_its_own_memory(array: np.ndarray) -> None:
    found = unpacked(packed({"a": array, "b": array}))
    assert all(same(each, array) and each.shape == array.shape for each in found.values())
    found["a"][...] = 1
    assert same(found["b"], array)


def test_an_array_of_what_could_be_code_is_not_read() -> None:
    head = json.dumps([{"array": 0}, [["|O", 1]]]).encode()
    with pytest.raises(ValueError, match="OBJECT"):
        unpacked(len(head).to_bytes(8) + head + bytes(8))


@dataclass(frozen=True)
class Unknown:
    """Not one of ours."""

    x: float


@pytest.mark.parametrize("value", [Unknown(1.0), len, np.array([len], dtype=object)])
def test_what_has_no_form_is_refused(value: Any) -> None:
    with pytest.raises(TypeError, match="no form"):
        packed(value)


def test_a_pickle_is_not_read() -> None:
    with pytest.raises((json.JSONDecodeError, UnicodeDecodeError)):
        unpacked(pickle.dumps(exit))
