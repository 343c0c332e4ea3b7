"""Blocks that viscous friction slows by a power of their speed: which stop, and how they rest."""

from typing import Any

import numpy as np
import pytest
from given.examples import example
from given.mutants import mutant, with_mode

from textmech.reference.motion.follow import follow
from textmech.reference.system import System
from textmech.reference.systems.particles.drag_stops import Slowing

TIMES = np.linspace(0.0, 4.0, 41)


def thrown(alpha: float) -> System:
    return example("drag_stops", alpha=alpha)


def apart(system: System, known: System) -> float:
    """The largest distance from a closed form."""
    closed = [known.closed_form(t) for t in TIMES.tolist()]
    rows = np.array([np.concatenate(row) for row in closed if row is not None])
    return float(np.abs(follow(system, TIMES).y - rows).max())


@pytest.mark.parametrize("alpha", [0.25, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0])
def test_motion_is_the_closed_form(alpha: float) -> None:
    assert apart(thrown(alpha), thrown(alpha)) < 1e-13


@pytest.mark.parametrize("alpha", [0.1, 0.25, 0.5, 0.75])
def test_it_stops_once_and_then_rests_exactly(alpha: float) -> None:
    system = thrown(alpha)
    found, known = follow(system, TIMES), system.closed_events(4.0)
    assert known is not None
    assert [e.name for e in found.events] == ["stops"] == [name for name, _ in known]
    assert abs(found.events[0].time - known[0][1]) < system.blurred
    rests = known[0][1] < TIMES
    assert rests.sum() > 3
    assert np.all(found.y[rests, 1] == 0.0)
    assert np.ptp(found.y[rests, 0]) == 0.0


@pytest.mark.parametrize("alpha", [1.0, 2.0])
def test_from_one_on_it_never_stops(alpha: float) -> None:
    system = thrown(alpha)
    assert system.closed_events(1e9) == []
    assert not follow(system, TIMES).events
    assert follow(system, TIMES).y[-1, 1] > 0.0


@pytest.mark.mutant("drag by a power {alpha}: {wrong} times what it is")
@pytest.mark.parametrize("alpha", [0.5, 1.0, 2.0])
@pytest.mark.parametrize("wrong", [{"alpha": 1.1}, {"d": 1.05}, {"m": 0.95}, {"d": -0.02}])
def test_another_law_is_seen_by_the_closed_form(alpha: float, wrong: dict[str, float]) -> None:
    numbers = {"m": 2.0, "d": 3.0, "alpha": alpha}
    m, d, power = (value * wrong.get(key, 1.0) for key, value in numbers.items())
    off = Slowing(m, d, power)
    assert apart(with_mode(thrown(alpha), "moves", off), thrown(alpha)) > 1e-3


@pytest.mark.mutant("drag: a stop at 1e-6 m/s, not at zero")
def test_a_stop_at_a_threshold_is_seen() -> None:
    """`v < 1e-6` in the place of v = 0: 0.9 ms too early."""
    system: Any = thrown(0.5)

    def early(self: System, mode: str) -> Any:
        found = system.guards(mode)
        return [type(g)(g.event, lambda t, q, v: v[0] - 1e-6, g.then) for g in found]

    known = system.closed_events(4.0)[0][1]
    late = follow(mutant(system, guards=early), TIMES).events[0].time - known
    assert abs(late) > 100 * system.blurred
