"""Events without end: the motion goes on from their limit, or is told to have none."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
from given import scenes
from given.watched import Oscillator, Still, Watched

from textmech.reference.motion import follow as event
from textmech.reference.motion import zeno as module
from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError, accumulation, ends_here, settles
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk


def limit(e: float) -> float:
    """t₁ + 2 t₁ (e + e² + …) [s]: where the bounces of `disk` end."""
    return math.sqrt(2 * 0.5 / 9.80665) * (1 + e) / (1 - e)


def disk(e: float) -> BouncingDisk:
    return BouncingDisk(m=1.0, R=0.2, e=e, y0=0.7)


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.001, 0.2, 0.5, 0.9])
def test_a_disk_that_bounces_ever_lower_rests(e: float):
    times = np.linspace(0.0, 2 * limit(e), 41)
    found = follow(disk(e), times)
    assert found.modes[0] == "flight"
    assert {mode for mode, t in zip(found.modes, times, strict=True) if t > limit(e)} == {"rest"}
    assert limit(e) - 1e-5 * times[-1] < found.changes[-1].time <= limit(e)
    known = np.array([np.concatenate(disk(e).closed_form(t)) for t in times.tolist()])
    np.testing.assert_allclose(found.y, known, atol=1e-11)
    assert len(found.events) == len(disk(e).closed_events(times[-1]))


def test_heights_between_the_bounces():
    """eᵏ g t₁ after the k-th: a bounce that gave back e each time from the first would be seen."""
    impacts = [t for _, t in disk(0.5).closed_events(0.95)]
    middles = (np.array(impacts[1:-1]) + impacts[2:]) / 2
    tops = [disk(0.5).closed_form(t)[0][0] for t in middles.tolist()]
    np.testing.assert_allclose(tops, 0.5 * 0.25 ** np.arange(2, len(tops) + 2), rtol=1e-9)


THROWN = """\
scene:
  bodies: {wheel: {disk: {mass: 2, radius: 0.25}}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.4, restitution: 0.5}}
initial: {wheel: {x: 0, y: 1.25, angle: 0, vx: VX, vy: 0, omega: 0}}
events: {bounces: {touch.gap: falls to zero}}
allow: {wheel.x: 1.0e-3}
"""


@pytest.mark.parametrize(("vx", "mode"), [(1.0, "touch sticks"), (30.0, "touch slides +")])
def test_what_it_does_on_the_floor_after_the_last_bounce(tmp_path: Path, vx: float, mode: str):
    """Friction has had μ times the momentum of the floor, m (2 g t₁ + … + g τ), or it rolls."""
    case = scenes.typed(tmp_path, THROWN.replace("VX", str(vx)), tail=scenes.tail(2.0, 26))
    found = follow(scenes.mechanism(case), case.times)
    assert found.modes[-1] == mode
    v = vx - 0.4 * 9.80665 * 2.0 if vx > 10.0 else vx * 2 / 3
    t1 = math.sqrt(2 * 1.0 / 9.80665)
    assert 3 * t1 < 1.4  # the last bounce
    np.testing.assert_allclose(found.y[-1, 3], v, rtol=1e-11)
    np.testing.assert_allclose(found.y[-1, [1, 4]], [0.25, 0.0], atol=1e-12)


def test_a_system_that_knows_no_rest_ends_with_a_message():
    """Without `at_last` the events have no limit to go on from."""

    class Endless(BouncingDisk):
        def guards(self, mode: str) -> Sequence[Guard]:
            return [replace(guard, at_last=None) for guard in super().guards(mode)]

    with pytest.raises(ZenoError, match=r"'bounces' happens without end .*Zeno") as caught:
        follow(Endless(m=1.0, R=0.2, e=0.5, y0=0.7), np.linspace(0.0, 2 * limit(0.5), 11))
    assert caught.value.event == "bounces"
    assert limit(0.5) * (1 - 1e-4) < caught.value.time < limit(0.5)


def test_zeno_sequence_that_the_motion_does_not_reach_is_none():
    times = np.linspace(0.0, 0.9, 10)  # it would end at 0.958 s
    found = follow(disk(0.5), times)
    assert [e.time for e in found.events] == pytest.approx(
        [t for _, t in disk(0.5).closed_events(0.9)], abs=1e-12, rel=0
    )


@pytest.mark.slow
def test_more_events_than_anyone_wants_end_with_a_message(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(event, "MOST", 30)
    beats = Watched([("beats", lambda t, x, v: math.cos(100 * t))], Still())
    beats.longest = 0.01
    with pytest.raises(ZenoError, match="'beats' is one of more than 30 events"):
        follow(beats, np.array([0.0, 7.0]))


class Chatter(System):
    """Two modes, each of which is to end at once; limit: whether the guards know one."""

    def __init__(self, *, limit: bool) -> None:
        self.limit = limit
        self.modes = {"on": Oscillator(), "off": Oscillator()}

    def start(self) -> tuple[str, Array, Array]:
        return "on", np.ones(1), np.zeros(1)

    def guards(self, mode: str) -> Sequence[Guard]:
        other = "off" if mode == "on" else "on"
        then = lambda t, q, v: (other, q, v)  # noqa: E731
        return [Guard(f"turns {other}", lambda t, q, v: -t, then, then if self.limit else None)]


@pytest.mark.parametrize("limit", [False, True])
def test_modes_that_end_where_they_begin_end_with_a_message(limit: bool):
    """Soon: a motion that rests nowhere would else go on for thousands of events."""
    chatter = Chatter(limit=limit)
    with pytest.raises(ZenoError, match="'turns o") as caught:
        follow(chatter, np.array([0.0, 1.0]))
    assert caught.value.time == 0.0


def test_accumulation():
    distances = 0.5 ** np.arange(1, 7)
    instants = np.cumsum(distances).tolist()
    assert accumulation(instants) == pytest.approx(1.0)
    assert accumulation(instants[:-1]) is None
    assert accumulation(list(range(6))) is None


def test_the_slowest_of_the_last_distances_tells():
    """Halved once and hardly shorter from then on: at 0.49 of 0.5 they come to 25, not to 2.5."""
    instants = np.cumsum([0.0, 1.0, 0.5, 0.49, 0.48, 0.47]).tolist()
    limit = accumulation(instants)
    assert limit == pytest.approx(instants[-1] + 0.47 * 0.98 / 0.02)  # of 0.49/0.5
    assert limit is not None
    assert not ends_here(limit, instants[-1], 0.0, 10.0)


@pytest.mark.mutant("an accumulation by the quickest of its distances")
def test_the_quickest_of_the_distances_is_seen(monkeypatch: pytest.MonkeyPatch):
    monkeypatch.setattr(module, "np", SimpleNamespace(diff=np.diff, max=np.min))
    with pytest.raises(AssertionError):
        test_the_slowest_of_the_last_distances_tells()


def test_distances_that_stay_pile_up_nowhere():
    assert not settles("bounces", [0.0, 1.0, 1.5, 1.99], 10.0)
    assert settles("bounces", [0.0, 1.0, 1.0 + 1e-13], 10.0)
