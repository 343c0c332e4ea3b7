"""Following a motion: events are located, ordered and never missed; what is kept; where it ends."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.machines.closed_motions import time_to_flat
from given.machines.watched import Oscillator, Plain, Still, Watched, events
from given.otherwise import otherwise

from textmech.cases.case import Case
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.integrators.march import IntegrationError
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion import event_location, follow, stuck
from textmech.reference.motion.event_location import clear
from textmech.reference.motion.follow import Followed, Kept
from textmech.reference.solve import solve
from textmech.reference.system import TOGETHER, Array, Guard, Mode, Only
from textmech.reference.systems.contact.bouncing_disk import BouncingDisk
from textmech.reports.compare.events.times import reference_events

Patch = pytest.MonkeyPatch
followed = follow.follow
TIMES = np.linspace(0.0, 6.0, 31)


# Events of x = cos t.


@pytest.mark.mutant("an event at a threshold of 1e-6, not at zero")
def test_an_event_is_located() -> None:
    """Where |x| falls below 1e-6 instead of through zero, the event comes 1e-6 s early."""
    found = events(("down", lambda t, x, v: x), until=20.0)
    known = [("down", math.pi / 2 + 2 * math.pi * k) for k in range(3)]
    assert [name for name, _ in found] == [name for name, _ in known]
    assert [t for _, t in found] == pytest.approx([t for _, t in known], abs=1e-12, rel=0)
    [(_, time)] = events(("down", lambda t, x, v: x - 1e-6), until=5.0)
    assert abs(time - math.pi / 2) > 1e5 * TOGETHER


@pytest.mark.parametrize("depth", [0.5, 1e-3, 1e-6, 1e-9])
def test_dips_and_humps_within_a_step_are_seen(depth: float) -> None:
    """x + 1 − depth is negative for 2 acos(1 − depth) around t = π only, x − 1 + depth the reverse.

    x is flat there: rounding of 1e-16 in x moves the time by 1e-16/√(2 depth).
    """
    room, half = 1e-12 + 1e-15 / math.sqrt(depth), math.acos(1 - depth)
    dips = events(("dips", lambda t, x, v: x + 1.0 - depth), until=6.0, samples=2)
    assert [t for _, t in dips] == pytest.approx([math.acos(depth - 1)], abs=room, rel=0)
    ends = events(("ends", lambda t, x, v: x - 1.0 + depth), until=9.0, samples=2)
    assert [t for _, t in ends] == pytest.approx([half, 2 * math.pi + half], abs=room, rel=0)


def test_what_is_no_fall_is_no_event() -> None:
    assert events(("near", lambda t, x, v: x + 1.0 + 1e-9), until=6.0, samples=2) == []
    assert events(("up", lambda t, x, v: -x), until=math.pi) == []
    assert events(("now", lambda t, x, v: v), until=1.0, after="off") == [("now", 0.0)]


def test_the_first_of_simultaneous_guards_or_the_earlier_one_wins() -> None:
    first, second = ("first", lambda t, x, v: x), ("second", lambda t, x, v: 2 * x)
    for order in ([first, second], [second, first]):
        assert [name for name, _ in events(*order, until=3.0, after="off")] == [order[0][0]]
    early = ("early", lambda t, x, v: x - 1e-6)
    assert [name for name, _ in events(first, early, until=3.0, after="off")] == ["early"]


@pytest.mark.slow
def test_a_guard_of_time_alone_is_met_by_steps_that_are_not_too_long() -> None:
    """While nothing moves, a step may be as long as the motion: `longest` bounds it."""
    still = Watched([("beats", lambda t, x, v: math.cos(20 * t) + 0.9)], Still())
    still.longest = 0.05
    found = followed(still, np.array([0.0, 10.0])).events
    known = [(math.acos(-0.9) + 2 * math.pi * k) / 20 for k in range(32)]
    assert [e.time for e in found] == pytest.approx(known, abs=1e-12, rel=0)
    assert [e.k for e in found] == list(range(1, 33))


@pytest.mark.parametrize("sink", [0.0, 1e-15, -1e-15])
def test_a_touch_is_no_fall(sink: float) -> None:
    """x + 1 comes to zero at t = π: by rounding above it, on it, or below."""
    touch = ("touches", lambda t, x, v: x + 1.0 - sink)
    for times in ([0.0, 6.0], [0.0, math.pi, 6.0]):
        found = followed(Watched([touch], Oscillator()), np.array(times))
        assert found.events == ()
        # A quarter of 1e-8 from there is seen by no guard.
        assert {(e.name, round(e.time - math.pi, 3)) for e in found.touched} == {("touches", 0.0)}


def test_what_stays_clear_and_what_falls_is_no_touch() -> None:
    guards: list[Plain] = [
        lambda t, x, v: x + 1.0 + 1e-6,
        lambda t, x, v: x + 1.0 - 1e-6,
        lambda t, x, v: 1.0 - x,
    ]
    for g in guards:
        assert followed(Watched([("g", g)], Oscillator()), np.array([0.0, 3.0, 6.0])).touched == ()


# Zeros of a function in a step, which is looked at in five points.

POINTS = [0.0, 0.25, 0.5, 0.75, 1.0]
Number = Callable[[float], float]


def zero(g: Number, h: float = 1.0, module: Any = event_location, **how: bool) -> float | None:
    how, points = {"begins": False, "spent": False} | how, [h * at for at in POINTS]
    return module.crossing(g, points, [g(at) for at in points], **how)[0]


def dips(a: float, b: float) -> Number:
    return lambda t: (t - a) * (t - b)


@pytest.mark.mutant("a guard that dips below zero between the points of a step")
@pytest.mark.parametrize(("a", "b"), [(0.3, 0.45), (0.26, 0.49), (0.55, 0.7), (0.02, 0.2)])
def test_a_dip_between_the_points_is_found(a: float, b: float, monkeypatch: Patch) -> None:
    """At every point it is positive; or, after a rise, it begins below zero, which is no fall."""
    assert zero(dips(a, b)) == pytest.approx(a, abs=4e-15)
    if a > 0.5:
        assert zero(lambda t: (t - 0.1) * dips(a, b)(t), spent=True) == pytest.approx(a, abs=4e-15)
    monkeypatch.setattr(event_location, "_bracket", lambda *given: None)
    assert zero(dips(a, b)) is None


SHORT = 1e-4  # of a step: how long a dip lasts, whose depth is 25 times what counts as a touch


@pytest.mark.mutant("a dip's bottom is not looked for between a point and the next beyond")
@pytest.mark.parametrize("at", [0.25, 0.5, 0.75])
def test_a_dip_that_begins_at_a_point_is_no_touch(at: float) -> None:
    """It is as deep as a touch at the point, and above zero at all that are looked at beyond."""
    begun_just_before = dips(at - 1e-13, at + SHORT)
    assert zero(begun_just_before) == pytest.approx(at, abs=1e-12)
    blind = otherwise(event_location, "return bool(turn.fun >= -deep)", "return True")
    assert zero(begun_just_before, module=blind) is None


@pytest.mark.mutant("a guard that falls at once and comes back in the same step has not fallen")
def test_a_fall_at_once_is_found_though_it_comes_back() -> None:
    """It begins at zero, falls at once or after a short rise, and is above zero at the end."""
    assert zero(dips(0.0, 0.6), begins=True) == 0.0
    assert zero(lambda t: t * (t - 1e-3) * (t - 0.6), begins=True) == pytest.approx(1e-3)
    assert zero(dips(0.0, 0.6), begins=True, spent=True) is None
    blind = otherwise(event_location, "if begins and not spent and rise:", "if False:")
    assert zero(dips(0.0, 0.6), module=blind, begins=True) != 0.0


def let_go(t: float) -> float:
    """What is left [m] of a rope of 0.5 m that begins to part at 2e-6 m/s, and is taut at 1e-5 s.

    As it is computed it is too short by an ulp of its length at first, and for picoseconds.
    """
    return ((0.5 + 2e-6 * t * (1 - t / 1e-5)) - 0.5) + 1.1e-16 * (t < 1e-12)


@pytest.mark.mutant("a zero that rounding has made positive, and that rises first, falls at once")
def test_a_zero_that_is_rounded_up_begins_and_does_not_fall() -> None:
    assert zero(let_go, 4e-4, begins=True) == pytest.approx(1e-5, rel=1e-3)
    assert zero(lambda t: 1e-16 - t, 4e-4, begins=True) == pytest.approx(0.0, abs=TOGETHER)
    assert zero(lambda t: 1e-6 - t, 4e-4, begins=True) == pytest.approx(1e-6, abs=TOGETHER)
    blind = otherwise(event_location, "if begins and fall == 1:", "if False:")
    at = zero(let_go, 4e-4, module=blind, begins=True)
    assert at is not None
    assert at < 1e-10  # where the secant to the first point first meets rounding, and not 1e-5


# Steps in which no guard comes near zero: seen without a step to each state inside.

G = Callable[[float, Array, Array], float]


def swing(t: float) -> Array:
    """x and ẋ of ẍ = −x."""
    return np.array([math.cos(t), -math.sin(t)])


def is_clear(g: G, begin: float, h: float) -> bool:
    """Of one guard in a step of that motion."""
    f = lambda t, y: np.array([y[1], -y[0]])  # noqa: E731
    return clear([lambda t, y: g(t, *np.split(y, 2))], f, begin, h, swing(begin), swing(begin + h))


@pytest.mark.mutant("guards looked at only at the ends of a step")
@pytest.mark.parametrize("h", [0.1, 0.8])
def test_what_turns_at_zero_is_not_clear_and_what_stays_above_is(
    h: float, monkeypatch: Patch
) -> None:
    """x + 1 − depth turns at t = π, wherever in the step that is; `depth` is of what it changes."""
    for part in np.linspace(0.02, 0.98, 25).tolist():
        change = max(1.0 - math.cos(part * h), 1.0 - math.cos((1.0 - part) * h))
        for depth in (0.0, 1e-9, 0.02, -1e-9):
            g = lambda t, x, v, below=depth * change: x[0] + 1.0 - below  # noqa: E731
            assert not is_clear(g, math.pi - part * h, h)
    change = 1.0 - math.cos(h / 2)
    assert is_clear(lambda t, x, v: x[0] + 1.0 + 0.2 * change, math.pi - h / 2, h)
    assert is_clear(lambda t, x, v: 1.0 + 1e-3 * t, 0.0, h)
    monkeypatch.setattr(event_location, "LOOKS", (((0.0, 1.0), 0.1),))
    assert is_clear(lambda t, x, v: x[0] + 1.0, math.pi - 0.2, 0.5)


def test_what_is_no_number_or_cannot_be_computed_is_not_clear() -> None:
    assert not is_clear(lambda t, x, v: math.nan, 0.0, 0.1)
    assert is_clear(lambda t, x, v: math.sqrt(x[0] - 0.5), 0.0, 0.1)
    assert not is_clear(lambda t, x, v: math.sqrt(x[0] - 0.5), 1.0, 0.1)


def test_a_guard_that_is_far_costs_no_steps_and_one_that_is_near_does(monkeypatch: Patch) -> None:
    """But in the first step of a mode, in which it may begin at zero."""
    calls, attempt = [0], DormandPrince.attempt

    def counted(self: DormandPrince, *given: object) -> Array:
        calls[0] += 1
        return attempt(self, *given)  # type: ignore[arg-type]

    monkeypatch.setattr(DormandPrince, "attempt", counted)

    def more(g: Plain) -> int:
        """Attempts of the integrator beyond the steps of the motion."""
        calls[0] = 0
        steps = followed(Watched([("g", g)], Oscillator()), TIMES).steps
        return calls[0] - steps

    assert more(lambda t, x, v: 2.0 + x) <= 3
    assert more(lambda t, x, v: x + 1.0 + 1e-6) > 9


@pytest.mark.mutant("steps that are always held for free of events")
def test_a_look_that_is_always_clear_misses_events(monkeypatch: Patch) -> None:
    watched = Watched([("g", lambda t, x, v: x)], Oscillator())
    assert len(followed(watched, TIMES).events) == 1
    monkeypatch.setattr(follow, "clear", lambda *given: True)
    assert not followed(watched, TIMES).events


# What is kept of a motion: samples, changes, and on demand its steps.

DISK = BouncingDisk(m=1.0, R=0.25, e=1.0, y0=0.75)
FEW = np.linspace(0.0, 3.0, 4)


def test_a_sample_on_an_event_holds_the_state_after_it() -> None:
    times = [t for _, t in DISK.closed_events(3.0)]
    found = followed(DISK, np.array([0.0, *times]))
    assert len(found.events) == len(times)
    for row, e in zip(found.y[1:], found.events, strict=True):
        np.testing.assert_array_equal(row, e.after)
        assert row[1] > 0.0 > e.before[1]


def test_a_change_without_a_name_is_no_event() -> None:
    found = followed(Watched([(None, lambda t, x, v: x)], Oscillator(), "off"), FEW)
    assert found.events == ()
    assert [(c.mode_before, c.mode_after) for c in found.changes] == [("on", "off")]
    assert found.modes == ("on", "on", "off", "off")


def swinging() -> Followed:
    """x = cos t with a change of phase, but not of motion, at each zero on the way down."""
    down = Watched([("down", lambda t, x, v: x)], Oscillator())
    return followed(down, np.linspace(0.0, 10.0, 11), every=True)


def bouncing() -> Followed:
    return followed(DISK, FEW, every=True)


def by_phase(found: Followed) -> list[list[Kept]]:
    return [[row for row in found.rows if row[1] == k] for k in range(len(found.phases))]


def loose_ends(found: Followed, end: float) -> int:
    """How many phases do not run from change to change, in times that only grow."""
    begins = [(0.0, found.y[0]), *((c.time, c.after) for c in found.changes)]
    ends = [*((c.time, c.before) for c in found.changes), (end, found.y[-1])]
    wrong = int(any(a[:2] > b[:2] for a, b in zip(found.rows, found.rows[1:], strict=False)))
    for rows, begin, last in zip(by_phase(found), begins, ends, strict=True):
        times = [row[0] for row in rows]
        wrong += not (
            bool(np.all(np.diff(times) > 0.0))
            and (rows[0][0], rows[-1][0]) == (begin[0], last[0])
            and np.array_equal(rows[0][2], begin[1])
            and np.array_equal(rows[-1][2], last[1])
        )
    return wrong


def off(found: Followed, known: Callable[[float], Array]) -> float:
    """How far the rows inside the phases are from the known motion."""
    inside = [row for rows in by_phase(found) for row in rows[1:-1]]
    return max(float(np.abs(y - known(t)).max()) for t, _, y in inside)


def test_rows_of_each_phase_run_from_change_to_change_and_lie_on_the_motion() -> None:
    swung, bounced, plain = swinging(), bouncing(), followed(DISK, FEW)
    assert plain.rows == ()  # unless they are asked for, and then they change nothing
    np.testing.assert_array_equal(bounced.y, plain.y)
    assert [c.time for c in bounced.changes] == [c.time for c in plain.changes]
    assert (len(swung.changes), loose_ends(swung, 10.0)) == (2, 0)
    assert (len(bounced.changes), loose_ends(bounced, 3.0)) == (5, 0)
    assert len(swung.rows) > 3 * swung.steps  # three of them inside each step
    assert off(swung, swing) < 1e-12
    assert off(bounced, lambda t: np.concatenate(DISK.closed_form(t))) < 1e-12


@pytest.mark.mutant("a straight line inside the steps")
def test_interpolated_rows_are_seen(monkeypatch: Patch) -> None:
    def within(step: Any, probe: Any) -> Callable[[float], Array]:
        length = step.t_next - step.t
        return lambda h: step.y + h / length * (step.y_next - step.y)

    monkeypatch.setattr(follow, "inside", within)
    assert off(swinging(), swing) > 1e-4


@pytest.mark.mutant("a phase without its first row", "rows of a phase beyond its end")
def test_a_phase_that_lacks_a_row_or_goes_on_is_seen(monkeypatch: Patch) -> None:
    note = follow._Walk._note

    def whole(self: Any, t: float, lengths: list[float], *states: Any) -> None:
        """Rows of the whole step, of which only a part belongs to the phase."""
        part = [1.5 * length for length in lengths] if len(states) == 1 else lengths
        note(self, t, part, *states)

    with monkeypatch.context() as planted:
        planted.setattr(follow._Walk, "_note", whole)
        assert loose_ends(bouncing(), 3.0) >= 5
    monkeypatch.setattr(follow._Walk, "_enter", lambda self, mode: self.phases.append(mode))
    assert loose_ends(bouncing(), 3.0) == 6


class Rounded(Watched):
    """Guards of which it is known what of them is rounding, as it is of gaps."""

    def guards(self, mode: str) -> list[Guard]:
        return [replace(guard, rounds=lambda q: 1e-16) for guard in super().guards(mode)]


@pytest.mark.mutant("a fall soon after a guard's own zero, between places where it is looked at")
def test_what_begins_at_zero_and_falls_at_once_for_a_moment_falls(monkeypatch: Patch) -> None:
    """Below zero from 0.05 to 1.5 ms: the first step takes 9 ms.

    So a disk's last bounces were missed before it was lifted.
    """
    dips = lambda t, x, v: t * (5e-5 - t) * (1.5e-3 - t)  # noqa: E731
    system = Rounded([("down", dips)], Oscillator())
    assert [e.time for e in followed(system, FEW).events] == pytest.approx([5e-5], abs=1e-14)
    monkeypatch.setattr(follow, "SOON", ())
    assert followed(system, FEW).events == ()


@pytest.mark.slow
def test_a_pendulum_turns_when_its_period_says() -> None:
    """Small swings of a bar: T = 2π √(2 l / 3 g); ω falls through zero at T/2, 3 T/2, …"""
    text = """\
initial: {bar: {angle: -89.9999 deg}}
events: {turns: {bar.omega: falls to zero}}
duration: 2.0
allow: {bar.angle: 1.0e-9, hinge.fx: null}
"""
    case = scenes.scene("pendulum", text)
    record = solve(case).trajectory.record
    assert record is not None
    period = 2 * np.pi * np.sqrt(2 * 0.8 / (3 * 9.80665))
    found = reference_events(case.scene, record, case.events["turns"])
    assert found.tolist() == pytest.approx([period], abs=1e-9)


# A motion that ends before its time says in which mode, when, and about where it was.

FLAT = np.arccos(-0.5 / 1.5) / np.sqrt(3 / 0.7)  # s: there 0.5 m + 1.5 m cos(√(c/m) t) is zero


def ends(case: Case) -> tuple[PlanarMechanism, stuck.Stuck]:
    mechanism = scenes.mechanism(case)
    with pytest.raises(stuck.Stuck) as caught:
        followed(mechanism, case.times)
    return mechanism, caught.value


@pytest.mark.slow
def test_a_flat_parallelogram() -> None:
    mechanism, failure = ends(scenes.scene("parallelogram"))
    assert failure.mode is mechanism.modes[next(iter(mechanism.modes))]
    assert failure.time == pytest.approx(time_to_flat(), abs=1e-6)  # measured 4e-8
    np.testing.assert_allclose(np.sin(failure.q[[2, 5, 8]]), 0.0, atol=1e-5)  # measured 4e-7
    # Both cranks still turn alike, as well as rates are known so near: of their 3.6e-7 rad the
    # loop's constraint, kept to 1e-9 rad, leaves 0.3 % open, and as much of the rates.
    assert failure.v[2] == pytest.approx(failure.v[8], rel=1e-2)


@pytest.mark.slow
@pytest.mark.parametrize(("omega", "mode"), [(-20, "touch sticks"), (-40, "touch slides -")])
def test_a_spring_that_loses_its_length_ends_in_the_mode_of_that_time(
    omega: int, mode: str
) -> None:
    """Along a guide, beside a disk that slides for (v + R ω)/(3 μ g) and then rolls.

    It rolls from 0.68 s on, or not before 1.1 s.
    """
    text = f"""\
scene:
  points: {{O: [0, 0]}}
  bodies: {{wheel: {{disk: {{mass: 1.3, radius: 0.25}}}}, dot: {{particle: {{mass: 0.7}}}}}}
  joints: {{guide: {{slide: [ground.O, dot.center], along: [1, 0]}}}}
  contacts: {{touch: {{between: [wheel, ground.floor], friction: 0.4}}}}
  forces: {{coil: {{spring: [ground.O, dot.center], stiffness: 3, rest_length: 0.5}}}}
initial: {{wheel: {{x: 0, y: 0.25, angle: 0, vx: -3, omega: {omega}}}, dot: {{x: 2}}}}
allow: {{wheel.x: 1.0e-3, dot.x: 1.0e-2}}
"""
    mechanism, failure = ends(scenes.parsed(text))
    assert failure.mode is mechanism.modes[mode]
    assert failure.time == pytest.approx(FLAT, abs=1e-4)
    places = mechanism.base.poses(0.0, failure.q, failure.v)
    assert abs(places["dot"][0]) < 1e-3
    assert places["wheel"][1] == pytest.approx(0.25, abs=1e-12)


class Wall(Mode):
    """q̈ = 1/(1 − t), which nobody can follow beyond t = 1."""

    coordinates = ("x",)

    def start(self) -> tuple[Array, Array]:
        return np.zeros(1), np.zeros(1)

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return np.array([1.0 / (1.0 - t) if t < 1.0 else np.nan])


def test_a_written_mode_is_told_as_well() -> None:
    """x = (1 − t) ln(1 − t) + t, so that x is 1 there."""
    system = Only(Wall())
    with pytest.raises(stuck.Stuck) as caught:
        followed(system, np.array([0.0, 0.5, 2.0]))
    assert caught.value.mode is system.mode
    assert (caught.value.time, *caught.value.q) == pytest.approx((1.0, 1.0), abs=1e-3)


@pytest.mark.parametrize("pace", [1e-3, 0.0])
def test_who_looks_ahead_does_not_seem_to_stand_still(pace: float, monkeypatch: Patch) -> None:
    """In 20 s at 1 ms a call, once asked for the end: it goes on; at none it is stuck."""
    monkeypatch.setattr(stuck, "WATCHED", 100)
    y = np.zeros(2)
    watched = stuck.Watched(Still(), 20.0, y)
    watched(20.0, y)

    def goes_on() -> None:
        for k in range(1000):
            watched(pace * k, y)

    if pace:
        goes_on()
    else:
        with pytest.raises(IntegrationError, match="shrink to nothing"):
            goes_on()
