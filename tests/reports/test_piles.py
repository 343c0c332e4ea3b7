"""Events that pile up, or are smaller than what counts as zero: their counts and their times."""

import math
from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed
from scipy.optimize import brentq

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference.certificate import errors
from textmech.reference.mechanism.modes import mechanism, mode_selection
from textmech.reference.motion.follow import _Walk
from textmech.reference.solve import Solution, solve
from textmech.reports.compare.events import times as reading
from textmech.reports.compare.events.states import mistaken
from textmech.reports.compare.events.times import reference_events

G = 9.80665
DROP = """\
scene:
  bodies: {{b: {{particle: {{mass: 1.0}}}}}}
  contacts: {{c: {{between: [b, ground.floor], friction: 0, restitution: {e}}}}}
initial: {{b: {{x: {x}, y: 1, vx: {vx}, vy: 0}}}}
events:
  lands: {{c.gap: falls to zero}}
  stays: {{c.gap: stays zero}}
  tops: {{b.vy: falls to zero}}
duration: {duration!r}
samples: 11
allow: {{b.y: 1.0e-2, {asked}}}
"""


def fall() -> float:
    return math.sqrt(2 / G)


def dropped(
    folder: Path, duration: float, asked: str, *, e: float = 0.5, x: float = 0.0, vx: float = 0.0
) -> Case:
    """A particle that falls 1 m at x [m], and bounces until (1 + e)/(1 - e) √(2/g)."""
    text = DROP.format(e=e, x=x, vx=vx, duration=duration, asked=asked)
    return typed(folder, text, tail="")


def counted(case: Case, found: Solution, name: str) -> int:
    assert found.trajectory.record is not None
    return len(reference_events(case.scene, found.trajectory.record, case.events[name]))


@pytest.mark.slow
@pytest.mark.mutant("a hop that is told by its size alone")
def test_hops_are_counted_however_low(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """After n bounces it has flown (1 + 2 e (1 - eⁿ)/(1 - e)) √(2/g); the last are 1e-10 m high."""
    e, n = 0.5, 16
    ends = [(1 + 2 * e * (1 - e**k) / (1 - e)) * fall() for k in (n, n + 1)]
    within = 0.7 * ends[0] + 0.3 * ends[1]  # at its middle the hop's top would be the last instant
    case = dropped(tmp_path, within, "lands.count: 0.5", e=e, x=1e3)
    found = solve(case)
    assert found.holds
    assert mistaken(case, found.trajectory) == []
    assert counted(case, found, "lands") == n + 1
    monkeypatch.setattr(reading, "_names", lambda *_: set())
    assert counted(case, found, "lands") < n


@pytest.mark.slow
@pytest.mark.mutant("what a pile leaves out is none of a stop's error")
def test_a_pile_ends_no_better_known_than_what_it_leaves_out(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    end = 3 * fall()
    for x in (0.0, 1e4):
        case = dropped(tmp_path, 3.0, "stays.time: 1.0e-3", x=x)
        found = solve(case)
        assert found.holds
        assert found.trajectory.record is not None
        record = found.trajectory.record
        (time,) = reference_events(case.scene, record, case.events["stays"])
        (stated,) = (each for each in found.checks if each.name == "error of stays.time")
        assert stated.certified is not None
        assert 0.0 < end - time < stated.certified < 1e-5
    finer = dropped(tmp_path, 3.0, "stays.time: 1.0e-5")
    with pytest.raises(CaseError, match="asks more than can be certified"):
        solve(finer)
    monkeypatch.setattr(errors, "_piled", lambda endless: 0.0)
    assert solve(finer).holds


@pytest.mark.slow
@pytest.mark.parametrize("vx", [0.0, 5e3])
def test_apexes_are_not_counted_however_fast_it_flies(tmp_path: Path, vx: float) -> None:
    case = dropped(tmp_path, 3.0, "tops.count: 0.5, stays.count: 0.5", e=0.7, vx=vx)
    found = mistaken(case, solve(case).trajectory)
    assert [mistake.where for mistake in found] == ["allow.tops.count"]


# What ends in a pile, and is none.

ROLLS = """\
scene:
  bodies: {w: {disk: {mass: 1.0, radius: 0.1}}}
  contacts: {c: {between: [w, ground.floor], friction: 0.2, restitution: 0.5}}
initial: {w: {x: 0, y: 1.1, vx: 6, vy: 0, omega: 0}}
events: {lands: {c.gap: falls to zero}, rolls: {c.slip: stays zero}}
duration: 2.0
samples: 11
allow: {w.x: 1.0e-2, rolls.count: 0.5}
"""
BESIDE = """\
scene:
  bodies: {b: {particle: {mass: 1.0}}, k: {particle: {mass: 1.0}}}
  contacts:
    c: {between: [b, ground.floor], friction: 0, restitution: 0.5}
    d: {between: [k, ground.floor], friction: 0}
  forces: {up: {push: k.center, pulse: {amplitude: [0, 40], from: 0.6, until: 0.7}}}
initial: {b: {x: 0, y: 1, vx: 0, vy: 0}, k: {x: 3, y: 0.5, vx: 0, vy: 0}}
events: {bounces: {c.gap: falls to zero}, lands: {d.gap: falls to zero}}
duration: 2.0
samples: 11
allow: {b.y: 1.0e-2, lands.count: 0.5}
"""


@pytest.mark.slow
@pytest.mark.parametrize(("text", "name", "times"), [(ROLLS, "rolls", 1), (BESIDE, "lands", 2)])
def test_what_ends_during_a_pile_is_counted(
    tmp_path: Path, text: str, name: str, times: int
) -> None:
    case = typed(tmp_path, text, tail="")
    found = solve(case)
    assert mistaken(case, found.trajectory) == []
    assert counted(case, found, name) == times


DISKS = """\
scene:
  gravity: none
  bodies:
    a: {disk: {mass: 1.0, radius: 0.1}}
    b: {disk: {mass: 1.0, radius: 0.1}}
    c: {disk: {mass: 1.0, radius: 0.1}}
  contacts:
    p: {between: [a, b], friction: 0, restitution: E}
    q: {between: [b, c], friction: 0, restitution: E}
initial: {a: {x: -1.0, y: 0, vx: 1.0}, b: {x: 0, y: 0, vx: 0}, c: {x: 1.1, y: 0, vx: -1.0}}
events: {pp: {p.gap: falls to zero}, qq: {q.gap: falls to zero}}
duration: 6.0
samples: 11
allow: {pp.count: 0.5, qq.count: 0.5, a.x: 1.0e-2}
"""


def meetings(e: float) -> list[int]:
    """How often each of the two gaps closes, by what the velocities do alone."""
    x, v, found = np.array([-1.0, 0.0, 1.1]), np.array([1.0, 0.0, -1.0]), [0, 0]
    while True:
        gaps, rates = np.maximum(np.diff(x) - 0.2, 0.0), np.diff(v)
        within = [(g / -r, i) for i, (g, r) in enumerate(zip(gaps, rates, strict=True)) if r < 0]
        if not within:
            return found
        t, i = min(within)
        x, found[i] = x + v * t, found[i] + 1
        v[i : i + 2] += np.array([1.0, -1.0]) * (1 + e) * rates[i] / 2


@pytest.mark.slow
@pytest.mark.mutant("a blow within rounding is counted")
def test_blows_within_rounding_are_not_counted(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Three disks in a row meet ever more softly, above e = 7 - 4√3 for a time: here 32 times each,
    of which the last change the velocities by 1e-36."""
    for e, known in ((0.1, True), (0.08, True), (0.072, False)):
        case = typed(tmp_path, DISKS.replace("E}", f"{e}}}"), tail="")
        found = solve(case)
        wrong = mistaken(case, found.trajectory)
        assert [m.where for m in wrong] == ([] if known else ["allow.pp.count", "allow.qq.count"])
        if known:
            assert [counted(case, found, name) for name in ("pp", "qq")] == meetings(e)
        else:
            assert "happens so softly at 0.878" in wrong[0].what
    monkeypatch.setattr(reading, "SOFT", 0.0)
    assert mistaken(case, found.trajectory) == []


# A particle on a platform that is shaken by hardly more than its weight: it hops off for 9 ms.

SHAKEN = """\
scene:
  points: {O: [0, 0]}
  bodies: {B: {block: {mass: 1.0, width: 1.0, height: 0.2}}, b: {particle: {mass: 0.5}}}
  joints: {s: {slide: [ground.O, B.center], along: [0, 1]}}
  drive: {s.speed: {sine: {amplitude: SPEED, angular_frequency: 20.0}}}
  contacts: {c: {between: [b, B.top], friction: MU}}
initial: {B: {x: 0, y: 0}, b: {x: 0.1, y: 0.1}}
events: {off: {c.normal: falls to zero}, on: {c.gap: falls to zero}}
duration: LAST
samples: 11
allow: {on.time: 1.0e-3, b.y: 1.0e-2}
"""


def shaken(folder: Path, parts: float, friction: float, duration: float) -> Case:
    """parts: of g, the largest acceleration of the platform."""
    text = SHAKEN.replace("SPEED", repr(parts * G / 20.0)).replace("MU", repr(friction))
    return typed(folder, text.replace("LAST", repr(duration)), tail="")


def hop(parts: float) -> tuple[float, float]:
    """When it leaves, where the platform falls as fast as it does, and when it is met again."""
    w, a = 20.0, parts * G
    off = (math.pi - math.acos(1 / parts)) / w

    def height(t: float) -> float:
        own = a / w**2 * (math.cos(w * t) - math.cos(w * off))
        return a / w * math.sin(w * off) * (t - off) - G * (t - off) ** 2 / 2 + own

    rise = off + 1e-2 * math.acos(1 / parts) / w
    return off, float(brentq(height, rise, off + 5 * math.acos(1 / parts) / w, xtol=1e-15))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("parts", "friction", "periods"),
    [
        (1.001, 0.3, 1),
        (1.005, 0.3, 2),
        (1.001, 0.0, 2),
        (1.002, 0.0, 2),
        (1.0001, 0.0, 1),
        (1.0005, 0.3, 2),
        (1.01, 0.3, 2),
    ],
)
def test_a_platform_that_hardly_lets_go(
    tmp_path: Path, parts: float, friction: float, periods: int
) -> None:
    case = shaken(tmp_path, parts, friction, (periods - 1) * math.tau / 20 + 0.25)
    found = solve(case)
    assert found.holds
    assert found.trajectory.record is not None
    for name, time in zip(("off", "on"), hop(parts), strict=True):
        times = reference_events(case.scene, found.trajectory.record, case.events[name])
        each = [time + k * math.tau / 20 for k in range(periods)]
        assert times == pytest.approx(each, abs=1e-8)  # rounding, where its height hardly falls


@pytest.mark.slow
@pytest.mark.mutant("a landing by rounding, just after it has let go, is one")
def test_rounding_lands_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By itself: that a gap of rounding is not looked at hides it in this scene."""
    case = shaken(tmp_path, 1.0001, 0.3, 0.6)
    assert solve(case).holds
    monkeypatch.setattr(mechanism, "ROUNDS", 0.0)
    assert solve(case).holds
    monkeypatch.setattr(_Walk, "_trembles", lambda *_: False)
    assert not solve(case).holds


@pytest.mark.slow
@pytest.mark.mutant("where nothing presses, two ways to slide are two motions")
def test_what_does_not_press_does_not_rub(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mechanism, "ROUNDS", 0.0)  # else nothing is pressed by rounding there
    monkeypatch.setattr(mode_selection, "_exert_alike", lambda *_: False)
    with pytest.raises(CaseError, match="held by the others already"):
        solve(shaken(tmp_path, 1.0001, 0.3, 0.6))
