"""What was finished is not done again: not by the next run, and not beside a planted mistake."""

import os
import signal
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from textmech.cases.case import Case
from textmech.engines.engine import Engine
from textmech.reports.compare.judge.compare import Outcome
from textmech.reports.compare.trial import run as rung
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.runs import suite
from textmech.reports.runs import tasks as unit
from textmech.reports.runs.cache.key import Keys
from textmech.reports.runs.cache.store import Store
from textmech.reports.runs.request import Request
from textmech.reports.runs.suite import Report
from textmech.reports.tables import write
from textmech.reports.tables.row import FAILS

Make = Callable[..., Trial]

RUNGS = 4  # of a tuned engine on the case: 1, 2, 4 and 8 ms
DOWN = 5  # of an engine with a step of its own


def measure(cases: list[Case], engines: list[Engine], store: Store | None) -> Report:
    nothing = lambda *_: None  # noqa: E731
    return suite.measure(Request(cases, engines, jobs=2, progress=nothing, book=False, store=store))


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "cache")


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[[], dict[str, int]]:
    """What was computed, in whatever process, since the last question."""
    log = tmp_path / "log"
    log.touch()

    def noted(function: Callable[..., Any], name: str) -> Callable[..., Any]:
        def called(*words: Any) -> Any:
            with log.open("a", encoding="utf-8") as file:
                file.write(f"{name}\n")
            return function(*words)

        return called

    monkeypatch.setattr(unit, "solve", noted(unit.solve, "solve"))
    monkeypatch.setattr(unit, "compare", noted(unit.compare, "compare"))
    monkeypatch.setattr(rung, "_run", noted(rung._run, "run"))

    def asked() -> dict[str, int]:
        found = Counter(log.read_text(encoding="utf-8").split())
        log.write_text("", encoding="utf-8")
        return found

    return asked


def rows(report: Report, cases: list[Case]) -> dict[str, str]:
    return write.texts(write.tables(report, cases))


@pytest.mark.slow
def test_a_second_run_computes_nothing_and_says_the_same(
    trial: Make, moving: Case, store: Store, done: Callable[[], dict[str, int]]
) -> None:
    engines: list[Engine] = [trial().engine, trial(setting="shipped", own_step=1e-3).engine]
    first = measure([moving], engines, store)
    assert done() == {"solve": 1, "run": RUNGS + DOWN, "compare": 2}
    second = measure([moving], engines, store)
    assert done() == {}
    assert rows(first, [moving]) == rows(second, [moving])


@pytest.mark.slow
def test_without_a_store_nothing_is_kept(
    trial: Make, moving: Case, done: Callable[[], dict[str, int]]
) -> None:
    for _ in range(2):
        measure([moving], [trial().engine], None)
        assert done() == {"solve": 1, "run": RUNGS, "compare": 1}


@pytest.mark.slow
def test_one_changed_engine_is_done_alone(
    trial: Make, moving: Case, store: Store, done: Callable[[], dict[str, int]]
) -> None:
    other = trial(setting="shipped", own_step=1e-3).engine
    measure([moving], [trial().engine, other], store)
    done()
    measure([moving], [trial(rate=2.0).engine, other], store)
    assert done() == {"run": RUNGS, "compare": 1}


@pytest.mark.slow
@pytest.mark.parametrize(
    ("phase", "finished", "left"),
    [
        ("engines", 2 * DOWN + 1, {"run": RUNGS - 1, "compare": 3}),
        ("rows", 2, {"compare": 1}),
    ],
)
def test_an_interrupted_run_goes_on_where_it_was(
    trial: Make,
    moving: Case,
    store: Store,
    done: Callable[[], dict[str, int]],
    phase: str,
    finished: int,
    left: dict[str, int],
) -> None:
    """In the middle of a ladder: each of its rungs is kept as it comes."""
    shipped: list[Engine] = [trial(setting=n, own_step=1e-3).engine for n in ("shipped", "own")]
    engines = [*shipped, trial().engine]

    def strike(what: str, so_far: int, *_: object) -> None:
        if what == phase and so_far == finished:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        suite.measure(Request([moving], engines, jobs=1, progress=strike, book=False, store=store))
    done()
    report = measure([moving], engines, store)
    assert done() == left
    assert rows(report, [moving]) == rows(measure([moving], engines, None), [moving])


@pytest.mark.slow
def test_of_rungs_that_are_judged_nothing_stays(trial: Make, moving: Case, store: Store) -> None:
    engine = trial().engine
    measure([moving], [engine], store)
    kept = [path for path in store.folder.iterdir() if path.stat().st_size]  # a lock is empty
    assert len(kept) == 3  # the reference, the ways, the rows


def die(step: float) -> None:
    if step == 2e-3:
        os.kill(os.getpid(), signal.SIGKILL)


@pytest.mark.slow
def test_a_rung_that_died_is_run_again_alone(
    trial: Make,
    moving: Case,
    store: Store,
    done: Callable[[], dict[str, int]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    run = rung._run
    with monkeypatch.context() as patch:
        patch.setattr(rung, "_run", lambda one: die(one.step) or run(one))
        report = measure([moving], [trial().engine], store)
    assert {row.verdict for row in report.comparisons} == {FAILS}
    assert "crashed: its process ended (SIGKILL)" in report.comparisons[0].because
    done()
    report = measure([moving], [trial().engine], store)
    assert done() == {"run": 1, "compare": 1}
    assert rows(report, [moving]) == rows(measure([moving], [trial().engine], None), [moving])


@pytest.mark.slow
def test_a_damaged_entry_is_computed_again(
    trial: Make, moving: Case, store: Store, done: Callable[[], dict[str, int]]
) -> None:
    first = measure([moving], [trial().engine], store)
    done()
    for path in store.folder.iterdir():
        path.write_bytes(path.read_bytes()[:-1])
    second = measure([moving], [trial().engine], store)
    assert done() == {"solve": 1, "run": RUNGS, "compare": 1}
    assert rows(first, [moving]) == rows(second, [moving])


@pytest.mark.slow
def test_what_died_or_was_computed_by_changed_code_is_not_kept(
    trial: Make,
    moving: Case,
    store: Store,
    done: Callable[[], dict[str, int]],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(Keys, "hold", lambda _: False)
        measure([moving], [trial().engine], store)
    done()
    with monkeypatch.context() as patch:
        patch.setattr(unit, "compare", lose)
        measure([moving], [trial().engine], store)
    done()
    measure([moving], [trial().engine], store)
    assert done() == {"compare": 1}


def lose(*_: object) -> Outcome:
    raise ZeroDivisionError
