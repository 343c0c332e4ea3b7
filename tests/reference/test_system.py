"""A smooth system is its only mode: what `Only` answers, and that following it is integrating."""

import numpy as np
import pytest
from given.examples import SMOOTH, example, only

from textmech.reference.integrators.explicit import dormand_prince
from textmech.reference.motion.follow import TOLERANCE, follow
from textmech.reference.motion.stuck import slope
from textmech.reference.system import MOVING, Only


@pytest.mark.parametrize("name", SMOOTH)
def test_only_answers_as_its_mode(name: str):
    mode = only(name)
    system = Only(mode)
    assert dict(system.modes) == {MOVING: mode}
    started, q, v = system.start()
    assert started == MOVING
    np.testing.assert_array_equal([q, v], mode.start())
    for t in (0.0, 0.7, 3.0):
        one, other = system.closed_form(t), mode.closed_form(t)
        assert (one is None) == (other is None)
        if one is not None and other is not None:
            np.testing.assert_array_equal(one, other)


@pytest.mark.parametrize("name", SMOOTH)
def test_nothing_ends_it_and_everything_is_possible(name: str):
    system = example(name)
    assert isinstance(system, Only)
    assert system.guards(MOVING) == ()
    assert system.closed_events(10.0) is None
    assert system.longest is None
    assert system.possible(MOVING, *(0.0, *system.start()[1:])) is None


@pytest.mark.parametrize("name", [name for name in SMOOTH if not only(name).stiff])
def test_following_it_is_integrating_its_mode(name: str):
    """To the last bit: there is no second path for what never switches."""
    mode, times = only(name), np.linspace(0.0, 1.0, 6)
    found = follow(Only(mode), times)
    y = dormand_prince(slope(mode), times, np.concatenate(mode.start()), tolerance=TOLERANCE).y
    np.testing.assert_array_equal(found.y, y)
    assert (found.phases, found.changes, found.modes) == ((MOVING,), (), (MOVING,) * 6)
