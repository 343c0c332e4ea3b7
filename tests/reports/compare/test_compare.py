"""Verdicts of trials whose errors are known in advance, and what their rows say."""

import math
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
import pytest
from given.command.lines import row as typed_row
from given.command.lines import said

from textmech.cases.case import Case, Deviation
from textmech.cases.scene import (
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    GroundPoint,
    Scene,
    planar_joint,
)
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Trajectory
from textmech.reports.compare.judge import metric
from textmech.reports.compare.judge.compare import Outcome, compare, crashed
from textmech.reports.compare.judge.convergence import Convergence
from textmech.reports.compare.judge.metric import error
from textmech.reports.compare.judge.verdict import verdict
from textmech.reports.compare.trial.audit import expected
from textmech.reports.compare.trial.trial import Trial, ways
from textmech.reports.search.causes.cause_rows import NONE, NOTHING
from textmech.reports.search.causes.explained import with_causes
from textmech.reports.tables.row import (
    AGREES,
    ANOTHER,
    BEYOND,
    CHANGED,
    DEVIATES,
    DIVERGED,
    FAILS,
    TEXTBOOK,
    UNSEARCHED,
    WITHIN,
    Cause,
    Comparison,
)

# Verdicts of trials whose errors are known in advance.

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


# Verdicts asked by themselves: no number, one end of an interval, a limit nobody is sure of.

AS_SHIPPED = {"setting": "shipped", "own_step": 1e-3}
SETTLED = Convergence(TEXTBOOK, {1e-3: 1.0}, None)


@pytest.mark.parametrize(("setting", "word"), [({}, FAILS), (AS_SHIPPED, BEYOND)])
@pytest.mark.parametrize("bars", [{}, {"reach": {"mujoco": {"ball.x": 1e-3}}}])
def test_what_is_no_number_never_agrees(
    trial: Make, moving: Case, setting: dict[str, Any], word: str, bars: dict[str, Any]
) -> None:
    made = trial(case=replace(moving, **bars), **setting)
    assert verdict(made, "ball.x", math.nan, SETTLED, "")[0] == word


@pytest.mark.parametrize(("setting", "word"), [({}, FAILS), (AS_SHIPPED, DIVERGED)])
def test_an_engine_that_answers_with_no_number_has_diverged(
    trial: Make, setting: dict[str, Any], word: str
) -> None:
    rows = compare(trial(model=math.nan, **setting)).rows
    assert next(row for row in rows if row.quantity == "ball.x").verdict == word


@pytest.mark.parametrize("name", ["ball.x", "ball.speed", "energy.total", "momentum.angular"])
def test_what_is_observed_of_no_number_is_none(moving: Case, name: str) -> None:
    ball = np.full((3, 6), np.nan)
    found = observe(moving.scene, Trajectory(np.arange(3.0), {"ball": ball}, {}), name)
    assert np.all(np.isnan(found))


@pytest.mark.parametrize(
    ("largest", "word"),
    [(1e-2, FAILS), (2e-2, DEVIATES), (4e-2, DEVIATES), (5e-2, FAILS), (math.nan, FAILS)],
)
def test_an_interval_has_two_ends(trial: Make, moving: Case, largest: float, word: str) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("other law", by=(2e-2, 4e-2))}}
    made = trial(case=replace(moving, deviates=declared), **AS_SHIPPED)
    assert verdict(made, "ball.x", largest, SETTLED, "")[0] == word


@pytest.mark.parametrize(
    ("uncertainty", "word"), [(1e-4, DEVIATES), (1.9e-3, DEVIATES), (2.1e-3, FAILS), (None, FAILS)]
)
def test_a_declared_limit_must_be_certain(
    trial: Make, moving: Case, uncertainty: float | None, word: str
) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2e-2)}}
    made = trial(case=replace(moving, deviates=declared), **AS_SHIPPED)
    found = replace(SETTLED, verdict=ANOTHER, limit=2e-2, uncertainty=uncertainty)
    assert verdict(made, "ball.x", 2e-2, found, "")[0] == word


def test_a_declared_limit_on_a_ladder_that_did_not_settle_is_gone(
    trial: Make, moving: Case
) -> None:
    declared = {"mujoco.shipped": {"ball.x": Deviation("soft", limit=2e-2)}}
    made = trial(case=replace(moving, deviates=declared), **AS_SHIPPED)
    found = replace(SETTLED, limit=2e-2, uncertainty=1e-6)
    assert verdict(made, "ball.x", 2e-2, found, "")[0] == FAILS


def test_the_size_of_an_error_typed() -> None:
    found = metric.error(np.array([1.0, 5.0, 2.0, 2.0]), np.array([1.0, 2.0, -2.0, 3.0]))
    assert found.largest == 4.0
    assert found.rms == pytest.approx(math.sqrt((9 + 16 + 1) / 4))
    assert found.final == 1.0
    assert found.at == 2


@pytest.mark.parametrize(
    ("number", "floor", "told"),
    [
        (3.47e-10, 2e-12, 3.5e-10),
        (3.47e-10, 1e-12, 3.47e-10),
        (4.9e-12, 2e-12, 0.0),
        (0.123456, 1e-12, 0.123456),
        (math.inf, 1e-12, math.inf),
        (0.3, 0.0, 0.3),
    ],
)
def test_digits_below_the_floor_are_not_told(number: float, floor: float, told: float) -> None:
    assert metric.round_to_floor(number, floor) == pytest.approx(told, rel=1e-9)


def test_an_uncertainty_is_never_told_as_none() -> None:
    assert metric.round_up_to_floor(1e-15, 2e-12) == pytest.approx(1e-11)


# When an error is largest, and that an instant is named as one and is no model's.


@dataclass(frozen=True)
class Off:
    """An engine that is off by so much at these samples, at any step."""

    engine: Any
    by: dict[int, float] = field(default_factory=dict)

    def __getattr__(self, name: str) -> Any:
        if name.startswith("__"):
            raise AttributeError(name)
        return getattr(self.engine, name)

    def run(self, *given: Any, **more: Any) -> Trajectory:
        found = self.engine.run(*given, **more)
        for sample, by in self.by.items():
            found.states["ball"][sample, 0] += by
        return found


def judged(made: Trial, by: dict[int, float]) -> Any:
    trial = replace(made, engine=Off(made.engine, by))
    return next(row for row in compare(trial).rows if row.quantity == "ball.x")


def test_a_row_tells_when_the_error_is_largest(trial: Make) -> None:
    found = judged(trial(rate=0.0, **AS_SHIPPED), {10: 0.3})
    assert (found.verdict, found.when) == (BEYOND, pytest.approx(0.4))
    assert judged(trial(rate=15.0, **AS_SHIPPED), {}).when == 1.0  # it grows to the end
    assert judged(trial(rate=0.0, **AS_SHIPPED), {}).when is None  # there is none


def test_the_first_of_equal_errors_is_told() -> None:
    """Which of them is the largest by its last bit, another machine would say otherwise."""
    wanted = np.zeros(6)
    assert error(np.array([0.1, 1.0, 1.0 + 1e-15, 0.9995, 1.0, 0.2]), wanted).at == 1


def test_the_first_sample_is_named_and_no_model(trial: Make) -> None:
    found = judged(trial(rate=1.0, **AS_SHIPPED), {0: 98.1})
    assert (found.verdict, found.when) == (BEYOND, 0.0)
    assert found.because == "the first sample; elsewhere at most 0.001"


def test_an_error_that_lasts_is_not_the_first_samples(trial: Make) -> None:
    found = judged(trial(rate=0.0, **AS_SHIPPED), dict.fromkeys(range(26), 0.5))
    assert found.when == 0.0
    assert found.because == "does not vanish with the step: 0.5 m stay"


def test_the_first_steps_are_the_start_too(trial: Make) -> None:
    """With steps as large as the samples a contact that has to close takes several of them."""
    coarse = {"setting": "shipped", "own_step": 0.04}
    found = judged(trial(rate=0.0, **coarse), {0: 98.1, 1: 98.1, 2: 60.0})
    assert found.because == "the first sample; elsewhere at most 0"
    found = judged(trial(rate=0.0, **coarse), {1: 98.1, 2: 60.0})
    assert found.because == "beside the start; elsewhere at most 0"
    found = judged(trial(rate=0.0, **coarse), {1: 98.1, 4: 60.0})
    assert found.because.startswith("does not vanish with the step")


def test_what_is_beside_an_event_is_named_after_it(trial: Make, stopping: Case) -> None:
    made = trial(case=stopping, stops=(0.3, 0.7), rate=0.0, **AS_SHIPPED)
    at = replace(made, reference=replace(made.reference, switches=np.array([0.401])))
    found = judged(at, {10: 0.3})  # 0.4 s: one step before
    assert found.because == "beside a switch at 0.401 s; elsewhere at most 0"
    named = replace(made, reference=replace(made.reference, switches=np.array([0.3, 0.5, 0.7])))
    far = judged(named, {10: 0.3})  # 100 steps away from all
    assert far.because.startswith("does not vanish with the step")


def test_the_name_is_the_events(trial: Make, stopping: Case) -> None:
    case = replace(stopping, samples=11)  # every 0.1 s: one of them on the stop at 0.3
    found = judged(trial(case=case, stops=(0.3, 0.7), rate=0.0, **AS_SHIPPED), {3: 0.3})
    assert found.because == "beside stops at 0.3 s; elsewhere at most 0"


def test_an_error_elsewhere_has_its_own_cause(trial: Make) -> None:
    found = judged(trial(rate=20.0, **AS_SHIPPED), {0: 98.1})
    words = "the first sample; elsewhere at most 0.02: the step: it falls with order 1.0"
    assert found.because.startswith(words)


def test_elsewhere_too_a_held_limit_beyond_the_error_is_no_cause(trial: Make) -> None:
    found = judged(trial(follows=True, model=1.2e-2), {0: 98.1})
    words = "the first sample; elsewhere at most 0.013: the step: it falls with order 1.0"
    assert words in found.because


# The audit: whether an engine has the numbers of the scene.


@pytest.mark.mutant("an engine with {number} kg for 2 kg")
@pytest.mark.parametrize("number", [2.1, 2.0 + 1e-11, float("nan")])
def test_the_audit_sees_other_physics(trial: Make, number: float) -> None:
    assert row(compare(trial()), "audit").verdict == AGREES
    found = row(compare(trial(numbers={"ball.mass": number})), "audit")
    assert found.verdict == FAILS
    assert "ball.mass" in found.because


@pytest.mark.parametrize("late", [-9.81, 0.0, 1e300])
def test_a_number_that_is_none_stays_the_worst(trial: Make, late: float) -> None:
    """What is read after it, good or bad, does not take its place."""
    numbers = {"ball.mass": 2.1, "gravity.x": float("nan"), "gravity.y": late}
    found = row(compare(trial(numbers=numbers)), "audit")
    assert (found.verdict, found.error) == (FAILS, np.inf)
    assert "gravity.x is nan" in found.because


def test_a_small_number_is_compared_with_itself(trial: Make, moving: Case) -> None:
    """5 % off a nanogram is 5 %, whatever the scale of the rest."""
    light = replace(moving.scene.bodies["ball"], mass=1e-12)
    case = replace(moving, scene=replace(moving.scene, bodies={"ball": light}))
    found = row(compare(trial(case=case, numbers={"ball.mass": 1.05e-12})), "audit")
    assert (found.verdict, found.error) == (FAILS, pytest.approx(0.05))


def test_rounding_is_no_number_of_the_audit(trial: Make) -> None:
    """The last bit of a product is another one on another machine."""
    found = row(compare(trial(numbers={"ball.mass": 2.0 + 4e-16})), "audit")
    assert (found.verdict, found.error, found.because) == (AGREES, 0.0, "1 numbers read back")


def test_the_audit_reads_dry_friction_back() -> None:
    friction = DryFriction(static=Bounds(6.0, 7.0), kinetic=Bounds(3.0, 4.0))
    box = Body("box", "particle", 1.0, (), {"center": (0.0, 0.0)})
    rail = planar_joint("rail", "slide", Anchor("ground", "O"), Anchor("box", "center"))
    scene = Scene(
        (0.0, 0.0),
        {"O": GroundPoint((0.0, 0.0))},
        {"box": box},
        {"rail": replace(rail, dry_friction=friction)},
        {"touch": Contact("touch", Anchor("box", "center"), 0.5, 0.4)},
        {},
    )
    start = Trajectory(np.zeros(1), {"box": np.zeros((1, 6))}, {})
    numbers = expected(scene, start)
    assert (numbers["rail.friction_forward"], numbers["rail.friction_backward"]) == (3.0, 4.0)
    assert numbers["touch.friction"] == 0.4


# The last column: an instant and what is declared stay, and the causes follow.

OFF = typed_row(
    ratio=9.0, case="b", quantity="x", error=9.0, allowed=1.0, because="the ladder's words"
)
CAUSE = Cause("b", "mujoco", "shipped", "x", 9.0, 1.0, "RK4", "{}", 2e-3, 0.5, 4.0, "")
STEP = replace(CAUSE, cure="RK4 + step", step=5e-4, cost=16.0)
NAME = ("b", "mujoco", "shipped", "x")


def because(*causes: Cause, row: Comparison = OFF, moment: str = "") -> str:
    (found,) = with_causes([row], causes, {NAME: moment} if moment else {})
    return found.because


@pytest.mark.parametrize(
    ("causes", "words"),
    [
        ((CAUSE,), "cured by RK4 (×4 the cost)"),
        ((CAUSE, STEP), "cured by RK4 (×4 the cost) or RK4 + step 0.0005 s (×16 the cost)"),
        ((CAUSE,) * 5, "cured by " + "RK4 (×4 the cost) or " * 3 + "2 more"),
        ((replace(CAUSE, cure="our law", cost=None),), "cured by our law"),
        ((replace(CAUSE, cure=NONE),), "the ladder's words; none of its options tried cures it"),
        ((replace(CAUSE, cure=NOTHING),), f"the ladder's words; {NOTHING}"),
        ((replace(CAUSE, cure=UNSEARCHED),), "the ladder's words"),
        ((), "the ladder's words"),
    ],
)
def test_causes_in_words(causes: tuple[Cause, ...], words: str) -> None:
    assert because(*causes) == words


def test_an_instant_is_told_before_its_cause() -> None:
    told = because(CAUSE, moment="the first sample; elsewhere at most 0.3")
    assert told == "the first sample; elsewhere at most 0.3; cured by RK4 (×4 the cost)"


def test_what_is_declared_stays() -> None:
    row = replace(OFF, verdict=DEVIATES, because="its model")
    assert because(CAUSE, row=row) == "its model; cured by RK4 (×4 the cost)"
    none = because(replace(CAUSE, cure=NONE), row=row)
    assert none == "its model; none of its options tried cures it"


@pytest.mark.parametrize("other", [{"realised": "law"}, {"setting": "tuned"}, {"quantity": "y"}])
def test_other_rows_stay_as_they_are(other: dict[str, str]) -> None:
    row = replace(OFF, **other)  # type: ignore[arg-type]
    assert because(CAUSE, row=row) == row.because
