"""Events: located, ordered, never missed, and never without end."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np
import pytest

from textmech.reference.motion import follow as event
from textmech.reference.motion.crossing import TOGETHER
from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError, accumulation
from textmech.reference.system import Array, Guard, Mode, System
from textmech.reference.systems.bouncing_disk import BouncingDisk


class Oscillator(Mode):
    """q̈ = −q."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return -q


class Still(Mode):
    """Nothing moves."""

    coordinates = ("x",)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.zeros(1)


Plain = Callable[[float, float, float], float]


@dataclass
class Watched(System):
    """x = cos t (or rest at 1) with guards that change nothing, but may end in another mode."""

    watched: Sequence[tuple[str | None, Plain]]
    system: Mode
    after: str = "on"

    def __post_init__(self) -> None:
        self.modes = {"on": self.system, "off": Still()}

    def start(self) -> tuple[str, Array, Array]:
        return "on", np.ones(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        return [
            Guard(
                name,
                lambda t, q, v, g=g: g(t, float(q[0]), float(v[0])),
                lambda t, q, v: (self.after, q, v),
            )
            for name, g in (self.watched if mode == "on" else ())
        ]


def events(*watched: tuple[str | None, Plain], until: float = 10.0, samples: int = 11, **options):
    times = np.linspace(0.0, until, samples)
    return [
        (e.name, e.time) for e in follow(Watched(watched, Oscillator(), **options), times).events
    ]


def test_event_is_located():
    found = events(("down", lambda t, x, v: x), until=20.0)
    known = [math.pi / 2 + 2 * math.pi * k for k in range(3)]
    assert [name for name, _ in found] == ["down"] * 3
    assert [time for _, time in found] == pytest.approx(known, abs=1e-12, rel=0)


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


def test_sample_on_an_event_holds_the_state_after_it():
    disk = BouncingDisk(m=1.0, R=0.25, e=1.0, y0=0.75)
    times = [t for _, t in disk.closed_events(3.0)]
    found = follow(disk, np.array([0.0, *times]))
    assert len(found.events) == len(times)
    for row, e in zip(found.y[1:], found.events, strict=True):
        np.testing.assert_array_equal(row, e.after)
        assert row[1] > 0.0 > e.before[1]


def test_change_without_a_name_is_no_event():
    times = np.linspace(0.0, 3.0, 4)
    found = follow(Watched([(None, lambda t, x, v: x)], Oscillator(), "off"), times)
    assert found.events == ()
    assert [(c.mode_before, c.mode_after) for c in found.changes] == [("on", "off")]
    assert found.modes == ("on", "on", "off", "off")


def test_guard_of_time_alone_is_met_by_steps_that_are_not_too_long():
    """While nothing moves, a step may be as long as the motion: `longest` bounds it."""
    still = Watched([("beats", lambda t, x, v: math.cos(20 * t) + 0.9)], Still())
    known = [(math.acos(-0.9) + 2 * math.pi * k) / 20 for k in range(32)]
    still.longest = 0.05
    found = follow(still, np.array([0.0, 10.0])).events
    assert [e.time for e in found] == pytest.approx(known, abs=1e-12, rel=0)
    assert [e.k for e in found] == list(range(1, 33))


@pytest.mark.parametrize("e", [0.2, 0.5, 0.9, 0.95])
def test_zeno_sequence_ends_with_a_message(e: float):
    disk = BouncingDisk(m=1.0, R=0.2, e=e, y0=0.7)
    end = math.sqrt(2 * 0.5 / 9.80665) * (1 + e) / (1 - e)
    with pytest.raises(ZenoError, match=r"'bounces' happens without end .*Zeno") as caught:
        follow(disk, np.linspace(0.0, 2 * end, 11))
    assert caught.value.event == "bounces"
    assert end - 1e-4 * end < caught.value.time < end


def test_zeno_sequence_that_the_motion_does_not_reach_is_none():
    disk = BouncingDisk(m=1.0, R=0.2, e=0.5, y0=0.7)
    times = np.linspace(0.0, 0.9, 10)  # it would end at 0.958 s
    found = follow(disk, times)
    assert [e.time for e in found.events] == pytest.approx(
        [t for _, t in disk.closed_events(0.9)], abs=1e-12, rel=0
    )


def test_more_events_than_anyone_wants_end_with_a_message(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(event, "MOST", 30)
    beats = Watched([("beats", lambda t, x, v: math.cos(100 * t))], Still())
    beats.longest = 0.01
    with pytest.raises(ZenoError, match="'beats' is one of more than 30 events"):
        follow(beats, np.array([0.0, 7.0]))


class Chatter(System):
    """Two modes, each of which is to end at once."""

    def __init__(self) -> None:
        self.modes = {"on": Oscillator(), "off": Oscillator()}

    def start(self) -> tuple[str, Array, Array]:
        return "on", np.ones(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        other = "off" if mode == "on" else "on"
        return [Guard(f"turns {other}", lambda t, q, v: -t, lambda t, q, v: (other, q, v))]


def test_modes_that_end_where_they_begin_end_with_a_message():
    with pytest.raises(ZenoError, match="'turns o"):
        follow(Chatter(), np.array([0.0, 1.0]))


@pytest.mark.parametrize("height", [0.5, 1e-3, 1e-6, 1e-9])
def test_hump_within_a_step_is_seen(height: float):
    """x is above 1 − height only around t = 2π: the guard rises and falls within a step."""
    found = events(("ends", lambda t, x, v: x - 1.0 + height), until=9.0, samples=2)
    known = [math.acos(1 - height), 2 * math.pi + math.acos(1 - height)]
    margin = 1e-12 + 1e-15 / math.sqrt(height)
    assert [time for _, time in found] == pytest.approx(known, abs=margin, rel=0)


def test_accumulation():
    distances = 0.5 ** np.arange(1, 7)
    instants = np.cumsum(distances).tolist()
    assert accumulation(instants) == pytest.approx(1.0)
    assert accumulation(instants[:-1]) is None
    assert accumulation(list(range(6))) is None
