"""Verdicts about events: their times, their counts, and what lies beside them."""

from collections.abc import Callable
from dataclasses import replace
from math import inf
from typing import Any

import numpy as np
import pytest
from given.lines import said
from given.otherwise import otherwise

from textmech.cases.case import Case, Deviation, Event
from textmech.cases.trajectory import Trajectory
from textmech.reports.compare.events.times import never
from textmech.reports.compare.events.timing import Timing
from textmech.reports.compare.judge import compare as comparing
from textmech.reports.compare.judge.compare import Outcome, compare
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import AGREES, BEYOND, DEVIATES, FAILS, INSTANTS

Make = Callable[..., Trial]
STOPS = (0.3, 0.7)  # s: the reference's


def row(outcome: Outcome, quantity: str = "ball.x") -> Any:
    return next(row for row in outcome.rows if row.quantity == quantity)


def stopped(trial: Make, case: Case, **properties: Any) -> Outcome:
    return compare(trial(case=case, **{"stops": STOPS, **properties}))


def test_times_of_events_are_compared_in_their_order(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, delay=0.5)
    found = row(outcome, "stops.time")
    assert (found.verdict, found.unit, found.step) == (AGREES, "s", 1e-3)
    assert found.error == pytest.approx(0.5e-3, rel=1e-3)
    assert row(outcome, "stops.count").error == 0
    assert [i.k for i in outcome.instants] == [1, 2]
    assert [i.time for i in outcome.instants] == pytest.approx([0.3005, 0.7005])
    assert [i.difference for i in outcome.instants] == pytest.approx([0.5e-3, 0.5e-3])


def test_times_have_errors_on_the_ladder_and_no_order(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, delay=0.5)
    (rungs,) = [rungs for rungs in outcome.rungs if rungs.quantity == "stops.time"]
    steps = {one.step: one.error for one in outcome.steps if one.quantity == "stops.time"}
    assert steps == pytest.approx({h: 0.5 * h for h in (1e-3, 2e-3, 4e-3, 8e-3)}, rel=1e-3)
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


def test_a_late_event_that_the_ladder_does_not_look_at_is_named(
    trial: Make, stopping: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Timing, "surely", lambda self, event, step: np.arange(1))  # then too short
    monkeypatch.setattr(Event, "crosses", property(lambda self: True))
    late = {"stops": (STOPS[0], STOPS[1] + 0.05), "setting": "shipped", "own_step": 1e-3}
    found = row(stopped(trial, stopping, **late), "stops.time")
    assert (found.verdict, found.error) == (BEYOND, pytest.approx(0.05, rel=1e-3))
    assert found.because == (
        "number 2, of which the largest step cannot be sure; before it: "
        "instants of events: within from h = 0.001 s on"
    )


@pytest.mark.parametrize(("setting", "word"), [("tuned", FAILS), ("shipped", BEYOND)])
def test_another_count_is_its_own_row(trial: Make, stopping: Case, setting: str, word: str) -> None:
    own = None if setting == "tuned" else 1e-3
    more = stopped(trial, stopping, stops=(*STOPS, 0.95), setting=setting, own_step=own)
    found = row(more, "stops.count")
    assert (found.verdict, found.error) == (word, 1)
    assert "reference 2, engine 3" in found.because
    assert row(more, "stops.time").verdict == AGREES  # the two that both have
    assert [i.difference is None for i in more.instants] == [False, False, True]
    assert inf in [one.error for one in more.steps if one.quantity == "stops.time"]


def test_an_event_that_the_engine_never_has(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, stops=(9.0,))
    assert row(outcome, "stops.count").verdict == FAILS
    never = "refused: engine: the event never happens in its motion"
    assert said(row(outcome, "stops.time")) == never


def test_a_declared_count_deviates_natively_and_is_not_a_laws(trial: Make, stopping: Case) -> None:
    declared = {"mujoco.tuned": {"stops.count": Deviation("it sticks", by=(1, 1))}}
    case = replace(stopping, deviates=declared)
    assert row(stopped(trial, case, stops=STOPS[:1]), "stops.count").verdict == DEVIATES
    ways = {"ways": ("native", "law"), "realised": "law"}
    assert row(stopped(trial, case, stops=STOPS[:1], **ways), "stops.count").verdict == FAILS


def test_without_a_record_events_are_refused(trial: Make, stopping: Case) -> None:
    outcome = stopped(trial, stopping, stops=())
    assert said(row(outcome, "stops.time")).startswith("refused: adapter")
    assert said(row(outcome, "stops.count")).startswith("refused: adapter")
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


def test_orders_are_taken_away_from_events(trial: Make, stopping: Case) -> None:
    made = trial(case=stopping, stops=STOPS)
    away = made.away(0.04)
    near = [t for t, is_away in zip(stopping.times, away, strict=True) if not is_away]
    assert near == pytest.approx([0.28, 0.32, 0.48, 0.52, 0.68, 0.72])
    assert np.all(trial().away(0.04))


def test_an_event_that_never_happens_is_a_mistake_of_the_case(trial: Make, stopping: Case) -> None:
    assert never(stopping, trial(case=stopping).reference) == []
    other = replace(stopping, events={"slips": Event("ball.vx", "falls to zero")})
    assert never(other, trial(case=stopping).reference) == []  # it also falls to zero
    other = replace(stopping, events={"slips": Event("ball.x", "leaves zero")})
    (mistake,) = never(other, trial(case=stopping).reference)
    assert "never happens" in str(mistake)


def order(made: Trial, module: Any = comparing) -> float | None:
    found = module.compare(made)
    return next(rung.order for rung in found.rungs if rung.quantity == "ball.x")


@pytest.mark.mutant("orders are taken beside events")
def test_what_is_beside_an_event_plays_no_part_in_an_order(
    trial: Make, stopping: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Beside the first stop a sample is off by a part of a step that no halving halves."""
    made = trial(case=stopping, stops=STOPS)
    kind, run = type(made.engine), type(made.engine).run

    def bent(*given: Any, **more: Any) -> Trajectory:
        found, step = run(*given, **more), given[4]
        beside = np.abs(found.times - STOPS[0]) < 0.03
        jumps = {1e-3: 0.7, 2e-3: 0.1, 4e-3: 0.9, 8e-3: 0.3}[round(step, 12)]
        found.states["ball"][beside, 0] += 8e-3 * jumps
        return found

    monkeypatch.setattr(kind, "run", bent)
    assert order(made) == pytest.approx(1.0, abs=0.01)
    was = "        away=trial.away(AWAY * max(climbed))[keep],\n"
    assert order(made, otherwise(comparing, was, "")) != pytest.approx(1.0, abs=0.01)


@pytest.mark.mutant("a missing event is judged the other way round")
@pytest.mark.parametrize(
    ("sure", "words"),
    [(2, "engine: the event never happens"), (0, "adapter: none is found, and with a step of")],
)
def test_a_missing_event_is_the_engines_only_if_its_step_would_tell(
    sure: int, words: str, trial: Make, stopping: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Timing, "surely", lambda *_: np.arange(sure))
    found = row(stopped(trial, stopping, stops=(9.0,)), "stops.time")
    assert said(found).startswith(f"refused: {words}")
