"""What a ratio is: of the same round, its median, and half of what the middle half spans."""

import numpy as np
import pytest

from bench.turns import Work, ratio, turns


def test_a_rounds_own_ratio_counts() -> None:
    """A machine that is ten times slower in some rounds slows both works."""
    slow = np.array([1.0, 10.0, 1.0, 10.0, 1.0])
    assert ratio(1.1 * slow, slow).median == pytest.approx(1.1)
    assert ratio(1.1 * slow, slow).spread == pytest.approx(0.0)


def test_one_round_that_was_disturbed_does_not_count() -> None:
    found = ratio(np.array([1.0, 1.1, 9.0, 1.2, 1.3]), np.ones(5))
    assert (found.median, found.spread) == (1.2, pytest.approx(0.1))
    assert str(found) == "1.20 ±0.10"


def test_works_are_prepared_and_done_in_turn() -> None:
    done: list[str] = []

    def named(name: str):
        def prepare(k: int) -> Work:
            done.append(f"prepare {name}{k}")
            return lambda: done.append(f"{name}{k}")

        return prepare

    seconds = turns([named("a"), named("b")], 2)
    assert seconds.shape == (2, 2)
    assert (seconds >= 0).all()
    wanted = "prepare a0,a0,prepare b0,b0,prepare a1,a1,prepare b1,b1"
    assert done == wanted.split(",")
