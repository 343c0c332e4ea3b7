"""What strikes is judged over the phase of the step, and beside an impact from both sides."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise

from textmech import engines
from textmech.cases.case import Case
from textmech.cases.fields.signal import Signal
from textmech.cases.load import load
from textmech.engines.engine import Plan
from textmech.reference.solve import motion_of, solve
from textmech.reports.compare.judge import unintended
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.trial import impacts, phases
from textmech.reports.compare.trial.start import first
from textmech.reports.compare.trial.trial import Trial, planned

SPEED, BACK, STEP = 2.0, 0.5, 1e-2  # m/s, –, s
BALL = """\
title: A disk that strikes a wall and is thrown back, without gravity
scene:
  gravity: none
  bodies: {{ball: {{disk: {{mass: 2.0, radius: 0.1}}}}}}
  contacts: {{touch: {{between: [ball, ground.floor], friction: 0, restitution: 0.5}}}}
initial: {{ball: {{x: 0, y: {height} m, angle: 0, vx: 0, vy: -2.0, omega: 0}}}}
duration: {duration}
samples: 26
events: {{strikes: {{touch.gap: falls to zero}}}}
allow: {{ball.y: 1.0e-2, ball.vy: 1.0e-2}}
"""


def thrown(folder: Path, height: float, duration: float = 1.0) -> Case:
    """A case of the disk from a height [m] of its centre."""
    file = folder / f"ball_{height:.6f}.yaml".replace(".", "_", 1)
    file.write_text(BALL.format(height=height, duration=duration), encoding="utf-8")
    (case,) = load(file)
    return case


def trial(case: Case, engine: str = "pymunk") -> Trial:
    """The engine's own native way as shipped."""
    reference, shipped = solve(case).trajectory, engines.make(engine, "shipped")
    ways = planned(shipped, case.scene, first(reference))
    way = next(way for way in ways if isinstance(way, Plan))
    return Trial(case, reference, shipped, way)


def rows(case: Case) -> dict[str, Any]:
    return {row.quantity: row for row in compare(trial(case)).rows}


@pytest.mark.parametrize("part", [0.02, 0.3, 0.55, 0.98])
def test_the_worst_start_is_nearly_the_bound(tmp_path: Path, part: float) -> None:
    """(1 + e) v h, whatever part of a step is left when it strikes; a quarter less at most.

    It strikes that part of a step after the 40th, and pymunk sees it at a step's end.
    """
    row = rows(thrown(tmp_path, 0.1 + SPEED * STEP * (40 + part)))["ball.y"]
    bound = (1 + BACK) * SPEED * STEP
    assert 0.75 * bound - 1e-9 <= row.error <= bound + 1e-9
    assert "the worst of 4 starts within a step" in row.protocol


@pytest.mark.mutant("one start within a step is taken for all")
def test_the_luck_of_one_start_is_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    lucky = thrown(tmp_path, 0.1 + SPEED * STEP * 40.999)  # strikes just before a step's end
    assert rows(lucky)["ball.y"].verdict == "beyond"
    monkeypatch.setattr(phases, "PARTS", ())
    assert rows(lucky)["ball.y"].error < 1e-3
    assert rows(lucky)["ball.y"].verdict == "agrees"


def test_each_start_is_the_same_motion_later(tmp_path: Path) -> None:
    """Against the closed form; and what does not strike has one start."""
    case = thrown(tmp_path, 0.5)
    made = list(phases.begun_later(trial(case), STEP))
    assert [one.case.late for one in made] == pytest.approx([2.5e-3, 5e-3, 7.5e-3])
    for one in made:
        t = case.times[:-1] + one.case.late
        strikes = 0.4 / SPEED
        y = np.where(t < strikes, 0.5 - SPEED * t, 0.1 + BACK * SPEED * (t - strikes))
        assert one.wanted("ball.y") == pytest.approx(y, abs=1e-12)
    flies = replace(case, duration=0.1, allow={"ball.y": 1e-2})
    assert not phases.moves(trial(flies))


@pytest.mark.mutant("beside an impact a sample is compared with one side alone")
def test_a_sample_on_an_impact_is_compared_with_both_sides(tmp_path: Path) -> None:
    """It strikes at 0.4 s, which is a sample, and pymunk is before it there: 3 m/s apart."""
    row = rows(thrown(tmp_path, 0.1 + SPEED * 0.4))["ball.vy"]
    assert row.error == pytest.approx(0.0, abs=1e-12)
    made, near = trial(thrown(tmp_path, 0.1 + SPEED * 0.4)), 0.4
    k = int(np.argmin(np.abs(made.case.times - near)))
    late = made.wanted("ball.vy").copy()
    late[k], late[k + 1] = -SPEED, -SPEED
    fairly = impacts.fair(made, "ball.vy", late, STEP)
    assert fairly[k] == pytest.approx(made.wanted("ball.vy")[k])
    assert fairly[k + 1] == -SPEED  # four steps later it is wrong
    one_sided = otherwise(impacts, "BESIDE = 2", "BESIDE = -1")
    assert one_sided.fair(made, "ball.vy", late, STEP)[k] == -SPEED


def test_what_is_farther_off_than_both_sides_is_told(tmp_path: Path) -> None:
    made = trial(thrown(tmp_path, 0.1 + SPEED * 0.4))
    k = int(np.argmin(np.abs(made.case.times - 0.4)))
    off = made.wanted("ball.vy").copy()
    off[k] = -SPEED - 0.25
    wanted = made.wanted("ball.vy")[k]
    assert impacts.fair(made, "ball.vy", off, STEP)[k] - wanted == pytest.approx(-0.25)


@pytest.mark.parametrize(
    "law",
    [
        Signal("constant", (2.0,)),
        Signal("ramp", (2.0,)),
        Signal("sine", (2.0,), angular_frequency=3.0, phase=0.2),
        Signal("step", (2.0,), times=(0.5,)),
        Signal("pulse", (2.0,), times=(0.5, 0.8)),
        Signal("polynomial", (2.0,), values=(1.0, -2.0, 3.0)),
        Signal("table", (2.0,), times=(0.0, 0.5, 0.8), values=(1.0, 3.0, -2.0)),
    ],
    ids=lambda law: law.law,
)
def test_a_law_in_time_is_moved_with_the_start(law: Signal) -> None:
    times, by = np.linspace(0.0, 1.0, 23), 0.0625
    moved = law.later(by)
    assert moved.at(times) == pytest.approx(law.at(times + by), abs=1e-13)


def test_the_motion_of_other_times_is_the_certified_one(tmp_path: Path) -> None:
    case = thrown(tmp_path, 0.5)
    motion, other = solve(case).trajectory, motion_of(case)(np.union1d(case.times, [0.123, 0.4567]))
    rows = np.searchsorted(other.times, case.times)
    assert other.states["ball"][rows] == pytest.approx(motion.states["ball"], abs=1e-13)
    assert other.blows == pytest.approx(motion.blows, abs=1e-13)


@pytest.mark.mutant("a sample on an impact is told by nothing")
def test_a_sample_on_an_impact_is_told(tmp_path: Path) -> None:
    """It strikes at 0.4 s, which is the eleventh sample of 26 and none of 24."""
    case = thrown(tmp_path, 0.1 + SPEED * 0.4)
    (what,) = unintended.unintended(case, solve(case).trajectory)
    assert what.startswith("the sample at 0.4 s falls on an impact")
    others = replace(case, samples=24)
    assert not [*unintended.unintended(others, solve(others).trajectory)]
    silent = otherwise(unintended, "    if met:", "    if not met:")
    assert not [*silent.unintended(case, solve(case).trajectory)]
