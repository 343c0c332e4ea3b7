"""What was finished is not done again: not by the next run, and not beside a planted mistake."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from textmech.cases.case import Case
from textmech.engines.engine import Engine
from textmech.reports import suite, unit, write
from textmech.reports.cache.key import Keys
from textmech.reports.cache.store import Store
from textmech.reports.judge.compare import Outcome
from textmech.reports.suite import Report
from textmech.reports.trial.trial import Trial

Make = Callable[..., Trial]


def measure(cases: list[Case], engines: list[Engine], store: Store | None) -> Report:
    nothing = lambda *_: None  # noqa: E731
    return suite.measure(cases, engines, jobs=2, progress=nothing, book=False, store=store)


@pytest.fixture
def store(tmp_path: Path) -> Store:
    return Store(tmp_path / "cache")


@pytest.fixture
def done(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> Callable[[], list[str]]:
    """What was computed, in whatever process, since the last question."""
    log = tmp_path / "log"
    log.touch()

    def noted(function: Callable[..., Any], name: str) -> Callable[..., Any]:
        def called(*words: Any) -> Any:
            with log.open("a", encoding="utf-8") as file:
                file.write(f"{name}\n")
            return function(*words)

        return called

    monkeypatch.setattr(suite, "solve", noted(suite.solve, "solve"))
    monkeypatch.setattr(unit, "compare", noted(unit.compare, "compare"))

    def asked() -> list[str]:
        found = sorted(log.read_text(encoding="utf-8").split())
        log.write_text("", encoding="utf-8")
        return found

    return asked


def rows(report: Report, cases: list[Case]) -> dict[str, str]:
    return write.texts(write.tables(report, cases))


def test_a_second_run_computes_nothing_and_says_the_same(
    trial: Make, moving: Case, store: Store, done: Callable[[], list[str]]
) -> None:
    engines: list[Engine] = [trial().engine, trial(setting="shipped", own_step=1e-3).engine]
    first = measure([moving], engines, store)
    assert done() == ["compare", "compare", "solve"]
    second = measure([moving], engines, store)
    assert done() == []
    assert rows(first, [moving]) == rows(second, [moving])


def test_without_a_store_nothing_is_kept(
    trial: Make, moving: Case, done: Callable[[], list[str]]
) -> None:
    for _ in range(2):
        measure([moving], [trial().engine], None)
        assert done() == ["compare", "solve"]


def test_one_changed_engine_is_done_alone(
    trial: Make, moving: Case, store: Store, done: Callable[[], list[str]]
) -> None:
    other = trial(setting="shipped", own_step=1e-3).engine
    measure([moving], [trial().engine, other], store)
    done()
    measure([moving], [trial(rate=2.0).engine, other], store)
    assert done() == ["compare"]


def test_an_interrupted_run_goes_on_where_it_was(
    trial: Make, moving: Case, store: Store, done: Callable[[], list[str]]
) -> None:
    engines: list[Engine] = [trial(setting=name).engine for name in ("tuned", "shipped", "own")]

    def strike(what: str, finished: int, total: int) -> None:
        if what == "engines" and finished == 2:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        suite.measure([moving], engines, jobs=1, progress=strike, book=False, store=store)
    done()
    report = measure([moving], engines, store)
    assert done() == ["compare"]
    assert rows(report, [moving]) == rows(measure([moving], engines, None), [moving])


def test_a_damaged_entry_is_computed_again(
    trial: Make, moving: Case, store: Store, done: Callable[[], list[str]]
) -> None:
    first = measure([moving], [trial().engine], store)
    done()
    for path in store.folder.glob("??/*"):
        path.write_bytes(path.read_bytes()[:-1])
    second = measure([moving], [trial().engine], store)
    assert done() == ["compare", "solve"]
    assert rows(first, [moving]) == rows(second, [moving])


def test_what_died_or_was_computed_by_changed_code_is_not_kept(
    trial: Make,
    moving: Case,
    store: Store,
    done: Callable[[], list[str]],
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
    assert done() == ["compare"]


def lose(_: Trial) -> Outcome:
    raise ZeroDivisionError
