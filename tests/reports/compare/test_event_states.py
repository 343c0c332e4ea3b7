"""States at events of records whose motion is known, and events at a value and rising."""

import math
from collections.abc import Callable
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given.scenes import cases_of, scene

from textmech.cases.case import Case
from textmech.cases.fields.event import Event
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Body, Scene
from textmech.cases.scene.quantity import SIDES, AtEvent, Side, at_event
from textmech.cases.trajectory import VX, Array, Trajectory, X
from textmech.reference.solve import solve
from textmech.reports.compare.events import states as reading_states
from textmech.reports.compare.events import times as reading
from textmech.reports.compare.events.states import engine_states, mistaken, reference_states
from textmech.reports.compare.events.times import engine_events, reference_events

SCENE = Scene(
    (0.0, 0.0), {}, {"box": Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})}, {}, {}, {}
)
CASE: Any = SimpleNamespace(scene=SCENE, tube=0.0)
HITS = 0.61803  # s: a speed that is halved and turned there
SLOW, FAST = -0.4, 0.8


def hit(t: Array, *, after: bool) -> tuple[Array, Array]:
    """x and vx of what swings onto x = 0, and back at half the speed."""
    s, w = t - HITS, FAST if not after else SLOW
    return -w * np.sin(3 * s) / 3, -w * np.cos(3 * s)


def states(t: Array, after: Any) -> Array:
    found = np.zeros((len(t), 6))
    x, vx = np.where(after, hit(t, after=True), hit(t, after=False))
    found[:, X], found[:, VX] = x, vx
    return found


def engine(h: float) -> Trajectory:
    t = np.arange(round(1.0 / h) + 1, dtype=np.float64) * h
    return Trajectory(t, {"box": states(t, t > HITS)}, {})


def reference() -> Trajectory:
    """Steps of a twelfth of a second, and the hit as the last and the first row of two pieces."""
    before, after = np.linspace(0, HITS, 9), np.linspace(HITS, 1.0, 9)
    t, phase = np.concatenate([before, after]), np.repeat([0, 1], 9)
    return Trajectory(t, {"box": states(t, phase == 1)}, {}, phase=phase)


EXACT = {
    "box.vx.before": -FAST,
    "box.vx.after": -SLOW,
    "box.x": 0.0,
}


@pytest.mark.parametrize(("name", "value"), EXACT.items())
def test_each_side_of_a_jump(name: str, value: float) -> None:
    at = at_event(f"hits.{name}", ["hits"])
    assert at is not None
    record, event = reference(), Event("box.x", "falls to zero")
    assert reference_events(SCENE, record, event) == pytest.approx([HITS], abs=1e-15)
    found = reference_states(CASE, record, at, np.array([HITS]))
    assert found == pytest.approx([value], abs=1e-15)
    for h in (1e-3, 1e-2):
        times = engine_events(SCENE, engine(h), event)
        assert times == pytest.approx([HITS], abs=1e-2 * h)
        found = engine_states(CASE, engine(h), at, times)
        late = FAST * abs(times[0] - HITS)  # as fast as x is
        assert found == pytest.approx([value], abs=late + 1e2 * h**4)


@pytest.mark.parametrize(("side", "order"), [("before", 4), ("after", 4)])
def test_a_side_is_read_with_the_order_of_its_curve(side: Side, order: int) -> None:
    at, exact = AtEvent("hits", "box.vx", side), EXACT[f"box.vx.{side}"]
    steps = np.array([HITS / 60.5, HITS / 120.5])  # the event in the middle of a step
    errors = [
        abs(engine_states(CASE, engine(h), at, np.array([HITS]))[0] - exact) for h in steps.tolist()
    ]
    found = np.log(errors[0] / errors[1]) / np.log(steps[0] / steps[1])
    assert found == pytest.approx(order, abs=0.1)


@pytest.mark.mutant("a state read on the other side of an event")
@pytest.mark.parametrize("side", SIDES[1:])
def test_the_other_side_would_be_seen(side: Side) -> None:
    other = "before" if side == "after" else "after"
    (found,) = engine_states(CASE, engine(1e-3), AtEvent("hits", "box.vx", side), np.array([HITS]))
    assert abs(found - EXACT[f"box.vx.{other}"]) > 1.0


@pytest.mark.parametrize("t", [HITS, 0.618])  # between two steps, and on one
def test_a_step_on_the_event_is_of_no_side(t: float) -> None:
    times = np.arange(1001, dtype=np.float64) * 1e-3
    for after in (times > t - 1e-9, times > t + 1e-9):  # what the step on it tells is open
        found = np.zeros((len(times), 6))
        found[:, VX] = np.where(after, 2.0, 1.0)
        record = Trajectory(times, {"box": found}, {})
        for side, value in zip(SIDES[1:], (1.0, 2.0), strict=True):
            at = AtEvent("hits", "box.vx", side)
            assert engine_states(CASE, record, at, np.array([t])) == pytest.approx([value])


def blown(late: float, h: float = 1e-2) -> Trajectory:
    """Speeds of 1.5 m/s, and of 0.4 + 0.1 t m/s from the row on that is so many steps behind."""
    times = np.arange(round(1.0 / h) + 1, dtype=np.float64) * h
    found = np.zeros((len(times), 6))
    found[:, VX] = np.where(times < HITS + late * h, 1.5, 0.4 + 0.1 * times)
    return Trajectory(times, {"box": found}, {})


@pytest.mark.parametrize("h", [1e-2, 1e-3])
@pytest.mark.parametrize("late", [0.0, 0.5, 0.99])
def test_a_blow_that_the_next_row_does_not_tell_yet_is_not_continued(late: float, h: float) -> None:
    """A step's blow is told at its end, or half a step later by a record between the steps."""
    at, times = AtEvent("hits", "box.vx", "after"), np.array([HITS])
    for tube in (0.0, h / 2, 2 * h, 4 * h):
        case: Any = SimpleNamespace(scene=SCENE, tube=tube)
        found = engine_states(case, blown(late, h), at, times)
        assert found == pytest.approx([0.4 + 0.1 * (HITS + tube)], abs=1e-12)


def test_a_blow_that_lasts_for_more_than_a_step_is_told_as_it_is() -> None:
    """It is no rounding of a step: the row says so, and that the case may give a `tube`."""
    found = engine_states(CASE, blown(1.9), AtEvent("hits", "box.vx", "after"), np.array([HITS]))
    assert abs(found[0] - (0.4 + 0.1 * HITS)) > 0.5


@pytest.mark.mutant("a curve through the rows before and after a blow")
def test_a_curve_through_a_blow_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading_states, "_behind", lambda steps, u, rows, t: rows)
    found = engine_states(CASE, blown(0.99), AtEvent("hits", "box.vx", "after"), np.array([HITS]))
    assert found[0] > 1.5


@pytest.mark.parametrize("tube", [0.05, 0.2])
def test_after_an_event_may_be_later(tube: float) -> None:
    """What takes its time for a jump is there within the tube, and read at its end."""
    case: Any = SimpleNamespace(scene=SCENE, tube=tube)
    at, times = AtEvent("hits", "box.vx", "after"), np.array([HITS])
    exact = hit(times + tube, after=True)[1]
    assert reference_states(case, reference(), at, times) == pytest.approx(exact, abs=1e-9)
    slow = engine(1e-3)
    speed = slow.states["box"][:, VX]
    speed += np.where(slow.times > HITS, -np.exp(-(slow.times - HITS) / 4e-3), 0.0)
    left = np.exp(-tube / 4e-3)
    assert engine_states(case, slow, at, times) == pytest.approx(exact - left, abs=1e-8)
    assert engine_states(CASE, slow, at, times) < exact - 0.9


def moving(x: Callable[[Array], Array], h: float = 1e-3) -> Trajectory:
    t = np.arange(round(1.0 / h) + 1, dtype=np.float64) * h
    found = np.zeros((len(t), 6))
    found[:, X] = x(t)
    return Trajectory(t, {"box": found}, {}, phase=np.zeros(len(t), np.int64))


@pytest.mark.parametrize(
    ("rule", "value", "times"),
    [
        ("falls to zero", 0.0, [0.5]),
        ("rises to zero", 0.0, [1.0]),
        ("falls to zero", 0.5, [5 / 12]),
        ("rises to zero", 0.5, [1 / 12]),
        ("falls to zero", -0.5, [7 / 12]),
        ("rises to zero", -0.5, [11 / 12]),
    ],
)
def test_events_at_a_value_and_rising(rule: Any, value: float, times: list[float]) -> None:
    record = moving(lambda t: np.sin(2 * np.pi * t - 1e-9))  # so that it rises at the end too
    for read, exact in ((reference_events, times), (engine_events, times)):
        found = read(SCENE, moving(lambda t: np.sin(2 * np.pi * t)), Event("box.x", rule, value))
        if (rule, value) == ("rises to zero", 0.0):
            found, exact = read(SCENE, record, Event("box.x", rule, value)), []  # behind the end
        assert found == pytest.approx(exact, abs=1e-6)


def ending(t: Array, stop: float) -> Array:
    """A force of compression that ends, and is nothing from then on."""
    return np.where(t < stop, np.sin(3 * (t - stop)), 0.0)


@pytest.mark.parametrize("part", [0.01, 0.5, 0.99])
@pytest.mark.parametrize("h", [1e-3, 1e-2])
def test_a_force_that_ends_is_continued(part: float, h: float) -> None:
    stop = 0.4 + part * h
    (found,) = engine_events(
        SCENE, moving(lambda t: ending(t, stop), h), Event("box.x", "rises to zero")
    )
    assert found == pytest.approx(stop, abs=2e2 * h**5 + 1e-14)


@pytest.mark.mutant("a line for the curve to what has ended")
def test_a_line_to_what_has_ended_would_be_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "CURVE", 10**6)  # never enough steps before it
    record = moving(lambda t: ending(t, 0.4005))
    (found,) = engine_events(SCENE, record, Event("box.x", "rises to zero"))
    assert found == pytest.approx(0.401)


def bouncing(*names: str, e: float = 0.5) -> Case:
    """A particle that bounces, of which these are asked."""
    bounds = {name: 0.5 if name.endswith("count") else 1e-3 for name in names}
    changes = {
        "events": {"passes": {"ball.y": {"falls to": 0.4}}},
        "duration": 0.8,
        "samples": 11,
        "tube": "1 ms",
        "allow": bounds,
    }
    return scene("bouncing_particle", changes, m=2, vx=1, e=e)


def test_the_reference_of_a_bounce() -> None:
    names = (
        "lands.ball.vy.before",
        "lands.ball.vy.after",
        "passes.ball.vy",
        "passes.energy.kinetic",
    )
    case = bouncing(*names)
    motion = solve(case).trajectory
    assert mistaken(case, motion) == []
    assert motion.record is not None
    found = {}
    for name in names:
        at = at_event(name, case.events)
        assert at is not None
        times = reference_events(case.scene, motion.record, case.events[at.event])
        found[name] = reference_states(case, motion.record, at, times)[0]
    v = np.sqrt(2 * 9.80665)
    through = np.sqrt(2 * 9.80665 * 0.6)
    exact = [-v, 0.5 * v - 9.80665e-3, -through, 0.5 * 2.0 * (1.0 + through**2)]
    assert [found[name] for name in names] == pytest.approx(exact, rel=1e-11)


def test_a_state_at_what_never_happens_is_a_mistake() -> None:
    """The particle may land after the end; then there is no speed with which it lands."""
    short = replace(bouncing("lands.ball.vy.after"), duration=0.2)
    events = {"lands": short.events["lands"]}
    short = replace(short, events=events)
    (mistake,) = mistaken(short, solve(short).trajectory)
    assert mistake.where == "allow.lands.ball.vy.after"
    assert mistake.what == "never happens in 0.2 s: nothing is compared"
    count = replace(short, allow={"ball.x": 1e-3, "lands.count": 0.5})
    assert mistaken(count, solve(count).trajectory) == []


@pytest.mark.parametrize("e", [pytest.param(0.9, marks=pytest.mark.slow), 0.5, 0.1, 0.02, 1e-3])
def test_what_happens_without_end_has_no_count(e: float) -> None:
    """All bounces from 1 m end after (1 + e)/(1 - e) √(2/g), and the apexes between them with them.

    0.4 m are passed on the way down, and again after each of the bounces that are high enough.
    """
    fall = np.sqrt(2 / 9.80665)
    end = (1 + e) / (1 - e) * fall
    for duration, counts in ((1.3 * end, False), ((1 + 1.5 * e) * fall, True)):
        counts_of = ("lands.count", "tops.count", "passes.count")
        case = replace(bouncing(*counts_of, e=e), duration=duration)
        found = mistaken(case, solve(case).trajectory)
        endless = [] if counts else ["allow.lands.count", "allow.tops.count"]
        assert [mistake.where for mistake in found] == endless
        assert all(f"happens without end before {end:.4g} s" in each.what for each in found)


@pytest.mark.slow
@pytest.mark.mutant("a pile of events that is not told")
def test_a_pile_that_is_not_told_would_be_seen() -> None:
    case = replace(bouncing("tops.count"), duration=1.6)
    motion = replace(solve(case).trajectory, endless=())
    assert mistaken(case, motion) == []


def test_a_contact_that_lands_is_named_by_its_zero() -> None:
    case = bouncing("lands.time")
    other = replace(case, events={"lands": Event("touch.gap", "falls to zero", 0.1)})
    with pytest.raises(CaseError, match="starts 1 m above the floor"):
        solve(other)


def test_a_jump_needs_a_side() -> None:
    case = bouncing("lands.ball.vx", "lands.ball.vy")
    (mistake,) = mistaken(case, solve(case).trajectory)
    assert str(mistake.where) == "allow.lands.ball.vy"
    assert mistake.what == (
        "jumps there, from -4.42869 to 2.21435: say lands.ball.vy.before or lands.ball.vy.after"
    )


TURNED = """\
title: A particle is pushed back, and then forth
scene:
  gravity: none
  bodies: {ball: {particle: {mass: 1.0}}}
  forces: {push: {push: ball.center, table: {along: [1, 0], times: [0.4, 0.5], values: [-1, 5]}}}
initial: {ball: {x: 0, y: 0, vx: 1.0, vy: 0}}
events: {slow: {ball.vx: {falls to: 0.605}}}
duration: 1.0
samples: 6
step: {mujoco: 1.0e-3, pymunk: 1.0e-3}
allow: {slow.time: 1.0e-2, slow.ball.x: 1.0e-2}
"""
BEFORE = 0.605, 0.395, 0.395 - 0.395**2 / 2
S = (1 - math.sqrt(0.52)) / 60  # s behind the corner, where 0.004 m/s are lost
BEHIND = 0.596, 0.4 + S, 0.32 + 0.6 * S - S**2 / 2 + 10 * S**3


@pytest.mark.mutant("a quantity at an event read from a curve through both sides of a corner")
@pytest.mark.parametrize(("slow", "t", "x"), [BEFORE, BEHIND], ids=["before", "behind"])
def test_a_state_at_an_event_beside_a_corner_is_read_from_its_side(
    slow: float, t: float, x: float
) -> None:
    """v = 1 − t until 0.4 s, and 0.605 at 0.395 s; v = 0.6 − s + 30 s² behind it."""
    (case,) = cases_of(TURNED.replace("0.605", repr(slow)))
    record, at = solve(case).trajectory.record, at_event("slow.ball.x", case.events)
    assert record is not None
    assert at is not None
    times = reference_events(case.scene, record, case.events["slow"])
    assert times[0] == pytest.approx(t, abs=1e-14)
    found = reference_states(case, record, at, times)
    assert found == pytest.approx([x], abs=1e-14)


FLIGHT = """\
title: A ball that comes up to a height
scene:
  bodies: {{ball: {{particle: {{mass: 1}}}}}}
initial: {{ball: {{x: 0, y: 0, vx: 1, vy: 4.42869}}}}
events: {{up: {{ball.y: {{rises to: {height!r}}}}}}}
duration: 0.9
samples: {samples}
allow: {{ball.x: 0.1, ball.y: 0.1, up.count: 0.5}}
"""
TOP = 4.42869**2 / 2 / 9.80665


@pytest.mark.parametrize("samples", [4, 10, 31])  # with 31 a sample is 1 ms from the top
@pytest.mark.parametrize("below", [1e-6, 1e-8, 1e-10, 0.0, -1e-10, -1e-8])
def test_a_graze_is_an_event_or_none_or_is_asked_to_be_said_otherwise(
    below: float, samples: int
) -> None:
    (case,) = cases_of(FLIGHT.format(height=TOP - below, samples=samples))
    motion = solve(case).trajectory
    assert motion.record is not None
    found = reference_events(case.scene, motion.record, case.events["up"])
    said = [str(mistake) for mistake in mistaken(case, motion)]
    if abs(below) < 1e-9:  # of a metre, the largest place
        assert "ball.y comes to" in said[0]
        assert "turns back" in said[0]
    elif below > 0.0:
        early = math.sqrt(2 * below / 9.80665)
        assert found == pytest.approx([4.42869 / 9.80665 - early], abs=1e-15 / early)
        assert said == []
    else:
        assert "never happens" in said[0]


@pytest.mark.mutant("what touches the value of an event is none, without a word")
def test_a_graze_that_is_not_said_is_certified(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(reading, "_touches", lambda *_: iter(()))
    with pytest.raises(AssertionError):
        test_a_graze_is_an_event_or_none_or_is_asked_to_be_said_otherwise(1e-10, 10)


PUSHED = """\
title: A block that a law sets off, stops, or turns
source: {{equations: ["2.60"]}}
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{particle: {{mass: 1.0}}}}}}
  joints: {{r: {{slide: [ground.O, b.center], along: [1, 0]}}}}
  {acts}
initial: {{r: {{shift: 0, speed: {speed}}}}}
events: {{it: {{b.vx: {rule}}}}}
duration: 2.0
samples: {samples}
step: {{mujoco: 0.005, pymunk: 0.005}}
allow: {{b.x: 1.0e-3, it.time: 1.0e-3}}
"""
STEP = "forces: {p: {push: b.center, step: {amplitude: [1, 0], at: 0.25}}}"
PULSE = "forces: {p: {push: b.center, pulse: {amplitude: [-1, 0], from: 0.25, until: 1.25}}}"
TABLE = "drive: {r.speed: {table: {times: [0, 0.5, 1, 1.5, 2], values: [1, 0, 0, 1, -1]}}}"


def pushed(acts: str, speed: str, rule: str, samples: int = 21) -> Any:
    text = PUSHED.format(acts=acts, speed=speed, rule=rule, samples=samples)
    (case,) = cases_of(text.replace(", speed: none", ""))
    return case, solve(case).trajectory


@pytest.mark.slow
@pytest.mark.mutant("what begins or ends to rest at a corner of a law, which changes no mode")
@pytest.mark.parametrize("samples", [21, 11])
@pytest.mark.parametrize(
    ("acts", "speed", "rule", "times"),
    [
        (STEP, "0", "leaves zero", [0.25]),
        (PULSE, "1", "stays zero", [1.25]),
        (PULSE, "1", "falls to zero", [1.25]),
        (TABLE, "none", "stays zero", [0.5]),
        (TABLE, "none", "leaves zero", [1.0]),
        (TABLE, "none", "falls to zero", [0.5, 1.75]),
    ],
)
def test_what_a_law_sets_off_or_stops_is_an_event(
    acts: str, speed: str, rule: str, times: list[float], samples: int
) -> None:
    case, motion = pushed(acts, speed, rule, samples)
    found = reference_events(case.scene, motion.record, case.events["it"])
    assert found.tolist() == pytest.approx(times, abs=1e-12)
    assert mistaken(case, motion) == []


@pytest.mark.slow
def test_what_comes_at_the_last_instant_is_said_to() -> None:
    """v = 1 − t/2; and a ball that lands at 1 s: by h = v t + g t²/2."""
    slows = "forces: {p: {push: b.center, constant: [-0.5, 0]}}"
    (mistake,) = mistaken(*pushed(slows, "1", "falls to zero"))
    assert mistake.what.startswith("comes at the last instant, 2 s: whether it still happens")
    changes = {"events": {"tops": None}, "allow": {"lands.time": 1e-3}}
    case = scene("bouncing_particle", changes, y=5.903325, vx=1, vy=-1)
    (mistake,) = mistaken(case, solve(case).trajectory)
    assert mistake.what.startswith("comes at the last instant, 1 s")
