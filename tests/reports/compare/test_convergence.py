"""Ladders: which steps are climbed, and order, limit and verdict of known expansions."""

import re
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.otherwise import otherwise
from given.scenes import cases_of

from textmech.cases.case import Case
from textmech.reports.compare.judge import compare as comparing
from textmech.reports.compare.judge import convergence
from textmech.reports.compare.judge.cause import cause
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.judge.convergence import Convergence, study
from textmech.reports.compare.trial import ladder as stepping
from textmech.reports.compare.trial.ladder import USUAL, judged_step, ladders
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.front.show import script as showing
from textmech.reports.tables import write
from textmech.reports.tables.row import (
    AGREES,
    ANOTHER,
    EXACT,
    FALLS,
    OF_A_LADDER,
    STAYS,
    TEXTBOOK,
    UNSETTLED,
    WITHIN,
)

# Ladders with known expansions: order, limit, verdict and usable step come out as put in.

T = np.linspace(0.0, 1.0, 26)
REFERENCE = np.sin(T)
STEPS = [1e-3 * 2**k for k in range(5)]


def ladder(*, p: int, c: float = 1.0, model: float = 0.0) -> dict[float, np.ndarray]:
    return {h: REFERENCE + model * T + c * T * (h**p + h ** (p + 1)) for h in STEPS}


def judge(rungs: dict[float, np.ndarray], *, p: int, allow: float = 1e-2) -> Convergence:
    return study(rungs, REFERENCE, exponents=(p, p + 1), allow=allow, floor=1e-13)


@pytest.mark.parametrize("p", [1, 2, 4])
def test_the_order_and_the_textbook_come_out(p: int) -> None:
    found = judge(ladder(p=p), p=p)
    assert found.verdict == TEXTBOOK
    assert found.order == pytest.approx(p, abs=0.05)
    assert found.limit is not None
    assert found.limit < 1e-11


def test_a_difference_of_the_model_is_told_from_the_step() -> None:
    found = judge(ladder(p=1, model=3e-3), p=1, allow=2e-3)
    assert found.verdict == ANOTHER
    assert found.limit == pytest.approx(3e-3, rel=1e-6)
    assert found.order == pytest.approx(1.0, abs=0.05)


@pytest.mark.parametrize(("model", "word"), [(3e-3, WITHIN), (9e-9, TEXTBOOK), (2e-5, WITHIN)])
def test_another_value_within_the_tolerance_is_told_as_that(model: float, word: str) -> None:
    """A millionth of what is allowed is of no use to anyone: that is the textbook's."""
    found = judge(ladder(p=1, model=model), p=1, allow=1e-2)
    assert found.verdict == word
    assert found.limit == pytest.approx(model, rel=1e-3)


def test_a_motion_at_the_rounding_floor_is_exact() -> None:
    assert judge(dict.fromkeys(STEPS, REFERENCE + 1e-14), p=1).verdict == EXACT


def test_noise_is_not_called_a_model() -> None:
    rng = np.random.default_rng(1)
    noisy = {h: REFERENCE + 1e-9 * rng.standard_normal(len(T)) for h in STEPS}
    found = judge(noisy, p=2)
    assert found.verdict != ANOTHER
    assert found.order is None


def test_the_wrong_exponents_do_not_settle_quietly() -> None:
    """Romberg with exponents 2, 3 on a method of order 1 must not promise its tiny limit."""
    found = judge(ladder(p=1), p=2)
    assert found.limit is not None
    assert found.limit > 1e-5


def test_an_order_is_never_printed_for_an_unsettled_ladder() -> None:
    wild = {h: REFERENCE + np.sin(1e4 * h) * T for h in STEPS}
    found = judge(wild, p=1)
    assert found.verdict == UNSETTLED
    assert found.order is None


def test_every_verdict_is_one_word_that_the_readme_explains() -> None:
    text = (write.HERE / "README.md").read_text(encoding="utf-8")
    legend = text.partition("what its errors in `steps.csv` say")[2].partition("\n#")[0]
    assert re.findall(r"^\| `(\w+)` \|", legend, re.MULTILINE) == list(OF_A_LADDER)


def test_two_rungs_are_no_ladder() -> None:
    short = {h: u for h, u in ladder(p=1).items() if h < 3e-3}
    assert judge(short, p=1).verdict == UNSETTLED


def test_an_uncertainty_near_the_tolerance_decides_nothing() -> None:
    found = judge(ladder(p=1), p=1, allow=1e-6)
    assert found.verdict == FALLS
    assert found.order == pytest.approx(1.0, abs=0.02)


def turning(*sizes: float) -> dict[float, np.ndarray]:
    """Errors of these sizes with both signs in turn: no limit settles."""
    signs = (1.0, -1.0, 1.0, -1.0, 1.0)
    rungs = zip(STEPS, signs, sizes, strict=True)
    return {h: REFERENCE + sign * size * T for h, sign, size in rungs}


def test_errors_that_fall_name_the_step_where_no_limit_settles() -> None:
    found = judge(turning(1.0, 2.1, 3.9, 8.0, 16.5), p=1)
    assert found.verdict == FALLS
    assert (found.order, found.order_low) == pytest.approx((1.07, 0.893), abs=0.01)
    found = judge(turning(1.0, 4.0, 3.0, 9.0, 8.0), p=1)
    assert (found.verdict, found.order) == (FALLS, None)


def test_errors_that_do_not_fall_are_not_the_steps() -> None:
    assert judge(turning(1.0, 1.4, 0.9, 1.5, 1.1), p=1).verdict == STAYS
    assert judge(turning(3.0, 1.0, 4.0, 2.0, 1.0), p=1).verdict == UNSETTLED


def test_the_usable_step_is_the_largest_from_which_on_all_are_within() -> None:
    found = judge(ladder(p=1), p=1, allow=3e-3)
    assert found.usable_step == pytest.approx(2e-3)
    lucky = ladder(p=1)
    lucky[STEPS[4]] = REFERENCE  # a coarse rung that happens to fit proves nothing
    assert judge(lucky, p=1, allow=3e-3).usable_step == pytest.approx(2e-3)


def test_no_usable_step_where_the_finest_is_not_within() -> None:
    assert judge(ladder(p=1), p=1, allow=1e-4).usable_step is None


def test_samples_beside_an_event_tell_no_order() -> None:
    late = {h: u + np.where(np.abs(T - 0.5) < 0.03, h**0.3, 0.0) for h, u in ladder(p=1).items()}
    assert judge(late, p=1).verdict != TEXTBOOK
    away = np.abs(T - 0.5) >= 0.03
    found = study(late, REFERENCE, exponents=(1, 2), allow=1e-2, floor=1e-13, away=away)
    assert found.verdict == TEXTBOOK
    assert found.order == pytest.approx(1.0, abs=0.05)
    assert found.usable_step is None  # but what is allowed holds at every sample


def test_too_few_samples_away_from_events_settle_nothing() -> None:
    away = T > 0.95
    found = study(ladder(p=1), REFERENCE, exponents=(1, 2), allow=1e-2, floor=1e-13, away=away)
    assert found.verdict == UNSETTLED


def test_a_finest_rung_that_is_no_number_leaves_no_usable_step() -> None:
    broken = ladder(p=1)
    broken[STEPS[0]] = REFERENCE * np.nan
    found = judge(broken, p=1)
    assert found.usable_step is None
    assert found.verdict == UNSETTLED


def test_coarse_rungs_that_are_the_same_to_the_last_bit_are_no_crash() -> None:
    """As those of what moves evenly until a step is fine enough for what comes then."""
    rungs = ladder(p=1)
    rungs[STEPS[-1]] = rungs[STEPS[-2]] = rungs[STEPS[-3]]
    assert judge(rungs, p=1).usable_step is not None


def test_what_finer_steps_have_exactly_is_the_step_s() -> None:
    """Off on coarse rungs, and exact from some step on: as of what begins and ends in one step."""
    rungs = {h: REFERENCE + (0.5 if h > 2e-3 else 0.0) * T for h in STEPS}
    found = judge(rungs, p=1)
    assert found.verdict == EXACT
    assert cause(found) == "the step: within from h = 0.002 s on"
    assert cause(replace(found, usable_step=None)) == "rounding"


@pytest.mark.mutant("orders of the coarsest rungs: of {named}")
@pytest.mark.parametrize(
    ("named", "was"),
    [
        ("differences", "if fine > floor and coarse][:LAST]"),
        ("sizes", "itertools.pairwise(self.sizes)][:LAST]"),
    ],
)
def test_orders_are_of_the_finest_rungs(named: str, was: str) -> None:
    """Of eight rungs the coarse ones are off by h⁴ too, which no fine one sees."""
    steps = [1e-3 * 2**k for k in range(8)]
    rungs = {h: REFERENCE + T * (h + 0.016 * (h / 0.016) ** 4) for h in steps}
    sizes = [float(np.max(np.abs(u - REFERENCE))) for u in rungs.values()]

    def order(module: Any = convergence) -> float | None:
        if named == "sizes":
            return module._Size(sizes).orders[0]
        return module.study(rungs, REFERENCE, exponents=(1, 4), allow=1e-2, floor=1e-15).order

    assert order() == pytest.approx(1.0, abs=0.05)
    coarsest = order(otherwise(convergence, was, was.replace("[:LAST]", "[-LAST:]")))
    assert coarsest is None or coarsest > 2.0


@pytest.mark.mutant("an error beside an event that no step changes, told as the step's")
def test_what_stays_beside_an_event_is_not_the_steps() -> None:
    """One sample just before a switch is 0.28 off at every step; the others are as they should."""
    rungs, away = ladder(p=2), np.ones(len(T), bool)
    for samples in rungs.values():
        samples[7] += 0.28
    away[7] = False
    exponents = (2, 3)
    found = study(rungs, REFERENCE, exponents=exponents, allow=1e-2, floor=1e-13, away=away)
    assert found.verdict == TEXTBOOK
    told = cause(found, simplified="one number for friction: pin")
    assert told == (
        "beside an event no step down to h = 0.001 s helps: 0.28 to 0.28 at every step tried; "
        "elsewhere the error falls with order 2.0; one number for friction: pin"
    )
    usable = replace(found, usable_step=1e-3)
    assert "one number" not in cause(usable, simplified="one number")
    unknown = cause(usable, finer="it explodes", simplified="one number")
    assert unknown.endswith("neither step nor model can be named; one number")


@pytest.mark.mutant("where an engine is late by a step less some, that some is its model")
def test_an_impact_that_is_seen_late_on_every_rung_is_no_model() -> None:
    """It is a little behind a whole step, of any of them: each is late by its step less as much."""
    early = STEPS[0] / 4
    rungs = {h: REFERENCE + np.where(T > 0.5, 2.0 * (h - early), 0.0) for h in STEPS}
    given: Any = {"exponents": (1, 2), "allow": 1e-4, "floor": 1e-13}
    assert study(rungs, REFERENCE, **given, behind=T > 0.5).verdict == FALLS
    blamed = study(rungs, REFERENCE, **given)
    assert (blamed.verdict, blamed.limit) == (ANOTHER, pytest.approx(2 * early))


@pytest.mark.mutant("the declared order is the ladder's, though it falls more slowly")
def test_what_falls_more_slowly_than_declared_has_no_limit_yet(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rungs = {h: REFERENCE + T * h**0.86 for h in STEPS}
    found = judge(rungs, p=4, allow=1e-5)
    assert found.verdict == FALLS
    assert found.limit is not None
    assert found.uncertainty is not None
    assert found.limit < 2 * found.uncertainty
    monkeypatch.setattr(convergence, "_slow_remainder", lambda *_: 0.0)
    assert judge(rungs, p=4, allow=1e-5).verdict == ANOTHER


@pytest.mark.mutant("what all coarse rungs damp away is the engine's model")
@pytest.mark.parametrize("finest", [0.328, 0.02])
def test_a_ladder_that_only_begins_to_resolve_blames_no_model(
    finest: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As a free body's nutation in an implicit integrator: the finer ones fall with order 1."""
    sizes = [finest, 0.361, 0.369, 0.372, 0.367]
    rungs = {h: REFERENCE + size * T for h, size in zip(STEPS, sizes, strict=True)}
    found = judge(rungs, p=1, allow=1e-2)
    assert found.verdict not in (TEXTBOOK, WITHIN, ANOTHER)
    if finest > 0.1:
        assert found.uncertainty == found.limit
        monkeypatch.setattr(convergence, "_growth", lambda *_: 0.0)
        assert judge(rungs, p=1, allow=1e-2).verdict == ANOTHER


def test_noise_beside_a_model_is_no_growth() -> None:
    rng = np.random.default_rng(3)
    for _ in range(20):
        noise = 1e-6 * rng.standard_normal((len(STEPS), len(T)))
        rungs = {h: REFERENCE + 3e-3 * T + each for h, each in zip(STEPS, noise, strict=True)}
        assert judge(rungs, p=1, allow=1e-3).verdict == ANOTHER


def test_what_stays_is_said_of_the_steps_that_were_tried() -> None:
    told = cause(judge(turning(1.0, 1.4, 0.9, 1.5, 1.1), p=1))
    assert told == "no step down to h = 0.001 s helps: 0.9 to 1.5 at every step tried"


def test_a_model_is_told_behind_an_event_too() -> None:
    found = study(
        {
            h: u + np.where(T > 0.5, h / 100, 0.0)
            for h, u in ladder(p=1, c=0.01, model=3e-3).items()
        },
        REFERENCE,
        exponents=(1, 2),
        allow=1e-3,
        floor=1e-13,
        behind=T > 0.5,
    )
    assert found.verdict == ANOTHER


def test_what_may_be_far_from_its_limit_is_not_the_textbooks_by_chance() -> None:
    """Romberg's limit is 0 here to 9e-6, and the true one 3.3e-4."""
    steps = [1e-4 * 2**k for k in range(6)]
    rungs = {h: REFERENCE + T * (h**0.86 - 3.343e-4) for h in steps}
    found = study(rungs, REFERENCE, exponents=(4, 5), allow=1e-4, floor=1e-13)
    assert found.verdict not in (TEXTBOOK, WITHIN, ANOTHER)


def test_without_exponents_no_limit_is_told() -> None:
    found = study(ladder(p=1), REFERENCE, exponents=(), allow=1e-2, floor=1e-13)
    assert (found.verdict, found.limit) == (FALLS, None)


@pytest.mark.mutant("three steps are enough for a verdict on sizes alone")
@pytest.mark.parametrize("sizes", [[1e-4, 2e-4, 4e-4], [1e-3, 1e-3, 1e-3]])
def test_three_steps_are_too_few_for_sizes_alone(sizes: list[float]) -> None:
    """Three orders need four; with four the same sizes have a verdict."""
    few = convergence._Size(sizes)
    assert (few.verdict, few.orders) == (UNSETTLED, convergence.NO_ORDER)
    more = convergence._Size([*sizes, sizes[-1] * sizes[-1] / sizes[-2]])
    assert more.verdict == (STAYS if sizes[0] == sizes[-1] else FALLS)


# Which steps are judged and climbed, whatever the case says of them.

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


def written(step: str) -> Case:
    return cases_of(TEXT + step)[0]


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
    trial: Make, step: str, mujoco: float, pymunk: float
) -> None:
    case = written(step)
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
