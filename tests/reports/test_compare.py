"""Verdicts of trials whose errors are known in advance."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import pytest
from given.lines import said

from textmech.cases.case import Case, Deviation
from textmech.reports.compare.judge.compare import Outcome, compare, crashed
from textmech.reports.compare.trial.trial import Trial, ways
from textmech.reports.data.row import (
    AGREES,
    BEYOND,
    CHANGED,
    DEVIATES,
    DIVERGED,
    FAILS,
    TEXTBOOK,
    WITHIN,
)

Make = Callable[..., Trial]


def row(outcome: Outcome, quantity: str = "ball.x") -> Any:
    return next(row for row in outcome.rows if row.quantity == quantity)


def test_within_the_tolerance_agrees(trial: Make) -> None:
    found = row(compare(trial(rate=1.0)))
    assert found.verdict == AGREES
    assert found.error == pytest.approx(1e-3)
    assert found.ratio == pytest.approx(0.1)


def test_tuned_above_the_tolerance_fails_and_shipped_is_beyond(trial: Make) -> None:
    tuned = row(compare(trial(rate=20.0)))
    assert tuned.verdict == FAILS
    assert "above allow" in tuned.because
    shipped = row(compare(trial(rate=15.0, setting="shipped", own_step=1e-3)))
    assert shipped.verdict == BEYOND
    assert "the step: it falls with order 1.0, within from h = 0.0005 s on" in shipped.because


def test_tuned_above_its_reach_fails(trial: Make, moving: Case) -> None:
    case = replace(moving, reach={"mujoco": {"ball.x": 5e-4}})
    found = row(compare(trial(case=case, rate=1.0)))
    assert found.verdict == FAILS
    assert "above reach 0.0005" in found.because


def test_a_limit_above_its_reach_fails(trial: Make, moving: Case) -> None:
    case = replace(moving, reach={"mujoco.limit": {"ball.x": 1e-9}})
    assert row(compare(trial(case=case))).verdict == AGREES
    found = row(compare(trial(case=case, model=1e-6)))
    assert found.verdict == FAILS
    assert "limit" in found.because


def test_a_limit_is_asked_of_the_numbers_that_follow_the_step(trial: Make, moving: Case) -> None:
    """With the numbers of the coarsest step the model is 8e-3 off, however small the step."""
    case = replace(moving, reach={"mujoco.limit": {"ball.x": 1e-9}})
    assert row(compare(trial(case=case, follows=True, model=1e-3))).verdict == AGREES


def test_the_reach_of_a_law_is_not_asked_of_the_native_row(trial: Make, moving: Case) -> None:
    case = replace(moving, reach={"mujoco.law": {"ball.x": 1e-9}})
    assert row(compare(trial(case=case))).verdict == AGREES


@pytest.mark.parametrize(
    ("model", "word"), [(2.0e-2, DEVIATES), (2.4e-2, DEVIATES), (2.6e-2, FAILS), (0.0, FAILS)]
)
def test_a_declared_deviation_must_stay_what_it_is(
    trial: Make, moving: Case, model: float, word: str
) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2.0e-2)}}
    case = replace(moving, deviates=declared)
    found = row(compare(trial(case=case, setting="shipped", own_step=1e-3, model=model)))
    assert found.verdict == word


def test_an_interval_is_held_at_the_judged_step(trial: Make, moving: Case) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("other law", by=(2e-2, 4e-2))}}
    case = replace(moving, deviates=declared)
    shipped = {"setting": "shipped", "own_step": 1e-3}
    assert row(compare(trial(case=case, model=3e-2, **shipped))).verdict == DEVIATES
    assert row(compare(trial(case=case, model=5e-2, **shipped))).verdict == FAILS


def test_another_version_may_change_a_deviation(trial: Make, moving: Case) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2.0e-2)}}
    made = trial(
        case=replace(moving, deviates=declared), setting="shipped", own_step=1e-3, version="9.0"
    )
    changed = row(compare(made))
    assert (changed.verdict, changed.because[:6]) == (CHANGED, "since ")


def test_an_unknown_tolerance_fails_and_says_what_was_measured(trial: Make, moving: Case) -> None:
    case = replace(moving, allow={"ball.x": None})
    found = row(compare(trial(case=case)))
    assert found.verdict == FAILS
    assert "0.001 was measured" in found.because


def test_a_refusal_is_a_row_for_each_quantity(trial: Make) -> None:
    outcome = compare(trial(refusal="engine: it has no such thing"))
    assert [said(r) for r in outcome.rows] == ["refused: engine: it has no such thing"]


def test_a_withheld_quantity_says_why_and_the_others_are_judged(trial: Make, moving: Case) -> None:
    case = replace(moving, allow={"ball.x": 1e-2, "ball.vy": 1e-2})
    outcome = compare(trial(case=case))
    assert said(row(outcome, "ball.vy")) == "refused: engine: it is blind"
    assert row(outcome).verdict == AGREES


def test_a_diverged_run_says_so_and_only_tuned_fails(trial: Make) -> None:
    assert row(compare(trial(stable=1e-4))).verdict == FAILS
    shipped = row(compare(trial(stable=1e-4, setting="shipped", own_step=1e-3)))
    assert (shipped.verdict, shipped.because) == (DIVERGED, "too large a step")


def climbed(outcome: Outcome) -> list[float]:
    """The steps of its one ladder."""
    return [one.step for one in outcome.steps]


def test_coarse_rungs_that_diverge_are_left_out(trial: Make) -> None:
    outcome = compare(trial(stable=4.1e-3, order=2))
    assert row(outcome).verdict == AGREES
    assert climbed(outcome) == [1e-3, 2e-3, 4e-3]


def test_nothing_coarser_than_a_diverged_rung_is_on_a_ladder(trial: Make) -> None:
    """8e-3 runs by luck: from 4e-3 on nothing can be told from it."""
    outcome = compare(trial(lost=(4e-3,), order=2))
    assert row(outcome).verdict == AGREES
    assert climbed(outcome) == [1e-3, 2e-3]


@pytest.mark.parametrize(("lost", "steps"), [(1e-3 / 4, [1e-3 / 16, 1e-3 / 8]), (1e-3 / 16, [])])
def test_a_finer_step_that_diverges_leaves_the_judged_run(
    trial: Make, lost: float, steps: list[float]
) -> None:
    shipped = {"setting": "shipped", "own_step": 1e-3}
    outcome = compare(trial(lost=(lost,), **shipped))
    assert (row(outcome).verdict, row(outcome).step) == (AGREES, 1e-3)
    above = row(compare(trial(lost=(lost,), rate=15.0, **shipped)))
    assert above.verdict == BEYOND
    assert f"a smaller step diverges (h = {lost:.3g} s: too large a step)" in above.because
    assert climbed(outcome) == steps


def test_the_judged_step_that_diverges_is_told_and_no_ladder_above(trial: Make) -> None:
    shipped = {"setting": "shipped", "own_step": 1e-3}
    found = row(compare(trial(lost=(1e-3,), **shipped)))
    assert (found.verdict, found.because) == (DIVERGED, "too large a step")


def test_what_a_way_leaves_out_is_named_where_its_model_differs(trial: Make) -> None:
    one = {"simplified": "one number for friction: rail, where there are several"}
    model = row(compare(trial(rate=0.0, model=0.02, **one)))
    assert model.because.endswith(
        "does not vanish with the step: 0.02 m stay; " + one["simplified"]
    )
    step = row(compare(trial(rate=20.0, **one)))
    assert "friction" not in step.because


def test_a_runaway_is_no_motion(trial: Make) -> None:
    shipped = row(compare(trial(model=1e8, setting="shipped", own_step=1e-3)))
    assert shipped.verdict == DIVERGED


def test_both_ladders_only_where_a_number_follows_the_step(trial: Make) -> None:
    assert {r.ladder for r in compare(trial()).rungs} == {"held"}
    both = compare(trial(follows=True, model=1e-3)).rungs
    assert {r.ladder: r.verdict for r in both} == {
        "following": TEXTBOOK,
        "held": WITHIN,
    }


def test_a_held_limit_that_is_further_off_than_the_run_is_no_cause(trial: Make) -> None:
    """The model of the coarsest step's numbers is 0.096 off, and the run is 0.013."""
    found = row(compare(trial(follows=True, model=1.2e-2)))
    assert found.error == pytest.approx(1.3e-2, rel=1e-9)
    assert "the step: it falls with order 1.0" in found.because
    held = row(compare(trial(model=1.2e-2)))
    assert "does not vanish with the step: 0.012" in held.because


def test_one_ladder_where_the_numbers_that_follow_make_no_difference(trial: Make) -> None:
    made = trial(follows=True)
    alike = replace(made, way=replace(made.plan, alike=True))
    assert {r.ladder for r in compare(alike).rungs} == {"following"}
    assert row(compare(alike)).verdict == AGREES


def test_a_crash_fails_but_for_a_users_own_numbers(trial: Make) -> None:
    assert row(crashed(trial(), "the process died")).verdict == FAILS
    assert row(crashed(trial(setting="own"), "the process died")).verdict == "crashed"


def test_every_row_names_case_engine_and_version(trial: Make) -> None:
    for found in compare(trial()).rows:
        assert (found.case, found.engine, found.version) == ("moving", "mujoco", "4.0.0")


def test_the_reach_of_a_law_or_driver_is_asked_of_its_row(trial: Make, moving: Case) -> None:
    for way in ("law", "driver"):
        case = replace(moving, reach={f"mujoco.{way}": {"ball.x": 1e-9}})
        made = trial(case=case, ways=("native", way), realised=way)
        assert row(compare(made)).verdict == FAILS


def test_beside_a_law_stands_a_native_row_or_its_refusal(trial: Make, moving: Case) -> None:
    law = trial(ways=("law",))
    assert [w.realised for w in ways(law.engine, moving.scene, law.start)] == ["native", "law"]
    native = row(compare(trial(ways=("law",))))
    assert said(native).startswith("refused: engine: it has nothing of its own")
    assert row(compare(trial(ways=("law",), realised="law"))).verdict == AGREES
