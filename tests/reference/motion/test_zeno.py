"""Events without end are told as such, and no others."""

import math
from collections.abc import Sequence

import numpy as np
import pytest
from given.watched import Oscillator, Still, Watched

from textmech.reference.motion import follow as event
from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError, accumulation
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.bouncing_disk import BouncingDisk


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


def test_accumulation():
    distances = 0.5 ** np.arange(1, 7)
    instants = np.cumsum(distances).tolist()
    assert accumulation(instants) == pytest.approx(1.0)
    assert accumulation(instants[:-1]) is None
    assert accumulation(list(range(6))) is None
