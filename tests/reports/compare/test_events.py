"""Events read of records: those of steps, whose events are known in advance."""

from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.command import textmech
from scipy.interpolate import KroghInterpolator
from scipy.optimize import brentq

from textmech.cases.case import Event
from textmech.cases.scene import Body, Scene
from textmech.cases.trajectory import VX, Array, Trajectory
from textmech.reports.compare.events import rests as reading
from textmech.reports.compare.events import times as event_times
from textmech.reports.compare.events.rests import rests
from textmech.reports.compare.events.times import (
    Known,
    certain_events,
    engine_events,
    falls,
    jumped,
    reference_events,
)

# Event times of synthetic records whose events are known in advance.

SCENE = Scene(
    (0.0, 0.0), {}, {"box": Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})}, {}, {}, {}
)
H = 1e-3
W = np.sqrt(2.0)


def braking(t: Array, stop: float = 0.61803) -> Array:
    return np.clip(stop - t, 0.0, None)


def slipping(t: Array) -> Array:
    """The speed of Example 2.4 by its closed form: two slips, from 1.5 and 6.290544 s on."""
    v = np.zeros_like(t)
    for begins in (1.5, 6.290543662039866):
        s = t - begins
        slides = (s > 0) & (s < LASTS)
        v[slides] = (2 * (1 - np.cos(W * s)) + 3 / W * np.sin(W * s))[slides]
    return v


LASTS = float(brentq(lambda s: 2 * (1 - np.cos(W * s)) + 3 / W * np.sin(W * s), 2.5, 4.0))


def grid(duration: float, h: float = H) -> Array:
    return np.arange(round(duration / h) + 1, dtype=np.float64) * h


@pytest.mark.parametrize("h", [1e-4, 1e-3, 8e-3])
def test_a_stop_is_where_the_motion_would_be_zero(h: float) -> None:
    t = grid(1.0, h)
    ((stop, start),) = rests(t, braking(t))
    assert stop == pytest.approx(0.61803, abs=1e-12)
    assert start is None


def test_creep_is_no_motion_and_moves_no_time() -> None:
    t = grid(1.0)
    ((stop, _),) = rests(t, np.maximum(braking(t), 1e-3))
    assert stop == pytest.approx(0.61803, abs=1e-12)


@pytest.mark.parametrize("noise", [1e-9, 1e-6, 1e-4])
def test_noise_makes_no_events_and_costs_its_own_size(noise: float) -> None:
    t = grid(1.0)
    u = braking(t) + noise * np.random.default_rng(3).standard_normal(len(t))
    ((stop, _),) = rests(t, u)
    assert stop == pytest.approx(0.61803, abs=30 * noise + 1e-12)


SLIPS = [1.5, 1.5 + LASTS, 6.290543662039866, 6.290543662039866 + LASTS]


def slips(h: float, bent: Callable[[Array], Array] = lambda u: u) -> list[float | None]:
    """The four events as they are read."""
    t = grid(10.0, h)
    (none, first), (stuck, second), (end, never) = rests(t, bent(slipping(t)))
    assert (none, never) == (None, None)
    return [first, stuck, second, end]


@pytest.mark.parametrize(("h", "near"), [(1e-4, 1e-11), (1e-3, 1e-11), (5e-3, 1e-9)])
def test_two_stick_slip_cycles(h: float, near: float) -> None:
    assert slips(h) == pytest.approx(SLIPS, abs=near)


def test_both_curves_are_those_of_scipy() -> None:
    """By divided differences, whose sums have no term of Neville's."""
    random = np.random.default_rng(5)
    for _ in range(100):
        h = 10.0 ** random.uniform(-5, -2)
        t = random.uniform(0, 10) - h * np.arange(reading.THROUGH)
        u = np.cumsum(random.uniform(0.8, 1.2, len(t))) * random.choice([-1.0, 1.0])
        found = reading._at_zero(t, u)
        for rows, zero in zip((reading.FEWER, reading.THROUGH), found, strict=True):
            assert zero == pytest.approx(KroghInterpolator(u[:rows], t[:rows])(0.0), abs=1e-12)


@pytest.mark.mutant("a rest without the steps beside it")
def test_without_the_steps_beside_a_rest_it_is_known_to_a_microsecond(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    monkeypatch.setattr(reading, "continued", lambda times, u, zero, away: zero)
    found = np.array(slips(1e-3)) - SLIPS
    assert 1e-7 < np.abs(found).max() < 2e-5


@pytest.mark.parametrize("rows", [1, 2])
def test_steps_that_are_bent_beside_a_rest_are_left_out(rows: int) -> None:
    """As an engine's law that brakes with what would stop it in the step."""

    def bent(u: Array) -> Array:
        u, moves = u.copy(), np.flatnonzero(u)
        ends = [*moves[np.flatnonzero(np.diff(moves) > 1)], moves[-1]]
        for end in ends:
            u[end - rows + 1 : end + 1] *= 0.7
        return u

    assert slips(1e-3, bent) == pytest.approx(SLIPS, abs=1e-10)


@pytest.mark.mutant("a line for the curve to where a slip begins")
def test_a_line_in_place_of_the_curve_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    t = grid(10.0, 1e-4)
    curved = rests(t, slipping(t))[0][1]
    monkeypatch.setattr(reading, "DEGREE", 1)
    line = rests(t, slipping(t))[0][1]
    assert curved is not None
    assert line is not None
    assert abs(curved - 1.5) < 2e-6
    assert abs(line - 1.5) > 5e-4


def test_a_corner_of_one_step_is_known_to_that_step() -> None:
    t = grid(1.0)
    ((stop, _),) = rests(t, np.where(t < 0.5, 1.0, 0.0))
    assert stop == pytest.approx(0.5, abs=H)


def test_steps_that_grip_now_and_then_stop_nearly_there() -> None:
    """A shipped contact that hops: friction acts on every third step only, three times as much."""
    t = grid(1.0)
    ((stop, start),) = rests(t, braking(np.floor(t / (3 * H)) * 3 * H))
    assert stop == pytest.approx(0.61803, abs=3 * H)
    assert start is None


def test_what_only_passes_through_zero_does_not_rest() -> None:
    t = grid(2.0)
    assert rests(t, 1.0 - t) == []
    assert rests(t, np.where(t < 1, 1 - t, 0.1 * (1 - t))) == []
    assert rests(t, np.cos(4 * t)) == []


def test_no_event_at_all() -> None:
    t = grid(1.0)
    assert rests(t, np.zeros_like(t)) == []
    assert rests(t, 1 + t) == []
    assert rests(t, t) == []  # it starts at rest and moves at once
    assert len(falls(t, 1 + t)) == 0


def test_a_stop_in_the_first_step_and_in_the_last() -> None:
    t = grid(0.1)
    ((stop, _),) = rests(t, braking(t, 0.4 * H))
    assert stop == pytest.approx(0.4 * H, abs=H)
    ((stop, _),) = rests(t, braking(t, 0.1 - 0.3 * H))
    assert stop == pytest.approx(0.1 - 0.3 * H, abs=1e-9)
    assert rests(t, braking(t, 0.1 + 0.3 * H)) == []


def test_a_start_in_the_last_step() -> None:
    t = grid(0.1)
    ((stop, start),) = rests(t, np.clip(t - (0.1 - 0.4 * H), 0, None))
    assert stop is None
    assert start == pytest.approx(0.1, abs=H)


def bouncing(t: Array, *, drop: float = 1.0, g: float = 9.80665) -> tuple[Array, Array]:
    """Height above the floor after a drop, elastic, and the impacts."""
    half = np.sqrt(2 * drop / g)
    s = (t + half) % (2 * half) - half
    return drop - g * s**2 / 2, np.arange(half, t[-1], 2 * half)


@pytest.mark.parametrize("h", [1e-4, 1e-3, 8e-3])
def test_falls_that_no_step_sees_at_zero(h: float) -> None:
    t = grid(3.0, h)
    height, impacts = bouncing(t)
    assert np.min(height) >= 0
    found = falls(t, height)
    assert len(found) == len(impacts)
    assert found == pytest.approx(impacts, abs=10 * h * h)


NEAR, WIDE = 5e-8, 2e-3
"""m: so far above zero it turns, between two steps of either size; s: the larger of them."""


@pytest.mark.mutant("what turns just above zero by itself has fallen to it")
@pytest.mark.parametrize("h", [1e-4, WIDE])
@pytest.mark.parametrize("within", [0.0, 0.3, 0.5, 0.9])
def test_what_turns_just_above_zero_has_not_fallen(
    h: float, within: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A swing of 0.1 m and 10 rad/s: the steps beside its turn are above zero by some ẍh²."""
    t = grid(0.7, h)
    turn = 0.31415 + h * within
    height = 0.1 - 0.1 * np.cos(10 * (t - turn)) + NEAR
    assert len(falls(t, height)) == 0
    through = falls(t, height - 2 * NEAR)
    assert through == pytest.approx([turn - np.arccos(1 - NEAR / 0.1) / 10], abs=5e-5)
    monkeypatch.setattr(event_times, "_of_curve", lambda times, u, i: times[i])
    if h == WIDE and within == 0.3:
        assert len(falls(t, height)) == 1


ROOF, UP = 0.3, 5.0  # s: when a ball that is thrown up strikes; m/s: how it is thrown
ENDS = 0.5  # s


def moving(t: Array, velocity: Array, **known: Any) -> Trajectory:
    states = np.zeros((len(t), 6))
    states[:, VX] = velocity
    return Trajectory(t, {"box": states}, {}, **known)


def rises(t: Array) -> Array:
    return UP - 10.0 * t


def falls_back(t: Array, roof: float) -> Array:
    """It is thrown back with 0.8 of what it strikes the roof with."""
    return -0.8 * rises(np.array(roof)) - 10.0 * (t - roof)


@pytest.mark.mutant("a velocity that jumps across a value in an engine has fallen to it")
@pytest.mark.parametrize("steps", [1, 12])
@pytest.mark.parametrize("late", [0.0, 4e-3])
def test_what_jumps_across_a_value_is_no_event_of_an_engine(steps: int, late: float) -> None:
    """Nor where its blow is late, or takes some steps; an event that it has not stays missed."""
    event = Event("box.vx", "falls to zero", 1.0)
    up, down = np.linspace(0.0, ROOF, 40), np.linspace(ROOF, ENDS, 40)
    reference = moving(
        np.append(up, down), np.append(rises(up), falls_back(down, ROOF)),
        phase=np.repeat([0, 1], 40), ended=("ball lands",),
    )  # fmt: skip
    happened = reference_events(SCENE, reference, event)
    assert len(happened) == 0
    jumps = jumped(SCENE, reference, event)
    assert jumps == pytest.approx([ROOF])
    t, roof = grid(ENDS), ROOF + late
    velocity = np.where(t > roof, falls_back(t, roof), rises(t))
    blow = np.pad(velocity, steps, mode="edge")
    engine = moving(t, np.convolve(blow, np.ones(steps) / steps, "same")[steps:-steps])
    assert len(engine_events(SCENE, engine, event)) == 1
    for other in ((), (0.45,)):
        known = Known(0.0, other, tuple(jumps))
        assert len(engine_events(SCENE, engine, event, known)) == 0


def test_where_both_happen_the_jump_is_left_out() -> None:
    found = event_times._without_jumps(np.array([0.31, 1.27]), Known(0.0, (1.27,), (0.3,)))
    assert found.tolist() == [1.27]
    more = np.array([0.1, 0.31, 1.27])  # one that the reference does not have is none of its jumps
    found = event_times._without_jumps(more, Known(0.0, (1.27,), (0.3,)))
    assert found.tolist() == [0.1, 1.27]


def test_what_rests_on_the_floor_falls_once() -> None:
    t = grid(1.0)
    height = np.clip(1 - 2 * t, 0, None) + 1e-6 * np.random.default_rng(1).standard_normal(len(t))
    assert falls(t, height) == pytest.approx([0.5], abs=H)


def taut(small: float) -> tuple[Array, Array]:
    """How slack a rope is that an impact pulls taut at 0.05 s: then rounding, of either sign."""
    t = grid(0.1, 4e-3)
    u = np.maximum(0.05 - t, 0.0)
    u[t > 0.05] = small
    u[t > 0.06] *= np.where(np.arange(np.sum(t > 0.06)) % 3 == 2, -1.0, 1.0)
    return t, u


@pytest.mark.parametrize("small", [0.0, 1e-17, 1e-12, -1e-17])
def test_what_an_impact_leaves_of_a_gap_is_zero(small: float) -> None:
    assert falls(*taut(small), small=5e-11) == pytest.approx([0.05], abs=1e-12)


@pytest.mark.mutant("a gap of 1e-17 m is open")
def test_a_gap_that_is_compared_with_zero_itself_would_be_seen() -> None:
    assert falls(*taut(1e-17)) != pytest.approx([0.05], abs=4e-3)


@pytest.mark.mutant("what decays below 1e-9 of what it was has fallen to zero")
@pytest.mark.parametrize("share", [0.02, 0.3])
def test_what_decays_never_falls_to_zero(share: float, monkeypatch: pytest.MonkeyPatch) -> None:
    """As a ball that creeps back out of a soft floor: 1e-9 is what anything comes to."""
    t = grid(2.0)
    u = np.power(1 - share, np.arange(len(t), dtype=np.float64))
    assert len(falls(t, u, small=1e-9)) == 0
    monkeypatch.setattr(event_times, "_of_curve", lambda times, u, i: times[i])
    assert len(falls(t, u, small=1e-9)) == 1


def phased(*pieces: tuple[float, float, Callable[[Array], Array]]) -> Trajectory:
    """A reference's record: rows and phase numbers of pieces (from, to, speed)."""
    times = [np.linspace(a, b, 7) for a, b, _ in pieces]
    states = np.zeros((7 * len(pieces), 6))
    states[:, VX] = np.concatenate([u(t) for t, (_, _, u) in zip(times, pieces, strict=True)])
    phase = np.repeat(np.arange(len(pieces)), 7)
    return Trajectory(np.concatenate(times), {"box": states}, {}, phase=phase)


@pytest.mark.parametrize(
    ("rule", "times"),
    [("stays zero", [1.0, 4.0]), ("leaves zero", [2.0]), ("falls to zero", [1.0])],
)
def test_the_reference_is_read_at_its_phases(rule: Any, times: list[float]) -> None:
    record = phased(
        (0.0, 1.0, lambda t: 1 - t),
        (1.0, 2.0, lambda t: 1e-13 * np.sin(t)),
        (2.0, 3.0, lambda t: 2 - t),
        (3.0, 3.5, lambda t: t - 4),  # another phase that moves: no event
        (3.5, 4.0, lambda t: t - 4),
        (4.0, 4.0, lambda t: np.full_like(t, 0.5)),  # it lasts no time
        (4.0, 5.0, np.zeros_like),
    )
    assert reference_events(SCENE, record, Event("box.vx", rule)) == pytest.approx(times)


def test_an_engine_is_read_by_the_same_names() -> None:
    t = grid(10.0)
    states = np.zeros((len(t), 6))
    states[:, VX] = slipping(t)
    record = Trajectory(t, {"box": states}, {})
    stops = engine_events(SCENE, record, Event("box.vx", "stays zero"))
    slips = engine_events(SCENE, record, Event("box.vx", "leaves zero"))
    assert stops == pytest.approx([4.790544, 9.581087], abs=2e-5)
    assert slips == pytest.approx([1.5, 6.290544], abs=2e-5)
    with pytest.raises(KeyError):
        engine_events(SCENE, record, Event("box.nothing", "stays zero"))


# A rest that noise interrupts: what only trembles at its threshold is one rest.

STOP = 0.61803  # s, from as many m/s


@pytest.mark.mutant("noise at the threshold of rest counts twice")
def test_what_only_trembles_at_the_threshold_rests_once(monkeypatch: pytest.MonkeyPatch) -> None:
    """It stops, is stirred by 3 % of its largest speed, and rests again: that is one rest."""
    t = np.linspace(0.0, 2.0, 2001)
    stirred = np.where((t > 0.8) & (t < 0.85), 0.03 * STOP, 0.0)
    u = np.clip(STOP - t, 0.0, None) + stirred
    ((stop, start),) = rests(t, u)
    assert (stop, start) == (pytest.approx(STOP, abs=1e-12), None)
    monkeypatch.setattr(reading, "HIGH", reading.LOW)
    assert len(rests(t, u)) == 2


# A ball that comes to rest bounces ever lower: what of that an engine has to tell.

SETTLES = """\
title: A ball that comes to rest
scene:
  bodies: {ball: {disk: {mass: 1, radius: 0.1}}}
  contacts: {touch: {between: [ball, ground.floor], friction: 0, restitution: 0.35}}
initial: {ball: {x: 0, y: 0.3, angle: 0, vx: 0, vy: 0, omega: 0}}
duration: 0.7
samples: 8
step: 1.0e-3
events: {bounces: {touch.gap: falls to zero}}
allow: {ball.y: 1.0e-2, bounces.time: 1.0e-2}
"""


def settling(t: Array, *, e: float = 0.4, g: float = 9.80665) -> tuple[Array, Array]:
    """Height of a ball dropped from 1 m that keeps e of its speed, and its impacts until 1e-9 m."""
    height, impacts = 1 - g * t**2 / 2, [float(np.sqrt(2 / g))]
    speed = e * g * impacts[0]
    while speed**2 / (2 * g) > 1e-9:
        s = t - impacts[-1]
        height = np.where(s > 0, speed * s - g * s**2 / 2, height)
        impacts.append(impacts[-1] + 2 * speed / g)
        speed *= e
    return np.where(t > impacts[-1], 0.0, height), np.array(impacts)


@pytest.mark.parametrize("h", [1e-4, 1e-3])
def test_a_ball_that_settles_is_seen_to_bounce_as_long_as_steps_can_tell(h: float) -> None:
    t = np.arange(round(1.5 / h) + 1, dtype=np.float64) * h
    height, impacts = settling(t - h / 3)  # no step meets an impact
    impacts += h / 3
    found = falls(t, height)
    assert found == pytest.approx(impacts[: len(found)], abs=h)
    high = np.cumprod([1.0, *[0.16] * (len(impacts) - 1)]) > 1e-4  # of the first height
    long = np.diff(impacts, prepend=0.0) > 12 * h
    assert np.sum(high & long) <= len(found) < len(impacts)


@pytest.mark.slow
def test_an_engine_that_bounces_as_often_as_its_steps_can_tell_is_not_blamed(
    tmp_path: Path,
) -> None:
    """Nor are the counts called equal: of 14 bounces steps of 1 ms tell four for sure."""
    (tmp_path / "settles.yaml").write_text(SETTLES)
    done = textmech("run", tmp_path / "settles.yaml", "--engine", "pymunk.tuned")
    assert done.returncode == 0, done.stdout
    told = (
        "bounces.count not supported: adapter: reference 14 (of which 4 last long enough for this"
    )
    assert " ".join(done.stdout.split()).count(told) == 1


def hump(t: Array) -> Array:
    return (t - t[0]) * (t[-1] - t) / (t[-1] - t[0]) ** 2


def test_events_that_are_too_near_for_a_step_may_be_missed() -> None:
    edges = [0.0, 1.0, 1.4, 1.41]  # humps of 1 s, 0.4 s and 10 ms, of heights alike
    times = [np.linspace(a, b, 7) for a, b in pairwise([*edges, 2.0])]
    states = np.zeros((7 * len(times), 6))
    for k, t in enumerate(times[:-1]):  # in the last it rests
        states[7 * k : 7 * k + 7, VX] = hump(t)
    phase = np.repeat(np.arange(len(times)), 7)
    record = Trajectory(np.concatenate(times), {"box": states}, {}, phase=phase)
    event = Event("box.vx", "falls to zero")
    happened = reference_events(SCENE, record, event)
    assert len(happened) == 3
    steps = (1e-4, 1e-3, 5e-3, 0.2)
    told = {
        h: len(certain_events(SCENE, record, event, Known(0.0, (*happened,)), h)) for h in steps
    }
    assert told == {1e-4: 3, 1e-3: 3, 5e-3: 2, 0.2: 1}
