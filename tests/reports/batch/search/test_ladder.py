"""What a ladder tells is not run again, and is not taken for more than it is."""

from dataclasses import replace
from typing import Any

import pytest
from given.lines import LADDER
from given.otherwise import otherwise

from textmech.reports.batch.search import cause_rows as told
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.batch.search.cause_rows import climbed
from textmech.reports.data.row import BEYOND, Comparison, StepError

BASE = Candidate.of({}, 2e-3)
ROW = Comparison(
    case="b", theme="pins", source="", engine="mujoco", version="4.0.0", setting="shipped",
    realised="native",
    protocol="", quantity="x", unit="m", step=2e-3, error=4.0, when=0.0, rms=1.0, final=1.0,
    allowed=2.0, ratio=2.0, verdict=BEYOND, because="",
)  # fmt: skip
STEPS = [
    StepError("b", "mujoco", "shipped", "native", "held", "x", "m", step, error)
    for step, error in ((5e-4, 1.0), (1e-3, 2.0), (2e-3, 4.0))
]


def changed(**other: Any) -> list[StepError]:
    """The same steps of another quantity, say."""
    return [replace(step, **other) for step in STEPS]


def test_its_errors_at_smaller_steps_are_known() -> None:
    assert climbed(BASE, [ROW], STEPS) == {
        BASE.at(1e-3): {"x": (1.0, 1.0)},
        BASE.at(5e-4): {"x": (0.5, 0.5)},
    }


@pytest.mark.parametrize(
    "steps",
    [
        [],
        changed(quantity="y"),  # a count has no ladder
        STEPS + changed(ladder="following"),  # the held one has other numbers
        STEPS[:2],  # one diverged
        STEPS + changed(quantity="y")[1:],  # the finest of one quantity is another step
    ],
)
def test_what_it_does_not_tell_is_run(steps: list[StepError]) -> None:
    assert climbed(BASE, [ROW], steps) == {}


def enough(
    steps: list[StepError], module: Any = told, largest: float | None = 2e-3
) -> list[tuple[float, float]]:
    """largest: the step up to which the ladder is usable, whatever its errors are."""
    rung = replace(LADDER, case="b", quantity="x", usable_step=largest)
    return [(step, error) for _, step, error in module.usable([ROW], steps, [rung])]


@pytest.mark.mutant("a lucky step above one that is beyond is small enough")
def test_the_step_that_is_small_enough() -> None:
    """The largest from which on, downward, all keep what is allowed; of the row's own ladder."""
    assert enough(STEPS) == enough(STEPS[::-1]) == [(1e-3, 2.0)]
    for other in ({"error": 3.0}, {"ladder": "following"}, {"setting": "tuned"}):
        assert enough(changed(**other)) == []
    lucky = [STEPS[0], replace(STEPS[1], error=2.1), replace(STEPS[2], error=0.0)]
    assert enough(lucky) == [(5e-4, 1.0)]
    hasty = otherwise(told, "takewhile(lambda one:", "filter(lambda one:")
    assert enough(lucky, hasty) == [(2e-3, 0.0)]


@pytest.mark.mutant("one start within a step tells that a step is small enough")
def test_of_what_strikes_every_start_has_to_keep_it() -> None:
    assert enough(STEPS, largest=5e-4) == [(5e-4, 1.0)]
    assert enough(STEPS, largest=None) == []
    lucky = otherwise(told, " and one.step <= largest.get(_at(one), 0.0)", "")
    assert enough(STEPS, lucky, largest=5e-4) == [(1e-3, 2.0)]
