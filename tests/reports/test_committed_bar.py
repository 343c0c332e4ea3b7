"""What was committed is not lost: tuned rows have a bar near it, and none gets worse unnoticed."""

from collections.abc import Callable, Mapping
from dataclasses import fields, replace
from typing import Any

import pytest

from textmech.cases.case import Case
from textmech.cases.find import shipped
from textmech.cases.load import load
from textmech.reports.compare.judge.compare import compare
from textmech.reports.compare.trial.trial import Trial
from textmech.reports.data.row import AGREES, BEYOND, DEVIATES, DIVERGED, Comparison
from textmech.reports.output import committed
from textmech.reports.output.committed import WORSE, Key

Make = Callable[..., Trial]
KEY: Key = ("moving", "mujoco", "tuned", "native", "ball.x")
NOTHING = Comparison(**{field.name: None for field in fields(Comparison)})  # type: ignore[arg-type]


@pytest.fixture
def as_shipped(moving: Case, monkeypatch: pytest.MonkeyPatch) -> Callable[..., None]:
    """The free body's case as a shipped one, with a committed row of the tuned ball."""
    monkeypatch.setattr(committed, "is_shipped", lambda file: file == moving.source.file)

    def with_row(**said: Any) -> None:
        usual = {"version": "4.0.0", "step": 1e-3, "error": 1e-3, "verdict": AGREES}
        row = replace(NOTHING, **{**usual, **said})
        monkeypatch.setattr(committed, "rows", lambda: {KEY: row})

    return with_row


def tuned(made: Trial) -> Any:
    return next(row for row in compare(made).rows if row.quantity == "ball.x")


@pytest.mark.parametrize(("before", "lost"), [(1e-3, False), (1.1e-4, False), (0.9e-4, True)])
def test_a_tuned_row_keeps_ten_times_what_was_committed(
    trial: Make, moving: Case, as_shipped: Callable[..., None], before: float, lost: bool
) -> None:
    as_shipped(error=before)
    found = tuned(trial(rate=1.0))  # 1e-3 off, of 1e-2 allowed
    assert found.verdict == AGREES  # no verdict depends on an older run
    words = "0.001 is above 10 × the committed 9e-05" if lost else ""
    assert committed.worse(moving, found) == words


def test_what_was_nothing_may_be_rounding_and_no_more(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(error=0.0)
    assert not committed.worse(moving, tuned(trial(rate=0.0, model=1e-12)))
    assert committed.worse(moving, tuned(trial(rate=0.0, model=1e-8)))


@pytest.mark.parametrize("other", [{"version": "3.3.7"}, {"step": 2e-3}])
def test_another_question_has_another_bar(
    trial: Make, moving: Case, as_shipped: Callable[..., None], other: dict[str, Any]
) -> None:
    as_shipped(error=1e-6, **other)
    assert not committed.worse(moving, tuned(trial()))


def test_a_case_of_the_same_name_elsewhere_is_another(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(error=1e-6)
    other = replace(moving, source=replace(moving.source, file="/elsewhere/moving.yaml"))
    assert committed.worse(moving, tuned(trial()))
    assert not committed.worse(other, tuned(trial(case=other)))


@pytest.mark.parametrize(
    ("before", "now", "lost"),
    [
        (AGREES, "refused", True),
        (AGREES, BEYOND, True),
        (DEVIATES, BEYOND, True),
        (BEYOND, DIVERGED, True),
        (BEYOND, AGREES, False),
        ("refused", AGREES, False),
        (BEYOND, BEYOND, False),
    ],
)
def test_a_worse_verdict_is_a_row_that_got_worse(
    trial: Make, moving: Case, as_shipped: Callable[..., None], before: str, now: str, lost: bool
) -> None:
    as_shipped(verdict=before)
    row = replace(tuned(trial()), verdict=now)
    assert bool(committed.worse(moving, row)) == lost


def test_a_finding_that_grew_tenfold_got_worse(
    trial: Make, moving: Case, as_shipped: Callable[..., None]
) -> None:
    as_shipped(verdict=BEYOND, error=0.1)
    row: Comparison = replace(tuned(trial()), verdict=BEYOND, error=0.9)
    assert committed.worse(moving, row) == ""
    worse = committed.worse(moving, replace(row, error=1.1))
    assert worse == "1.1 is above 10 × the committed 0.1"
    assert committed.worse(moving, replace(row, error=float("nan"))) != ""


@pytest.mark.slow
def test_every_committed_tuned_row_has_a_bar_near_its_figure() -> None:
    """A hundredfold loss is seen in each, whatever the case allows."""
    cases = {case.name: case for path in shipped().values() for case in load(path)}
    rows: Mapping[Key, Comparison] = committed.rows()
    bars = 0
    for key, row in rows.items():
        if key[2] == "tuned" and row.verdict == AGREES and key[4] != "audit":
            found = committed.before(cases[key[0]], key, row.version, row.step)
            assert found is row
            assert row.error is not None
            bars += 1
    assert bars > 250
    assert WORSE < 30
