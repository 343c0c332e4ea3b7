"""Runs of a search: each once, judged as its row is, and one that dies costs nobody else."""

import os
import signal
from collections.abc import Callable, Iterator
from dataclasses import replace
from math import inf
from pathlib import Path

import pytest
from given import scenes

from textmech import engines
from textmech.engines.engine import Tunable
from textmech.reports.compare.trial.ladder import judged_step
from textmech.reports.compare.trial.start import first
from textmech.reports.runs import suite
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.processes import pool
from textmech.reports.runs.request import Request
from textmech.reports.runs.task_results import Results
from textmech.reports.runs.tasks import Pair
from textmech.reports.search.causes import search as tested
from textmech.reports.search.causes.candidate import Candidate
from textmech.reports.search.causes.errors import Errors, Run, errors, of
from textmech.reports.search.causes.search import Runs, together

# One simulation is judged as its row is: the same numbers, whatever asks for them.

CUT = 1e-6  # of what is allowed: rows leave out the digits that rounding decides


def pair(store: Path, name: str, engine: str, setting: str = "shipped") -> Pair:
    """A shipped case, whose reference is in the store."""
    case, found = scenes.SHIPPED[name], Store(store)
    key = Keys.now(None).solution(case)
    found.put(key, scenes.solved(name))
    return Pair(case, engines.make(engine, setting), found, key)


def ratios(asked: Pair) -> Errors:
    """What the rows of the pair say."""
    report = suite.measure(Request([asked.case], [asked.engine], book=False))
    native = [row for row in report.comparisons if row.realised == "native"]
    return {r.quantity: (r.ratio, r.ratio) for r in native if r.ratio is not None}


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
@pytest.mark.parametrize("name", ["bar_pendulum", "sliding_block.braking", "bouncing_disk.plastic"])
def test_a_candidate_without_options_is_the_shipped_row(
    name: str, engine: str, tmp_path: Path
) -> None:
    asked = pair(tmp_path, name, engine)
    step = asked.engine.own_step or 0.0
    found, rows = errors(Run(asked, Candidate.of({}, step))), ratios(asked)
    assert set(found) >= set(rows) - {"audit"}
    for quantity in set(rows) - {"audit"}:
        assert of(found, quantity) == pytest.approx(of(rows, quantity), rel=1e-6, abs=CUT)


@pytest.mark.slow
@pytest.mark.parametrize("engine", ["mujoco", "pymunk"])
def test_a_candidate_with_the_tuned_options_is_the_tuned_row(engine: str, tmp_path: Path) -> None:
    asked = pair(tmp_path, "four_bar", engine, "tuned")
    assert isinstance(asked.engine, Tunable)
    recipe = asked.engine.recipe(asked.case.scene, first(asked.reference()))
    step = judged_step(asked.case, asked.engine)
    found, rows = errors(Run(asked, Candidate.of(recipe, step))), ratios(asked)
    for quantity in set(rows) - {"audit"}:
        assert of(found, quantity) == pytest.approx(of(rows, quantity), rel=1e-6, abs=CUT)


@pytest.mark.slow
def test_beside_an_instant_the_error_elsewhere_is_told_too(tmp_path: Path) -> None:
    """As shipped MuJoCo's contact is not closed at the first sample."""
    asked = pair(tmp_path, "rolling_wheel.downhill", "mujoco")
    found = errors(Run(asked, Candidate.of({}, 2e-3)))
    assert of(found, "touch.normal") > 100
    assert of(found, "touch.normal", elsewhere=True) < 10
    settled = errors(Run(asked, Candidate.of({"settled": True}, 2e-3)))
    assert of(settled, "touch.normal") < 10


@pytest.mark.slow
def test_what_diverges_has_no_errors(tmp_path: Path) -> None:
    asked = pair(tmp_path, "heavy_top.cusp", "mujoco")
    assert errors(Run(asked, Candidate.of({}, 2e-3))) == {}
    assert of({}, "tilt.angle") == inf


@pytest.mark.slow
def test_another_count_of_events_leaves_their_times_without_an_error(tmp_path: Path) -> None:
    """As shipped MuJoCo's disk bounces once, and not twice: which bounce would it be?"""
    asked = pair(tmp_path, "bouncing_disk.elastic", "mujoco")
    found = errors(Run(asked, Candidate.of({}, 2e-3)))
    assert of(found, "bounces.count") == 2.0
    assert of(found, "bounces.time") == inf


@pytest.mark.slow
def test_a_tolerance_that_is_not_known_is_never_kept(tmp_path: Path) -> None:
    asked = pair(tmp_path, "bar_pendulum", "mujoco")
    allow = {**asked.case.allow, "energy.total": None}
    found = errors(
        Run(replace(asked, case=replace(asked.case, allow=allow)), Candidate.of({}, 2e-3))
    )
    assert of(found, "energy.total") == inf


# Searches run together: each run once, in rounds, and one that dies costs nobody else anything.

FATAL = Candidate.of({"fatal": True}, 1.0)


def planted(run: Run) -> Errors:
    """As pymunk does on some bad numbers."""
    if run.candidate == FATAL:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"x": (run.candidate.step, 0.0)}


@pytest.fixture
def told() -> list[tuple[str, int, int]]:
    return []


@pytest.fixture
def results(
    tmp_path: Path, told: list[tuple[str, int, int]], monkeypatch: pytest.MonkeyPatch
) -> Iterator[Results]:
    monkeypatch.setattr(tested, "errors", planted)
    with pool.local(2) as working:
        yield Results(working, lambda *now: told.append(now[:3]), Store(tmp_path), Keys.now(None))


def search(results: Results, name: str, *rounds: list[Candidate]) -> Callable[[], list[Errors]]:
    case = scenes.SHIPPED[name]
    runs = Runs(Pair(case, engines.make("pymunk", "shipped"), results.store, ""))

    def found() -> list[Errors]:
        for wanted in rounds:
            runs.need(wanted)
        return [runs.known[candidate] for wanted in rounds for candidate in wanted]

    return found


def test_each_finds_what_it_asked_for_and_progress_ends_once(
    results: Results, told: list[tuple[str, int, int]]
) -> None:
    one, two = Candidate.of({}, 1.0), Candidate.of({}, 2.0)
    found = together(
        "causes",
        {
            "a": search(results, "bar_pendulum", [one], [one, two]),
            "b": search(results, "four_bar", [two]),
            "c": search(results, "four_bar"),
        },
        results,
    )
    assert found == {
        "a": [{"x": (1.0, 0.0)}, {"x": (1.0, 0.0)}, {"x": (2.0, 0.0)}],
        "b": [{"x": (2.0, 0.0)}],
        "c": [],
    }
    assert [done == total for _, done, total in told] == [False] * (len(told) - 1) + [True]
    assert told[-1] == ("causes", 3, 3)


@pytest.mark.slow
def test_a_run_that_dies_has_no_errors(results: Results) -> None:
    other = Candidate.of({}, 2.0)
    found = together("causes", {"a": search(results, "four_bar", [FATAL, other])}, results)
    assert found == {"a": [{}, {"x": (2.0, 0.0)}]}


def test_a_second_search_runs_nothing_again(
    results: Results, told: list[tuple[str, int, int]], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Keys, "hold", lambda self: True)  # a colleague may edit meanwhile
    one = Candidate.of({}, 1.0)
    first = together("causes", {"a": search(results, "four_bar", [one])}, results)
    monkeypatch.setattr(tested, "errors", errors)  # would raise: there is no reference
    assert together("causes", {"a": search(results, "four_bar", [one])}, results) == first
