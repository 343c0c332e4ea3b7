"""The whole path with engines that misbehave: what is lost is said, and the rest goes on."""

import os
import signal
from collections.abc import Callable
from concurrent.futures import Executor
from contextlib import AbstractContextManager
from dataclasses import replace
from types import SimpleNamespace
from typing import Any, cast

import pytest
from given.command.lines import row
from given.scenes import cases_of

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.engines.engine import Engine, Realised
from textmech.reference.solve import Solution
from textmech.reports.compare.judge.compare import Outcome
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.runs import request, suite, tasks
from textmech.reports.runs.request import Request
from textmech.reports.runs.suite import Report
from textmech.reports.runs.trials import Tried
from textmech.reports.search.causes import explained
from textmech.reports.search.causes.cause_rows import NOTHING
from textmech.reports.tables.row import AGREES, FAILS, Cause

Make = Callable[..., Trial]


def die() -> None:
    """As pymunk does on some bad numbers: the whole process goes, without an exception."""
    os.kill(os.getpid(), signal.SIGKILL)


def stumble() -> None:
    raise ZeroDivisionError("a bug of the adapter")


def measure(cases: list[Case], engines: list[Engine]) -> Report:
    return suite.measure(Request(cases, engines, jobs=2))


def test_an_instant_is_that_of_the_engines_own_run(monkeypatch: pytest.MonkeyPatch) -> None:
    """Rows of its own are told what is off in it, whatever our law's run is off by."""
    cause = Cause(
        "swing", "mujoco", "shipped", "rod.angle", 9.0, 1.0, NOTHING, "{}", None, None, None, ""
    )
    monkeypatch.setattr(explained, "found_causes", lambda *_, **__: [cause])
    engine = SimpleNamespace(name="mujoco", setting="shipped")
    pair: Any = SimpleNamespace(case=SimpleNamespace(name="swing"), engine=engine)
    ways: tuple[tuple[Realised, str], ...] = (("native", "at a corner"), ("law", "at a stop"))
    tried = [Tried(pair, way, Outcome([], moments={"rod.angle": told})) for way, told in ways]
    report, results = Report(comparisons=[row(ratio=9.0)], tried=tried), cast("Any", None)
    explained.explain([], results, report)
    assert report.comparisons[0].because == f"at a corner; {NOTHING}"


def verdicts(report: Report) -> dict[tuple[str, str], Any]:
    return {(r.setting, r.quantity): r for r in report.comparisons if r.quantity != "audit"}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("before", "words"), [(die, "process ended"), (stumble, "ZeroDivisionError")]
)
def test_a_lost_run_is_a_row_and_the_others_are_whole(
    trial: Make, moving: Case, before: Callable[[], None], words: str
) -> None:
    sound = trial(setting="tuned").engine
    lost = trial(setting="shipped", own_step=1e-3, before=before).engine
    found = verdicts(measure([moving], [lost, sound]))
    assert found[("tuned", "ball.x")].verdict == AGREES
    assert found[("shipped", "ball.x")].verdict == FAILS
    assert words in found[("shipped", "ball.x")].because


@pytest.mark.slow
@pytest.mark.parametrize(
    ("planning", "words"), [(die, "process ended"), (stumble, "ZeroDivisionError")]
)
def test_an_engine_that_is_lost_while_it_plans_is_a_row_too(
    trial: Make, moving: Case, planning: Callable[[], None], words: str
) -> None:
    sound = trial(setting="tuned").engine
    lost = trial(setting="shipped", own_step=1e-3, planning=planning).engine
    found = verdicts(measure([moving], [lost, sound]))
    assert found[("tuned", "ball.x")].verdict == AGREES
    assert found[("shipped", "ball.x")].verdict == FAILS
    assert words in found[("shipped", "ball.x")].because


@pytest.mark.slow
def test_all_cases_that_cannot_start_are_named_together(trial: Make, moving: Case) -> None:
    broken = [
        replace(moving, name=name, initial={}, source=replace(moving.source, file=f"{name}.yaml"))
        for name in ("one", "two")
    ]
    report = measure([*broken, moving], [trial().engine])
    assert {mistake.file for mistake in report.mistakes} == {"one.yaml", "two.yaml"}
    assert {row.case for row in report.comparisons} == {moving.name}  # theirs alone is lost
    with pytest.raises(CaseError) as caught:
        measure(broken, [trial().engine])
    assert {mistake.file for mistake in caught.value.mistakes} == {"one.yaml", "two.yaml"}


def overflow(case: Case) -> Solution:
    raise OverflowError("too stiff")


def exits(case: Case) -> Solution:
    os._exit(0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("ends", "words"), [(overflow, "OverflowError: too stiff"), (exits, "exit code 0")]
)
def test_a_lost_reference_is_a_mistake_of_its_own_file(
    trial: Make,
    moving: Case,
    ends: Callable[[Case], Solution],
    words: str,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    lost = replace(moving, name="lost", source=replace(moving.source, file="lost.yaml"))
    solve = tasks.solve
    fails = lambda case: (ends if case.name == "lost" else solve)(case)  # noqa: E731
    monkeypatch.setattr(tasks, "solve", fails)
    report = measure([lost, moving], [trial().engine])
    (mistake,) = report.mistakes
    assert mistake.file == "lost.yaml"
    assert mistake.what.startswith("the reference of lost could not be solved: ")
    assert words in mistake.what
    rows = {row.case: row for row in report.comparisons if row.quantity == "ball.x"}
    assert {name: row.verdict for name, row in rows.items()} == {"moving": AGREES}


@pytest.mark.slow
def test_there_are_no_more_processes_than_tasks(
    trial: Make, moving: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked: list[int] = []
    local = request.local

    def noted(jobs: int) -> AbstractContextManager[Executor]:
        asked.append(jobs)
        return local(2)

    monkeypatch.setattr(request, "local", noted)
    suite.measure(Request([moving], [trial().engine], jobs=100_000))
    assert asked[0] <= suite.RUNS


@pytest.mark.slow
def test_a_reference_that_is_not_certified_judges_nothing(
    trial: Make, moving: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("textmech.reference.certificate.laws.LAW", -1.0)  # nothing can keep that
    report = measure([moving], [trial().engine])
    assert report.fails
    assert {row.verdict for row in report.comparisons} == {FAILS}
    assert all("not certified" in row.because for row in report.comparisons)


@pytest.mark.slow
def test_nor_does_it_judge_events(
    trial: Make, moving: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A ball that turns at 0.5 s: its time is a row of its own."""
    text = "\n".join(moving.source.lines)
    forces = "  forces: {brake: {push: ball.center, constant: [-4, 0]}}\n"
    events = "events: {turns: {ball.vx: falls to zero}}\n"
    text = text.replace("initial:", f"{forces}initial:").replace("allow: {", f"{events}allow: {{")
    text = text.replace("allow: {", "allow: {turns.time: 1.0e-3, turns.count: 0.5, ")
    (turning,) = cases_of(f"{text}\n", "turning")
    engine = trial(stops=(0.5,)).engine
    assert {row.verdict for row in measure([turning], [engine]).certificates} == {"holds"}
    monkeypatch.setattr("textmech.reference.certificate.laws.LAW", -1.0)
    rows = {row.quantity: row.verdict for row in measure([turning], [engine]).comparisons}
    assert {"turns.time", "turns.count", "ball.x"} <= rows.keys()
    assert set(rows.values()) == {FAILS}
