"""Searches run together: each run once, in rounds, and one that dies costs nobody else anything."""

import os
import signal
from collections.abc import Iterator
from pathlib import Path

import pytest
from given import scenes

from textmech import engines
from textmech.reports.batch.cache.key import Keys
from textmech.reports.batch.cache.store import Store
from textmech.reports.batch.search import parallel_search as tested
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.search.errors import Errors, Run, errors
from textmech.reports.batch.search.parallel_search import Asking, Known, Search, together
from textmech.reports.batch.task_results import Results
from textmech.reports.batch.tasks import Pair
from textmech.reports.system import pool

FATAL = Candidate.of({"fatal": True}, 1.0)


def planted(run: Run) -> Errors:
    """As pymunk does on some bad numbers."""
    if run.candidate == FATAL:
        os.kill(os.getpid(), signal.SIGKILL)
    return {"x": (run.candidate.step, 0.0)}


def asking(known: Known, *rounds: list[Candidate]) -> Asking[list[Errors]]:
    yield from rounds
    return [known[candidate] for wanted in rounds for candidate in wanted]


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


def search(results: Results, name: str, *rounds: list[Candidate]) -> Search[list[Errors]]:
    case, known = scenes.SHIPPED[name], Known()
    pair = Pair(case, engines.make("pymunk", "shipped"), results.store, "")
    return Search(pair, known, asking(known, *rounds))


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
