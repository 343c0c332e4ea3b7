"""Events without end: the motion goes on from their limit, or is told to have none."""

import math
from collections.abc import Sequence
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from given import scenes
from given.machines.watched import Oscillator, Still, Watched

from textmech.cases.mistake import CaseError
from textmech.reference.motion import follow as event
from textmech.reference.motion import zeno as module
from textmech.reference.motion.follow import follow
from textmech.reference.motion.zeno import ZenoError, accumulation, ends_here, settles
from textmech.reference.solve import solve
from textmech.reference.system import Array, Guard, System
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk

Patch = pytest.MonkeyPatch
G = 9.80665  # m/s²


def limit(e: float) -> float:
    """t₁ + 2 t₁ (e + e² + …) [s]: where the bounces of `disk` end."""
    return math.sqrt(2 * 0.5 / G) * (1 + e) / (1 - e)


def disk(e: float) -> BouncingDisk:
    return BouncingDisk(m=1.0, R=0.2, e=e, y0=0.7)


@pytest.mark.slow
@pytest.mark.parametrize("e", [0.001, 0.9])
def test_a_disk_that_bounces_ever_lower_rests(e: float) -> None:
    times = np.linspace(0.0, 2 * limit(e), 41)
    found = follow(disk(e), times)
    assert found.modes[0] == "flight"
    assert {mode for mode, t in zip(found.modes, times, strict=True) if t > limit(e)} == {"rest"}
    assert limit(e) - 1e-5 * times[-1] < found.changes[-1].time <= limit(e)
    known = np.array([np.concatenate(disk(e).closed_form(t)) for t in times.tolist()])
    np.testing.assert_allclose(found.y, known, atol=1e-11)
    assert len(found.events) == len(disk(e).closed_events(times[-1]))


def test_bounces_whose_end_the_motion_does_not_reach_are_all_there() -> None:
    """eᵏ g t₁ after the k-th: a bounce that gave back e each time from the first would be seen."""
    known = [t for _, t in disk(0.5).closed_events(0.95)]
    found = follow(disk(0.5), np.linspace(0.0, 0.95, 10))  # it would end at 0.958 s
    assert [e.time for e in found.events] == pytest.approx(known, abs=1e-12, rel=0)
    middles = (np.array(known[1:-1]) + known[2:]) / 2
    tops = [disk(0.5).closed_form(t)[0][0] for t in middles.tolist()]
    np.testing.assert_allclose(tops, 0.5 * 0.25 ** np.arange(2, len(tops) + 2), rtol=1e-9)


@pytest.mark.slow
@pytest.mark.parametrize(("vx", "mode"), [(1.0, "touch sticks"), (30.0, "touch slides +")])
def test_what_it_does_on_the_floor_after_the_last_bounce(vx: float, mode: str) -> None:
    """Friction has had μ times the momentum of the floor, m (2 g t₁ + … + g τ), or it rolls."""
    text = f"""\
scene:
  bodies: {{wheel: {{disk: {{mass: 2, radius: 0.25}}}}}}
  contacts: {{touch: {{between: [wheel, ground.floor], friction: 0.4, restitution: 0.5}}}}
initial: {{wheel: {{x: 0, y: 1.25, angle: 0, vx: {vx}, vy: 0, omega: 0}}}}
events: {{bounces: {{touch.gap: falls to zero}}}}
allow: {{wheel.x: 1.0e-3}}
"""
    case = scenes.parsed(text, tail=scenes.tail(2.0, 26))
    found = follow(scenes.mechanism(case), case.times)
    assert found.modes[-1] == mode
    v = vx - 0.4 * G * 2.0 if vx > 10.0 else vx * 2 / 3
    assert 3 * math.sqrt(2 * 1.0 / G) < 1.4  # the last bounce
    np.testing.assert_allclose(found.y[-1, 3], v, rtol=1e-11)
    np.testing.assert_allclose(found.y[-1, [1, 4]], [0.25, 0.0], atol=1e-12)


def test_a_system_that_knows_no_rest_ends_with_a_message() -> None:
    """Without `at_last` the events have no limit to go on from."""

    class Endless(BouncingDisk):
        def guards(self, mode: str) -> Sequence[Guard]:
            return [replace(guard, at_last=None) for guard in super().guards(mode)]

    with pytest.raises(ZenoError, match=r"'bounces' happens without end .*Zeno") as caught:
        follow(Endless(m=1.0, R=0.2, e=0.5, y0=0.7), np.linspace(0.0, 2 * limit(0.5), 11))
    assert caught.value.event == "bounces"
    assert limit(0.5) * (1 - 1e-4) < caught.value.time < limit(0.5)


@pytest.mark.slow
def test_more_events_than_anyone_wants_end_with_a_message(monkeypatch: Patch) -> None:
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
def test_modes_that_end_where_they_begin_end_with_a_message(limit: bool) -> None:
    """Soon: a motion that rests nowhere would else go on for thousands of events."""
    with pytest.raises(ZenoError, match="'turns o") as caught:
        follow(Chatter(limit=limit), np.array([0.0, 1.0]))
    assert caught.value.time == 0.0


@pytest.mark.mutant("an accumulation by the quickest of its distances")
def test_the_slowest_of_the_last_distances_tells(monkeypatch: Patch) -> None:
    """Halved once and hardly shorter from then on: at 0.49 of 0.5 they come to 25, not to 2.5."""
    halved = np.cumsum(0.5 ** np.arange(1, 7)).tolist()
    assert accumulation(halved) == pytest.approx(1.0)
    assert accumulation(halved[:-1]) is None
    assert accumulation(list(range(6))) is None
    instants = np.cumsum([0.0, 1.0, 0.5, 0.49, 0.48, 0.47]).tolist()
    known = instants[-1] + 0.47 * 0.98 / 0.02  # of 0.49/0.5
    found = accumulation(instants)
    assert found == pytest.approx(known)
    assert found is not None
    assert not ends_here(found, instants[-1], 0.0, 10.0)
    monkeypatch.setattr(module, "np", SimpleNamespace(diff=np.diff, max=np.min))
    assert accumulation(instants) != pytest.approx(known)


def test_distances_that_stay_pile_up_nowhere() -> None:
    assert settles("bounces", [0.0, 1.0, 1.5, 1.99], 10.0) is None
    assert settles("bounces", [0.0, 1.0, 1.0 + 1e-13], 10.0) == pytest.approx(1e-26, rel=1e-2)


@pytest.mark.mutant("the limit of a pile is found by a wrong sum")
@pytest.mark.parametrize("ratio", [0.1, 0.9])
def test_what_is_left_of_a_pile_is_the_geometric_sum(ratio: float) -> None:
    """d r + d r² + … = d r / (1 − r) after the last of instants whose distances are d rᵏ."""
    instants = np.cumsum([0.0, *(0.3 * ratio ** np.arange(6))])
    assert instants[-1] + module.to_limit(instants) == pytest.approx(0.3 / (1.0 - ratio), rel=1e-12)


STRUCK = """\
scene:
  bodies: {{p: {{particle: {{mass: 1.0}}}}, B: {{disk: {{mass: 1.0, radius: 0.2}}}}}}
  contacts:
    f: {{between: [p, ground.floor], friction: 0, restitution: 1}}
    k: {{between: [p, B], friction: 0, restitution: 1}}
initial:
  p: {{x: 0, y: 0.3, vx: 0, vy: 0}}
  B: {{x: 0, y: {height!r}, vx: 0, vy: -3, angle: 0, omega: 0}}
events: {{lands: {{f.gap: falls to zero}}, hits: {{k.gap: falls to zero}}}}
duration: {duration}
samples: 61
allow: {{p.y: 1.0e-6, B.y: 1.0e-6, lands.time: 1.0e-6}}
"""


def struck(height: float, times: Array) -> Array:
    """(N, 2) [m] of a particle and an equal disk that falls on it, by flights and blows alone."""
    t = 0.0
    y, v = np.array([0.3, height]), np.array([0.0, -3.0])
    found = []
    for sample in times.tolist():
        while True:
            lands = (v[0] + math.sqrt(v[0] ** 2 + 2 * G * y[0])) / G
            gap, closing = y[1] - y[0] - 0.2, v[0] - v[1]
            hits = gap / closing if closing > 0 else math.inf
            first = min(lands, hits)
            ahead = min(first, sample - t)
            y, v, t = y + v * ahead - G * ahead * ahead / 2, v - G * ahead, t + ahead
            if first > ahead:
                break
            v = v[::-1].copy() if hits <= lands else v * [-1.0, 1.0]
            y[0] = y[0] if hits <= lands else 0.0
        found.append(y.copy())
    return np.array(found)


@pytest.mark.slow
@pytest.mark.parametrize(("height", "duration"), [(5.12743, 1.2), (5.1389, 9.6)])
def test_two_blows_soon_after_each_other_end_no_motion(height: float, duration: float) -> None:
    """A tenth of a millisecond after a bounce it is thrown back at the floor, and flies on."""
    case = scenes.parsed(STRUCK.format(height=height, duration=duration), tail="")
    moved = solve(case).trajectory.states
    y = np.stack([moved["p"][:, 1], moved["B"][:, 1]], axis=1)
    assert y == pytest.approx(struck(height, case.times), abs=1e-7)


@pytest.mark.mutant("two blows soon after each other taken for the end of all bounces")
@pytest.mark.slow
def test_the_end_of_bounces_that_fly_on_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(event, "converged", lambda *_: True)
    with pytest.raises(AssertionError):
        test_two_blows_soon_after_each_other_end_no_motion(5.12743, 1.2)


@pytest.mark.slow
@pytest.mark.mutant("what turns round between bounces without end ends the motion")
def test_what_rubs_between_bounces_rests_after_the_last(monkeypatch: Patch) -> None:
    """Falls of a = g − 1, rises of g + 1: a bounce has e √((g − 1)/(g + 1)) of the speed before.

    It takes v/(g + 1) up and, from v²/2(g + 1), √(…) down; all of them together are geometric.
    """
    text = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {disk: {mass: 1.0, radius: 0.1}}}
  joints: {r: {slide: [ground.O, b.center], along: [0, 1], dry_friction: {kinetic: 1.0}}}
  contacts: {f: {between: [b, ground.floor], friction: 0, restitution: 0.5}}
initial: {r: {shift: 0.5}}
events: {l: {f.gap: falls to zero}}
allow: {b.y: 1.0e-2}
"""
    case = scenes.parsed(text, tail=scenes.tail(1.2, 41))
    motion = solve(case)
    assert motion.holds
    v, share = math.sqrt(2 * (G - 1) * 0.4), 0.5 * math.sqrt((G - 1) / (G + 1))
    up = 0.5 * v / (G + 1)
    known = v / (G - 1) + up * (1 + math.sqrt((G + 1) / (G - 1))) / (1 - share)
    (pile,) = motion.trajectory.endless
    assert 0.0 < known - pile[-1] < pile[-1] - pile[-2]  # all that would follow is less
    last = motion.trajectory.states["b"][-1]
    assert last[1] == pytest.approx(0.1, abs=1e-12)
    assert not last[3:].any()
    monkeypatch.setattr(event._Walk, "_is_passed", lambda *_: False)
    with pytest.raises(CaseError, match="'r stops' happens thousands of times or without end"):
        solve(case)
