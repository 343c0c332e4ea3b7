"""The last column: an instant and what is declared stay, and the causes follow."""

from dataclasses import replace

import pytest

from textmech.reports.batch.search.cause_rows import NONE, NOTHING
from textmech.reports.batch.suite import with_causes
from textmech.reports.data.row import BEYOND, DEVIATES, UNSEARCHED, Cause, Comparison

ROW = Comparison(
    case="b", theme="pins", source="", engine="mujoco", version="4.0.0", setting="shipped",
    realised="native",
    protocol="", quantity="x", unit="m", step=2e-3, error=9.0, when=0.0, rms=1.0, final=1.0,
    allowed=1.0, ratio=9.0, verdict=BEYOND, because="the ladder's words",
)  # fmt: skip
CAUSE = Cause("b", "mujoco", "shipped", "x", 9.0, 1.0, "RK4", "{}", 2e-3, 0.5, 4.0, "")
STEP = replace(CAUSE, cure="RK4 + step", step=5e-4, cost=16.0)
NAME = ("b", "mujoco", "shipped", "x")


def because(*causes: Cause, row: Comparison = ROW, moment: str = "") -> str:
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
    row = replace(ROW, verdict=DEVIATES, because="its model")
    assert because(CAUSE, row=row) == "its model; cured by RK4 (×4 the cost)"
    none = because(replace(CAUSE, cure=NONE), row=row)
    assert none == "its model; none of its options tried cures it"


@pytest.mark.parametrize("other", [{"realised": "law"}, {"setting": "tuned"}, {"quantity": "y"}])
def test_other_rows_stay_as_they_are(other: dict[str, str]) -> None:
    row = replace(ROW, **other)  # type: ignore[arg-type]
    assert because(CAUSE, row=row) == row.because
