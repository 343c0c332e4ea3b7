"""States beside a motion: such as the mode allows, and elsewhere than the motion was."""

from typing import Any

import numpy as np
import pytest
from given.examples import only
from given.formal import FORMAL
from given.formal import drawn as formal
from given.mutants import mutant
from given.states import states

from textmech.reference.certificate.laws import drawn, moved
from textmech.reference.system import Array, Mode

TIMES = np.linspace(0.0, 2.0, 5)


def motion(name: str) -> tuple[Mode, Array]:
    """A mode, and five of its states as if they were a motion."""
    if name in FORMAL:
        return FORMAL[name], np.array([np.concatenate(at[1:]) for at in formal(name, 5)])
    return only(name), np.array([np.concatenate(at[1:]) for at in states(name, "moving", 5)])


@pytest.mark.parametrize("name", [*FORMAL, "four_bar", "rolling_wheel"])
def test_states_are_such_as_the_mode_allows(name: str) -> None:
    mode, y = motion(name)
    found = list(drawn(mode, TIMES, y, 20))
    assert len(found) == 20
    for t, q, v in found:
        assert t in TIMES
        assert np.max(np.abs(mode.f(t, q)), initial=0.0) < 1e-12
        rows = np.reshape(mode.f_a(t, q), (-1, len(v)))
        assert np.max(np.abs(rows @ v - mode.g(t, q)), initial=0.0) < 1e-12
        if "q3" in mode.coordinates:
            assert abs(q[-4:] @ q[-4:] - 1.0) < 1e-14


def test_states_are_elsewhere_and_the_same_each_time() -> None:
    mode, y = motion("four_bar")
    found = [q for _, q, _ in drawn(mode, TIMES, y, 20)]
    assert min(np.max(np.abs(q - row[:3])) for q in found for row in y) > 1e-3
    again = [q for _, q, _ in drawn(mode, TIMES, y, 20)]
    np.testing.assert_array_equal(found, again)


def test_what_only_turns_about_one_axis_is_turned_about_others() -> None:
    mode = FORMAL["free body"]
    row = np.concatenate([np.zeros(3), [1.0, 0.0, 0.0, 0.0], np.zeros(3), [0.0, 0.0, 2.0]])
    (_, q, v), *_ = drawn(mode, TIMES, np.array([row] * 5), 1)
    assert np.min(np.abs(q[3:6])) > 1e-3
    assert np.min(np.abs(v[3:])) > 1e-3


def test_a_long_way_keeps_the_length_of_a_quaternion_or_is_not_gone() -> None:
    mode, q = FORMAL["top"], np.array([0.5, 0.5, 0.5, 0.5])
    there = moved(mode, 0.0, q, np.array([0.9, -0.8, 0.7]))
    assert there is not None
    assert abs(there @ there - 1.0) < 1e-15
    assert moved(mode, 0.0, q, np.array([90.0, -80.0, 70.0])) is None


def test_where_the_mode_has_no_answer_another_state_is_drawn() -> None:
    sound, y = motion("four_bar")

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        if not np.min(np.abs(y[:, 0] - q[0])) < 1e-2:
            raise ArithmeticError("too far")
        return sound.accelerations(t, q, v)

    found = [q for _, q, _ in drawn(mutant(sound, accelerations=accelerations), TIMES, y, 20)]
    assert len(found) == 20
    assert all(np.min(np.abs(y[:, 0] - q[0])) < 1e-2 for q in found)
