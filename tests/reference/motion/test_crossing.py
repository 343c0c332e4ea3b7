"""Events: located, ordered, and never missed."""

import math
from collections.abc import Callable

import numpy as np
import pytest
from given.otherwise import otherwise
from given.watched import Oscillator, Still, Watched, events

from textmech.reference.motion import event_location as module
from textmech.reference.motion.event_location import crossing
from textmech.reference.motion.follow import follow
from textmech.reference.system import TOGETHER


def test_event_is_located():
    found = events(("down", lambda t, x, v: x), until=20.0)
    known = [math.pi / 2 + 2 * math.pi * k for k in range(3)]
    assert [name for name, _ in found] == ["down"] * 3
    assert [time for _, time in found] == pytest.approx(known, abs=1e-12, rel=0)


@pytest.mark.mutant("an event at a threshold of 1e-6, not at zero")
def test_threshold_in_place_of_the_event_is_seen():
    """Where |x| falls below 1e-6 instead of through zero, the event comes 1e-6 s early."""
    [(_, time)] = events(("down", lambda t, x, v: x - 1e-6), until=5.0)
    assert abs(time - math.pi / 2) > 1e5 * TOGETHER


@pytest.mark.parametrize("depth", [0.5, 1e-3, 1e-6, 1e-9])
def test_dip_within_a_step_is_seen(depth: float):
    """x + 1 − depth is negative for 2 acos(1 − depth) around t = π only."""
    found = events(("dips", lambda t, x, v: x + 1.0 - depth), until=6.0, samples=2)
    # x is flat there: rounding of 1e-16 in x moves the time by 1e-16/√(2 depth).
    margin = 1e-12 + 1e-15 / math.sqrt(depth)
    assert [time for _, time in found] == [pytest.approx(math.acos(depth - 1), abs=margin, rel=0)]


def test_near_miss_is_none():
    assert events(("dips", lambda t, x, v: x + 1.0 + 1e-9), until=6.0, samples=2) == []


def test_first_of_simultaneous_guards_wins():
    first, second = ("first", lambda t, x, v: x), ("second", lambda t, x, v: 2 * x)
    for order in ([first, second], [second, first]):
        assert [name for name, _ in events(*order, until=3.0, after="off")] == [order[0][0]]


def test_earlier_guard_wins_whatever_the_order():
    late, early = ("late", lambda t, x, v: x), ("early", lambda t, x, v: x - 1e-6)
    assert [name for name, _ in events(late, early, until=3.0, after="off")] == ["early"]


def test_rising_guard_is_no_event():
    assert events(("up", lambda t, x, v: -x), until=math.pi) == []


def test_guard_at_zero_that_falls_ends_the_mode_at_once():
    [(_, time)] = events(("now", lambda t, x, v: v), until=1.0, after="off")
    assert time == 0.0


@pytest.mark.slow
def test_guard_of_time_alone_is_met_by_steps_that_are_not_too_long():
    """While nothing moves, a step may be as long as the motion: `longest` bounds it."""
    still = Watched([("beats", lambda t, x, v: math.cos(20 * t) + 0.9)], Still())
    known = [(math.acos(-0.9) + 2 * math.pi * k) / 20 for k in range(32)]
    still.longest = 0.05
    found = follow(still, np.array([0.0, 10.0])).events
    assert [e.time for e in found] == pytest.approx(known, abs=1e-12, rel=0)
    assert [e.k for e in found] == list(range(1, 33))


@pytest.mark.parametrize("height", [0.5, 1e-3, 1e-6, 1e-9])
def test_hump_within_a_step_is_seen(height: float):
    """x is above 1 − height only around t = 2π: the guard rises and falls within a step."""
    found = events(("ends", lambda t, x, v: x - 1.0 + height), until=9.0, samples=2)
    known = [math.acos(1 - height), 2 * math.pi + math.acos(1 - height)]
    margin = 1e-12 + 1e-15 / math.sqrt(height)
    assert [time for _, time in found] == pytest.approx(known, abs=margin, rel=0)


@pytest.mark.parametrize("sink", [0.0, 1e-15, -1e-15])
def test_a_touch_is_no_fall(sink: float):
    """x + 1 comes to zero at t = π: by rounding above it, on it, or below."""
    touch = ("touches", lambda t, x, v: x + 1.0 - sink)
    for times in ([0.0, 6.0], [0.0, math.pi, 6.0]):
        found = follow(Watched([touch], Oscillator()), np.array(times))
        assert found.events == ()
        assert found.touched
        for each in found.touched:  # where a quarter of 1e-8 from there is seen by no guard
            assert each.name == "touches"
            assert each.time == pytest.approx(math.pi, rel=0, abs=1e-4)


def test_what_stays_clear_and_what_falls_is_no_touch():
    clear = ("clear", lambda t, x, v: x + 1.0 + 1e-6)
    falls = ("falls", lambda t, x, v: x + 1.0 - 1e-6)
    begins = ("begins", lambda t, x, v: 1.0 - x)
    for guard in (clear, falls, begins):
        assert follow(Watched([guard], Oscillator()), np.array([0.0, 3.0, 6.0])).touched == ()


POINTS = [0.0, 0.25, 0.5, 0.75, 1.0]


def found(g: Callable[[float], float], h: float = 1.0, **how: bool) -> float | None:
    how, points = {"begins": False, "spent": False} | how, [h * at for at in POINTS]
    return crossing(g, points, [g(at) for at in points], **how)[0]


def dips(a: float, b: float) -> Callable[[float], float]:
    return lambda t: (t - a) * (t - b)


@pytest.mark.parametrize(("a", "b"), [(0.3, 0.45), (0.26, 0.49), (0.55, 0.7), (0.02, 0.2)])
def test_a_dip_between_the_points_is_found(a: float, b: float):
    """At every point it is positive."""
    assert found(dips(a, b)) == pytest.approx(a, abs=4e-15)


@pytest.mark.parametrize(("a", "b"), [(0.55, 0.7), (0.8, 0.95)])
def test_a_dip_after_a_rise_is_found(a: float, b: float):
    """It begins below zero, as the guard that ended the mode before; that is no fall."""
    g = lambda t: (t - 0.1) * (t - a) * (t - b)  # noqa: E731
    assert g(0.0) < 0.0 < g(0.25)
    assert found(g, spent=True) == pytest.approx(a, abs=4e-15)


SHORT = 1e-4  # of a step: how long a dip lasts, whose depth is 25 times what counts as a touch


def begun_just_before(at: float) -> Callable[[float], float]:
    """A dip that rounding sets below zero at one of the points, and that deepens beyond it."""
    return dips(at - 1e-13, at + SHORT)


@pytest.mark.parametrize("at", [0.25, 0.5, 0.75, 1.0])
def test_a_dip_that_begins_at_a_point_is_no_touch(at: float):
    """It is as deep as a touch at the point, and above zero at all that are looked at beyond."""
    assert found(begun_just_before(at)) == pytest.approx(at, abs=1e-12)


@pytest.mark.mutant("a dip's bottom is not looked for between a point and the next beyond")
def test_a_dip_taken_for_a_touch_is_seen():
    g = begun_just_before(0.5)
    blind = otherwise(module, "return bool(turn.fun >= -deep)", "return True")
    assert blind.crossing(g, POINTS, [g(t) for t in POINTS], begins=False, spent=False)[0] is None


def test_a_fall_at_once_is_found_though_it_comes_back():
    """It begins at zero, falls at once or after a short rise, and is above zero at the end."""
    assert found(dips(0.0, 0.6), begins=True) == 0.0
    assert found(lambda t: t * (t - 1e-3) * (t - 0.6), begins=True) == pytest.approx(1e-3)
    assert found(dips(0.0, 0.6), begins=True, spent=True) is None


@pytest.mark.mutant("a guard that falls at once and comes back in the same step has not fallen")
def test_a_fall_at_once_that_is_passed_over_is_seen():
    g = dips(0.0, 0.6)
    given = (g, POINTS, [g(t) for t in POINTS])
    assert crossing(*given, begins=True, spent=False)[0] == 0.0
    blind = otherwise(module, "if begins and not spent and rise:", "if False:")
    assert blind.crossing(*given, begins=True, spent=False)[0] != 0.0


@pytest.mark.mutant("a guard that dips below zero between the points of a step")
def test_a_dip_that_is_not_looked_for_is_seen(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(module, "_near", lambda *given: None)
    assert found(dips(0.3, 0.45)) is None


def let_go(t: float) -> float:
    """What is left [m] of a rope of 0.5 m that begins to part at 2e-6 m/s, and is taut at 1e-5 s.

    As it is computed it is too short by an ulp of its length at first, and for picoseconds.
    """
    return ((0.5 + 2e-6 * t * (1 - t / 1e-5)) - 0.5) + 1.1e-16 * (t < 1e-12)


def test_a_zero_that_is_rounded_up_begins_and_does_not_fall():
    assert found(let_go, begins=True, h=4e-4) == pytest.approx(1e-5, rel=1e-3)
    assert found(lambda t: 1e-16 - t, begins=True, h=4e-4) == pytest.approx(0.0, abs=TOGETHER)
    assert found(lambda t: 1e-6 - t, begins=True, h=4e-4) == pytest.approx(1e-6, abs=TOGETHER)


@pytest.mark.mutant("a zero that rounding has made positive, and that rises first, falls at once")
def test_a_rise_that_is_not_looked_for_is_seen():
    points = [4e-4 * t for t in POINTS]
    given = (let_go, points, [let_go(t) for t in points])
    blind = otherwise(module, "if begins and fall == 1:", "if False:")
    at = blind.crossing(*given, begins=True, spent=False)[0]
    assert at < 1e-10  # where the secant to the first point first meets rounding, and not 1e-5
