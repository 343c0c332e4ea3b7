"""Verdicts of trials whose errors are known in advance."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from textmech.cases.case import Case, Deviation, Event
from textmech.cases.scene import (
    Anchor,
    Body,
    Bounds,
    Contact,
    DryFriction,
    GroundPoint,
    Joint,
    Scene,
)
from textmech.cases.trajectory import Trajectory
from textmech.reports.events.times import never
from textmech.reports.judge.compare import Outcome, compare, crashed
from textmech.reports.judge.convergence import INSTANTS
from textmech.reports.row import AGREES, BEYOND, CHANGED, DEVIATES, DIVERGED, FAILS
from textmech.reports.trial.audit import expected
from textmech.reports.trial.trial import Trial, ways

Make = Callable[..., Trial]
STOPS = (0.3, 0.7)  # s: the reference's


def row(outcome: Outcome, quantity: str = "ball.x") -> Any:
    return next(row for row in outcome.rows if row.quantity == quantity)


def test_within_the_tolerance_agrees(trial: Make) -> None:
    found = row(compare(trial(rate=1.0)))
    assert found.verdict == AGREES
    assert found.largest == pytest.approx(1e-3)
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
    assert row(compare(made)).verdict.startswith(CHANGED)


def test_an_unknown_tolerance_fails_and_says_what_was_measured(trial: Make, moving: Case) -> None:
    case = replace(moving, allow={"ball.x": None})
    found = row(compare(trial(case=case)))
    assert found.verdict == FAILS
    assert "0.001 was measured" in found.because


def test_a_refusal_is_a_row_for_each_quantity(trial: Make) -> None:
    outcome = compare(trial(refusal="engine: it has no such thing"))
    assert [r.verdict for r in outcome.rows] == ["refused: engine: it has no such thing"]


def test_a_withheld_quantity_says_why_and_the_others_are_judged(trial: Make, moving: Case) -> None:
    case = replace(moving, allow={"ball.x": 1e-2, "ball.vy": 1e-2})
    outcome = compare(trial(case=case))
    assert row(outcome, "ball.vy").verdict == "refused: engine: it is blind"
    assert row(outcome).verdict == AGREES


def test_a_diverged_run_says_so_and_only_tuned_fails(trial: Make) -> None:
    assert row(compare(trial(stable=1e-4))).verdict == FAILS
    shipped = row(compare(trial(stable=1e-4, setting="shipped", own_step=1e-3)))
    assert (shipped.verdict, shipped.because) == (DIVERGED, "too large a step")


def test_coarse_rungs_that_diverge_are_left_out(trial: Make) -> None:
    outcome = compare(trial(stable=4.1e-3, order=2))
    assert row(outcome).verdict == AGREES
    assert outcome.rungs[0].steps == "0.001 0.002 0.004"


def test_a_runaway_is_no_motion(trial: Make) -> None:
    shipped = row(compare(trial(model=1e8, setting="shipped", own_step=1e-3)))
    assert shipped.verdict == DIVERGED


def test_both_ladders_only_where_a_number_follows_the_step(trial: Make) -> None:
    assert {r.ladder for r in compare(trial()).rungs} == {"held"}
    both = compare(trial(follows=True, model=1e-3)).rungs
    assert {r.ladder: r.verdict for r in both} == {
        "following": "converges to the textbook",
        "held": "converges to another value",
    }


@pytest.mark.parametrize("number", [2.1, 2.0 + 1e-11, float("nan")])
def test_the_audit_sees_other_physics(trial: Make, number: float) -> None:
    assert row(compare(trial()), "audit").verdict == AGREES
    found = row(compare(trial(numbers={"ball.mass": number})), "audit")
    assert found.verdict == FAILS
    assert "ball.mass" in found.because


def test_a_crash_fails_but_for_a_users_own_numbers(trial: Make) -> None:
    assert row(crashed(trial(), "the process died")).verdict == FAILS
    assert row(crashed(trial(setting="own"), "the process died")).verdict == "crashed"


def test_every_row_names_case_engine_and_version(trial: Make) -> None:
    for found in compare(trial()).rows:
        assert (found.case, found.engine, found.version) == ("moving", "mujoco", "4.0.0")


def stopped(trial: Make, case: Case, **properties: Any) -> Outcome:
    return compare(trial(case=case, **{"stops": STOPS, **properties}))


def test_times_of_events_are_compared_in_their_order(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, delay=0.5)
    found = row(outcome, "stops.time")
    assert (found.verdict, found.unit, found.step) == (AGREES, "s", 1e-3)
    assert found.largest == pytest.approx(0.5e-3, rel=1e-3)
    assert row(outcome, "stops.count").largest == 0
    assert [i.k for i in outcome.instants] == [1, 2]
    assert [i.time for i in outcome.instants] == pytest.approx([0.3005, 0.7005])
    assert [i.difference for i in outcome.instants] == pytest.approx([0.5e-3, 0.5e-3])


def test_times_have_errors_on_the_ladder_and_no_order(trial: Make, stopping: Case) -> None:
    (rungs,) = [r for r in stopped(trial, stopping, delay=0.5).rungs if r.quantity == "stops.time"]
    assert rungs.steps == "0.001 0.002 0.004 0.008"
    assert rungs.errors == "5.00e-04 1.00e-03 2.00e-03 4.00e-03"
    assert (rungs.order, rungs.limit, rungs.verdict) == (None, None, INSTANTS)
    assert rungs.usable_step == 4e-3


def test_times_above_the_tolerance_fail_or_are_beyond(trial: Make, stopping: Case) -> None:
    tuned = row(stopped(trial, stopping, delay=3), "stops.time")
    assert tuned.verdict == FAILS
    shipped = {"setting": "shipped", "own_step": 1e-3}
    found = row(stopped(trial, stopping, delay=3, **shipped), "stops.time")
    assert (found.verdict, found.because) == (
        BEYOND,
        "instants of events: within from h = 0.0005 s on",
    )


@pytest.mark.parametrize(("setting", "word"), [("tuned", FAILS), ("shipped", BEYOND)])
def test_another_count_is_its_own_row(trial: Make, stopping: Case, setting: str, word: str) -> None:
    own = None if setting == "tuned" else 1e-3
    more = stopped(trial, stopping, stops=(*STOPS, 0.95), setting=setting, own_step=own)
    found = row(more, "stops.count")
    assert (found.verdict, found.largest) == (word, 1)
    assert "reference 2, engine 3" in found.because
    assert row(more, "stops.time").verdict == AGREES  # the two that both have
    assert [i.difference is None for i in more.instants] == [False, False, True]
    assert "inf" in next(r for r in more.rungs if r.quantity == "stops.time").errors


def test_an_event_that_the_engine_never_has(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, stops=(9.0,))
    assert row(outcome, "stops.count").verdict == FAILS
    assert row(outcome, "stops.time").verdict == "refused: engine: it never happens there"


def test_a_declared_count_deviates_natively_and_is_not_a_laws(trial: Make, stopping: Case) -> None:
    declared = {"mujoco.tuned": {"stops.count": Deviation("it sticks", by=(1, 1))}}
    case = replace(stopping, deviates=declared)
    assert row(stopped(trial, case, stops=STOPS[:1]), "stops.count").verdict == DEVIATES
    ways = {"ways": ("native", "law"), "realised": "law"}
    assert row(stopped(trial, case, stops=STOPS[:1], **ways), "stops.count").verdict == FAILS


def test_without_a_record_events_are_refused(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, stops=())
    assert row(outcome, "stops.time").verdict.startswith("refused: adapter")
    assert row(outcome, "stops.count").verdict.startswith("refused: adapter")
    assert row(outcome).verdict == AGREES


def test_every_step_is_recorded_only_where_there_are_events(
    trial: Make, moving: Case, stopping: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    kind, asked = type(trial().engine), []
    run = kind.run

    def noted(*given: Any, record: bool = False, **more: Any) -> Trajectory:
        asked.append(record)
        return run(*given, record=record, **more)

    monkeypatch.setattr(kind, "run", noted)
    for case, wanted in ((moving, False), (stopping, True)):
        asked.clear()
        stopped(trial, case)
        assert set(asked) == {wanted}


def test_the_reach_of_a_law_or_driver_is_asked_of_its_row(trial: Make, moving: Case) -> None:
    for way in ("law", "driver"):
        case = replace(moving, reach={f"mujoco.{way}": {"ball.x": 1e-9}})
        made = trial(case=case, ways=("native", way), realised=way)
        assert row(compare(made)).verdict == FAILS


def test_beside_a_law_stands_a_native_row_or_its_refusal(trial: Make, moving: Case) -> None:
    law = trial(ways=("law",))
    assert [w.realised for w in ways(law.engine, moving.scene, law.start)] == ["native", "law"]
    native = row(compare(trial(ways=("law",))))
    assert native.verdict.startswith("refused: engine: it has nothing of its own")
    assert row(compare(trial(ways=("law",), realised="law"))).verdict == AGREES


def test_orders_are_taken_away_from_events(trial: Make, stopping: Case) -> None:
    made = trial(case=stopping, stops=STOPS)
    away = made.away(0.04)
    near = [t for t, is_away in zip(stopping.times, away, strict=True) if not is_away]
    assert near == pytest.approx([0.28, 0.32, 0.48, 0.52, 0.68, 0.72])
    assert np.all(trial().away(0.04))


def test_the_audit_reads_dry_friction_back() -> None:
    friction = DryFriction(static=Bounds(6.0, 7.0), kinetic=Bounds(3.0, 4.0))
    box = Body("box", "particle", 1.0, None, {"center": (0.0, 0.0)})
    rail = Joint("rail", "slide", Anchor("ground", "O"), Anchor("box", "center"))
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


def test_an_event_that_never_happens_is_a_mistake_of_the_case(trial: Make, stopping: Case) -> None:
    assert never(stopping, trial(case=stopping).reference) == []
    other = replace(stopping, events={"slips": Event("ball.vx", "falls to zero")})
    assert never(other, trial(case=stopping).reference) == []  # it also falls to zero
    other = replace(stopping, events={"slips": Event("ball.x", "leaves zero")})
    (mistake,) = never(other, trial(case=stopping).reference)
    assert "never happens" in str(mistake)
