"""Events of an engine that are small beside its motion, or too soon for its step, or rests."""

from pathlib import Path

import numpy as np
import pytest
from given.command import textmech
from given.scenes import typed

from textmech.cases.case import Case, Event
from textmech.cases.scene import Body, Scene
from textmech.cases.trajectory import VX, Array, Trajectory
from textmech.engines.engine import Engine
from textmech.engines.pymunk import Pymunk
from textmech.reference.solve import solve
from textmech.reports.compare.events import times as reading_events
from textmech.reports.compare.events.rests import LOW
from textmech.reports.compare.events.times import (
    Known,
    engine_events,
    reading,
    reference_events,
    surely,
)
from textmech.reports.compare.events.timing import Timing
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import Trial, planned
from textmech.reports.data.row import AGREES, REFUSED, Comparison

GROWS = """\
scene:
  bodies: {b: {particle: {mass: 2.0}}}
  contacts: {l: {between: [b, ground.floor], friction: 0.3}}
  forces:
    hand:
      push: b.center
      table: {along: [1, 0], times: [TIMES], values: [VALUES]}
events: {loose: {l.slip: leaves zero}, stops: {l.slip: stays zero}}
initial: {b: {x: 0, y: 0, vx: 0, vy: 0}}
allow: {b.x: 1.0e-3, loose.time: 1.0e-2}
"""
SLOWLY = ("0, 0.5, 0.6", "5.8, 6.2, 60.0")  # 1 % of its speed in 0.4 s, and then the rest
WEAKLY = ("0, 0.1, 0.3, 0.31, 1.0, 1.01, 1.04, 1.05, 1.5, 1.6", "0, 20, 20, 0, 0, 7, 7, 0, 0, 20")
SOON = ("0, 0.1", "0, 20")  # after 29 ms
STEP = 1e-4

FREE = """\
scene: {bodies: {b: {particle: {mass: 1}}}, gravity: none}
events: {up: {b.x: {rises to: 0.02}}}
initial: {b: {x: 0, y: 0, vx: 1, vy: 0}}
allow: {up.time: 1.0e-3}
"""
PUCK = """\
scene:
  gravity: none
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {p: {particle: {mass: 1.0}}}
  contacts: {touch: {between: [p, ground.wall], friction: 0, restitution: 0.5}}
initial: {p: {x: 0.80017, y: 0, vx: -2, vy: 0}}
events: {hits: {touch.gap: falls to zero}}
step: 1.0e-4
allow: {p.x: 1.0e-5, hits.time: 1.0e-5, hits.p.vx.after: 1.0e-3}
"""


def solved(tmp_path: Path, law: tuple[str, str], duration: float = 2.0) -> tuple[Case, Trajectory]:
    text = GROWS.replace("TIMES", law[0]).replace("VALUES", law[1])
    tail = f"duration: {duration}\nsamples: 21\nstep: {STEP}\n"
    case = typed(tmp_path, text if duration > 1 else text.replace(STOPS, ""), tail=tail)
    record = solve(case).trajectory.record
    assert record is not None
    return case, record


STOPS = ", stops: {l.slip: stays zero}"


def read(case: Case, record: Trajectory, event: Event, step: float, share: float) -> Array:
    """Times of the event in an engine that takes these steps of the exact motion."""
    times, u = reading_events._at_steps(case.scene, record, event, step)
    return reading_events._read(times, u, event, Known(share), 0.0)


@pytest.mark.slow
@pytest.mark.mutant("what moves is told by 2 % of its largest value, however slowly it begins")
def test_what_begins_slowly_begins_when_it_does(tmp_path: Path) -> None:
    case, record = solved(tmp_path, SLOWLY, 1.0)
    event = case.events["loose"]
    happens = reference_events(case.scene, record, event)
    assert happens == pytest.approx([0.1049875], abs=1e-9)
    share = reading(case.scene, record, event, happens, STEP)
    assert read(case, record, event, STEP, share) == pytest.approx(happens, abs=STEP)
    assert read(case, record, event, STEP, LOW)[0] > happens[0] + 0.3


@pytest.mark.slow
@pytest.mark.mutant("a slip below 4 % of the largest is a rest, and the next its partner")
def test_a_weak_slip_between_two_is_one(tmp_path: Path) -> None:
    case, record = solved(tmp_path, WEAKLY)
    for name, count in (("loose", 3), ("stops", 2)):
        event = case.events[name]
        happens = reference_events(case.scene, record, event)
        share = reading(case.scene, record, event, happens, STEP)
        assert len(happens) == count == len(read(case, record, event, STEP, share))
        assert len(read(case, record, event, STEP, LOW)) < count


@pytest.mark.slow
def test_what_a_step_cannot_tell_is_paired_with_what_it_is(tmp_path: Path) -> None:
    """Of three the weak one in the middle is not seen: the second that is found is the third."""
    case, record = solved(tmp_path, WEAKLY)
    event, step = case.events["loose"], 2e-2
    happens = reference_events(case.scene, record, event)
    assert surely(case.scene, record, event, happens, step, LOW).tolist() == [2]
    motion = Trajectory(record.times, record.states, {}, record=record)
    engine = Pymunk("tuned")
    trial = Trial(case, motion, engine, planned(engine, case.scene, first(motion))[0])
    assert trial.timing.partners("loose", happens + STEP).tolist() == [0, 1, 2]
    assert trial.timing.partners("loose", happens[[0, 2]] + step).tolist() == [0, 2]
    assert trial.timing.partners("loose", happens[[2]] - step).tolist() == [2]


def judged(case: Case, engine: Engine) -> list[Comparison]:
    """All rows of the case in the engine, in all ways."""
    motion = solve(case).trajectory
    ways = planned(engine, case.scene, first(motion))
    return [row for way in ways for row in compare(Trial(case, motion, engine, way)).rows]


REST = 0.5  # s, from 1 m/s
CROSSES = 0.7  # s: then what is left of it changes its sign


def coasting(after: float) -> tuple[Scene, Trajectory]:
    """A block that friction stops, and whose rate is then so small a part."""
    times = np.arange(10001, dtype=np.float64) * STEP
    states = np.zeros((len(times), 6))
    states[:, VX] = np.where(times < REST, 1 - times / REST, after * (CROSSES - times))
    body = Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})
    scene = Scene((0.0, 0.0), {}, {"box": body}, {}, {}, {})
    return scene, Trajectory(times, {"box": states}, {}, phase=np.zeros(len(times), np.int64))


@pytest.mark.mutant("what has come to rest falls to zero when its rounding changes its sign")
@pytest.mark.parametrize("after", [1e-5, 1e-12])
def test_what_friction_stops_falls_to_zero_as_it_stops(after: float) -> None:
    scene, record = coasting(after)
    event = Event("box.vx", "falls to zero")
    assert engine_events(scene, record, event, Known(LOW)) == pytest.approx([REST], abs=1e-6)
    seen = CROSSES if after > 1e-9 else REST  # what is less is zero, as in the reference
    assert engine_events(scene, record, event) == pytest.approx([seen], abs=1e-3)


@pytest.mark.slow
def test_what_only_decays_does_not_come_to_rest(tmp_path: Path) -> None:
    text = """\
scene:
  gravity: none
  bodies: {b: {particle: {mass: 1.0}}}
  forces: {air: {drag: b.center, coefficient: 20.0, exponent: 1}}
events: {at: {b.x: {rises to: 0.02}}, turns: {b.vx: falls to zero}}
initial: {b: {x: 0, y: 0, vx: 1, vy: 0}}
allow: {b.x: 1.0e-3, at.time: 1.0e-2}
"""
    case = typed(tmp_path, text)
    record = solve(case).trajectory.record
    assert record is not None
    assert reading(case.scene, record, case.events["turns"], np.zeros(0), 1e-3) == 0.0


@pytest.mark.slow
@pytest.mark.mutant("a count that steps cannot tell is equal")
def test_what_comes_too_soon_for_a_step_is_no_reproach(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Three steps before it breaks loose, and two of three before the end of a short motion."""
    case = typed(
        tmp_path,
        GROWS.replace("TIMES", SOON[0]).replace("VALUES", SOON[1]).replace(STOPS, ""),
        tail="duration: 0.5\nsamples: 26\n",
    )
    rows = {row.quantity: row for row in judged(case, Pymunk("shipped"))}
    assert rows["loose.time"].verdict == REFUSED
    assert "is sure of nothing" in rows["loose.time"].because
    assert rows["loose.count"].verdict == REFUSED
    told = "adapter: reference 1 (of which 0 last long enough for this step), engine 0: a smaller"
    assert rows["loose.count"].because.startswith(told)
    counted = Timing.miscounted
    monkeypatch.setattr(Timing, "miscounted", lambda *given: counted(*given) or 0.0)
    rows = {row.quantity: row for row in judged(case, Pymunk("shipped"))}
    assert rows["loose.count"].verdict == AGREES


def test_counts_that_differ_are_not_equal(tmp_path: Path) -> None:
    """Of three slips such steps tell the last alone; what they tell, and misses, is counted."""
    case, record = solved(tmp_path, WEAKLY)
    timing = Timing(case, record)
    told = {count: timing.miscounted("loose", count, 2e-2) for count in range(6)}
    assert told == {0: 1.0, 1: None, 2: None, 3: 0.0, 4: 1.0, 5: 2.0}
    assert timing.miscounted("loose", 2, STEP) == 1.0


@pytest.mark.slow
def test_a_motion_of_ten_steps_has_its_rows(tmp_path: Path) -> None:
    (tmp_path / "one.yaml").write_text(f"title: t\n{FREE}duration: 0.03\nsamples: 3\n")
    (tmp_path / "own.yaml").write_text("pymunk: {damping: 0, step: 0.003}\n")
    done = textmech(
        "run", tmp_path / "one.yaml", "--engine", "pymunk", "--settings", tmp_path / "own.yaml"
    )
    assert done.returncode == 0, done.stdout
    assert "crashed" not in done.stdout
    assert "none is found" in " ".join(done.stdout.split())


@pytest.mark.slow
@pytest.mark.parametrize(("speed", "duration"), [(1.2, 1.0), (0.9, 1.0), (1.2, 0.7), (1.2, 2.3)])
def test_the_exact_motion_at_steps_is_it(speed: float, duration: float, tmp_path: Path) -> None:
    """Also where it stops on a sample, behind which are rows an ulp apart; and at its very end."""
    case = typed(
        tmp_path,
        f"""\
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies: {{b: {{particle: {{mass: 1}}}}}}
  joints: {{r: {{slide: [ground.O, b.center], along: [1, 0], dry_friction: {{kinetic: 3}}}}}}
  forces: {{p: {{push: b.center, step: {{amplitude: [8.0, 0], at: 0.65}}}}}}
initial: {{b: {{x: 0, vx: {speed}}}}}
events: {{go: {{r.slip: leaves zero}}, stop: {{r.slip: stays zero}}}}
allow: {{b.x: 1.0e-3}}
""",
        tail=f"duration: {duration}\nsamples: {round(duration * 10) + 1}\n",
    )
    record = solve(case).trajectory.record
    assert record is not None
    t, u = reading_events._at_steps(case.scene, record, case.events["go"], 1e-4)
    wanted = np.clip(speed - 3 * t, 0.0, None) + 5 * np.clip(t - 0.65, 0.0, None)
    assert u == pytest.approx(wanted, abs=1e-9)
    for name, happens in (("go", 0.65), ("stop", speed / 3)):
        event, times = case.events[name], np.array([happens])
        share = reading(case.scene, record, event, times, 1e-3)
        assert share == LOW
        assert surely(case.scene, record, event, times, 1e-3, share).tolist() == [0]


def test_of_two_that_are_close_one_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    """Exact steps show the second alone: an engine that has that is not one short."""
    scene, record = coasting(0.0)
    happened, found = np.array([0.100, 0.104]), np.array([0.104])
    monkeypatch.setattr(reading_events, "_at_steps", lambda *given: (record.times, found))
    monkeypatch.setattr(reading_events, "_read", lambda *given: found)
    event = Event("box.vx", "leaves zero")
    assert surely(scene, record, event, happened, 1e-3, LOW).tolist() == [1]


def test_what_swings_on_has_not_come_to_rest() -> None:
    """By 3 % of its first speed, without end: that is no trembling."""
    scene, record = coasting(0.0)
    states, t = record.states["box"].copy(), record.times
    states[:, VX] += np.where(t > REST, -0.03 * np.sin(8 * np.pi * (t - REST)), 0.0)
    swings = Trajectory(t, {"box": states}, {}, phase=record.phase)
    event = Event("box.vx", "falls to zero")
    assert len(engine_events(scene, swings, event, Known(LOW))) > 1


def test_what_lands_in_the_last_step_has_landed(tmp_path: Path) -> None:
    puck = PUCK.replace("0.80017", "0.7996").replace("step: 1.0e-4", "step: 1.0e-3")
    case = typed(tmp_path, puck, tail="duration: 0.4\nsamples: 6\n")
    rows = {row.quantity: row for row in judged(case, Pymunk("tuned"))}
    assert rows["hits.count"].error == 0.0
    assert (rows["hits.time"].error or 0.0) < 1e-3  # found where the step ends
