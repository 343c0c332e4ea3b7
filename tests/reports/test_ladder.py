"""Which steps are judged and climbed, whatever the case says of them."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given.otherwise import otherwise
from given.scenes import SHIPPED

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.reports.compare.judge import compare as comparing
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.judge.convergence import Convergence
from textmech.reports.compare.trial import ladder as stepping
from textmech.reports.compare.trial.ladder import (
    USUAL,
    judged_step,
    ladders,
    wanted_reactions,
)
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import AGREES, ANOTHER, FALLS, WITHIN
from textmech.reports.show import script as showing

Make = Callable[..., Trial]
TEXT = """\
title: A ball that falls
scene: {bodies: {ball: {particle: {mass: 2.0}}}}
parameters: {h: 2 ms}
initial: {ball: {x: 0, y: 0}}
duration: 1.0
samples: 26
allow: {ball.y: 1.0e-2}
"""


def written(folder: Path, step: str) -> Case:
    file = folder / "ball.yaml"
    file.write_text(TEXT + step, encoding="utf-8")
    (case,) = load(file)
    return case


@pytest.mark.parametrize(
    ("step", "mujoco", "pymunk"),
    [
        ("step: {mujoco: 1.0e-3, pymunk: h}", 1e-3, 2e-3),
        ("step: {mujoco: h}\n", 2e-3, USUAL),
        ("step: h\n", 2e-3, 2e-3),
        ("step: 1 ms\ndrops_out: [h]\nsystem: fall\n", 1e-3, 1e-3),
        ("drops_out: [h]\nsystem: fall\n", USUAL, USUAL),
    ],
)
def test_one_number_or_by_engine_or_none(
    tmp_path: Path, trial: Make, step: str, mujoco: float, pymunk: float
) -> None:
    case = written(tmp_path, step)
    for name, wanted in (("mujoco", mujoco), ("pymunk", pymunk)):
        assert judged_step(case, trial(name=name).engine) == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("duration", [1.0, 0.7, 1 / 3, 3e-4, 1e-7, 123.4])
@pytest.mark.parametrize("samples", [3, 26, 61])
def test_the_usual_step_is_shortened_until_a_ladder_fits(
    moving: Case, trial: Make, duration: float, samples: int
) -> None:
    case = replace(moving, step={}, duration=duration, samples=samples)
    step = judged_step(case, trial().engine)
    assert 0 < step <= USUAL * (1 + 1e-9)
    ratio = case.interval / (4 * step)
    assert ratio == pytest.approx(round(ratio), rel=1e-9)
    made = trial(case=case)
    for ladder in ladders(case, made.engine, made.plan):
        assert len(ladder.steps) >= 3


def test_a_case_without_an_engines_step_is_run(trial: Make, moving: Case) -> None:
    made = trial(case=replace(moving, step={"mujoco": 1e-3}), name="pymunk")
    found = next(row for row in compare(made).rows if row.quantity == "ball.x")
    assert (found.verdict, found.step) == (AGREES, pytest.approx(USUAL))


def test_only_tied_numbers_climb_twice(trial: Make, moving: Case) -> None:
    for follows, names in ((False, ["held"]), (True, ["following", "held"])):
        made = trial(follows=follows)
        found = list(ladders(moving, made.engine, made.plan))
        assert [ladder.name for ladder in found] == names
        assert found[-1].plan(made.plan).kept == found[-1].steps[-1]


@pytest.mark.parametrize(("step", "first", "second"), [(1e-3, 4, 4), (5e-4, 5, 4), (2.5e-4, 6, 5)])
def test_the_second_ladder_begins_a_rung_above_where_four_are_left(
    trial: Make, moving: Case, step: float, first: int, second: int
) -> None:
    """Half of the work is its finest rung; three rungs have no size that falls."""
    made = trial(case=replace(moving, step=step), follows=True)
    following, held = ladders(made.case, made.engine, made.plan)
    assert (len(following.steps), len(held.steps)) == (first, second)
    assert following.steps[0] == step
    assert following.steps[first - second :] == held.steps
    (alone,) = ladders(made.case, made.engine, trial().plan)
    assert alone.steps == following.steps


@pytest.mark.parametrize(
    ("name", "asked", "given"),
    [
        ("tilting_disk.circle", ["touch.side", "touch.along", "touch.gap"], ["fx", "fy"]),
        ("five_axis_robot.swinging", ["q1.force", "q1.fz", "q1.angle"], ["fx", "fy", "fz"]),
        ("five_axis_robot.swinging", ["q4.moment"], ["mx", "my", "mz"]),
        ("driven_robot", ["q1.torque", "hand.attitude"], ["torque"]),
        ("robot_knife", ["blade.force", "blade.normal", "blade.slip"], ["force", "normal"]),
        ("rhombus", ["foot.force", "diagonal.length"], ["force"]),
    ],
)
def test_an_engine_is_asked_for_what_quantities_are_made_of(
    name: str, asked: list[str], given: list[str]
) -> None:
    part = asked[0].partition(".")[0]
    assert wanted_reactions(SHIPPED[name].scene, asked) == tuple(f"{part}.{f}" for f in given)


@pytest.mark.mutant("samples of an engine's own step may be fewer than asked")
@pytest.mark.parametrize("own", [0.003, 0.0007, 0.0301, 0.04, 0.05])
def test_samples_of_an_engines_own_step_are_as_often_as_asked(
    trial: Make, moving: Case, own: float
) -> None:
    """Where the step allows it; and at whole steps, as many as fit into the motion."""
    engine = trial(setting="shipped", own_step=own).engine
    found = stepping.sampled(moving, engine)
    assert found.interval <= max(moving.interval, own) * (1 + 1e-9)
    assert found.interval / own == pytest.approx(round(found.interval / own), rel=1e-9)
    assert moving.duration - found.interval < found.duration <= moving.duration * (1 + 1e-9)
    was = "own * max(1, int(case.interval / own))"
    rarer = otherwise(stepping, was, "own * (1 + int(case.interval / own))").sampled(moving, engine)
    assert rarer.interval > max(moving.interval, own) or own >= 0.04  # one a sample at least


def shown(trial: Trial, module: Any = showing) -> str:
    return module.script(trial.case, trial.engine)


@pytest.mark.mutant("the shown file has twice the step")
def test_a_shown_file_has_the_judged_step(trial: Make, monkeypatch: pytest.MonkeyPatch) -> None:
    made = trial()

    def told(*given: Any, title: str, duration: float) -> str:
        return f"{duration:g} s by {given[3]:g} s of {title}"

    monkeypatch.setattr(type(made.engine), "script", told)
    assert shown(made) == f"{made.case.duration:g} s by 0.001 s of moving: {made.case.title}"
    was = "step, duration = judged_step(case, engine)"
    twice = otherwise(showing, was, was.replace("judged", "2 * judged"))
    assert " by 0.002 s" in shown(made, twice)


def told_by(trial: Trial, error: float, held: Convergence) -> str:
    """Which ladder is asked for a cause, of a row that allows as much as the case."""
    following = Convergence(FALLS, {}, None)
    told = comparing._telling(trial, "ball.x", error, held, following)
    return "held" if told is held else "following"


@pytest.mark.mutant("a model is blamed for the numbers of a ladder's coarsest step")
@pytest.mark.parametrize(("verdict", "asked"), [(FALLS, "following"), (ANOTHER, "held")])
def test_a_model_whose_error_falls_where_its_numbers_follow_is_not_blamed(
    trial: Make, moving: Case, verdict: str, asked: str
) -> None:
    one, following = trial(moving), Convergence(verdict, {}, None)
    model = Convergence(ANOTHER, {}, None, limit=3.76, uncertainty=0.05)
    told = comparing._telling(one, "ball.x", 5.53, model, following)
    assert told is (following if asked == "following" else model)


@pytest.mark.mutant("the step is to blame, and it is small enough already")
def test_a_held_ladder_that_is_within_where_the_row_is_not_is_not_asked(
    trial: Make, moving: Case
) -> None:
    """Its numbers, or its start, are another at the judged step: what it says is of these."""
    one = trial(moving)
    allowed = one.allowed("ball.x")
    assert allowed
    step = one.step
    within = Convergence(WITHIN, {step: 0.1 * allowed, 2 * step: 0.2 * allowed}, 2 * step)
    finer = Convergence(WITHIN, {step / 2: 0.1 * allowed, step: 3 * allowed}, step / 2)
    assert told_by(one, 3 * allowed, finer) == "held"
    assert told_by(one, 3 * allowed, within) == "following"
    assert told_by(one, 0.5 * allowed, within) == "held"
