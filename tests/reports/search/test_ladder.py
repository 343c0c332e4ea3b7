"""What a ladder tells is not run again, and is not taken for more than it is."""

from dataclasses import replace

import pytest

from textmech.reports.row import BEYOND, Comparison, Rungs
from textmech.reports.search.candidate import Candidate
from textmech.reports.search.ladder import climbed, usable

BASE = Candidate.of({}, 2e-3)
ROW = Comparison(
    case="b", theme="pins", source="", engine="mujoco", version="4.0.0", setting="shipped",
    realised="native",
    protocol="", quantity="x", unit="m", step=2e-3, error=4.0, when=0.0, rms=1.0, final=1.0,
    allowed=2.0, ratio=2.0, verdict=BEYOND, because="",
)  # fmt: skip
RUNGS = Rungs(
    case="b", engine="mujoco", version="4.0.0", setting="shipped", realised="native",
    ladder="held", quantity="x", unit="m", steps="0.0005 0.001 0.002",
    errors="1.00e+00 2.00e+00 4.00e+00", order=1.0, order_low=1.0, order_high=1.0, limit=0.0,
    uncertainty=0.0, usable_step=1e-3, verdict="converges to the textbook",
)  # fmt: skip


def test_its_errors_at_smaller_steps_are_known() -> None:
    assert climbed(BASE, [ROW], [RUNGS]) == {
        BASE.at(1e-3): {"x": (1.0, 1.0)},
        BASE.at(5e-4): {"x": (0.5, 0.5)},
    }


@pytest.mark.parametrize(
    "rungs",
    [
        [],
        [replace(RUNGS, quantity="y")],  # a count has no ladder
        [RUNGS, replace(RUNGS, ladder="following")],  # the held one has other numbers
        [replace(RUNGS, steps="0.0005 0.001", errors="1.00e+00 2.00e+00")],  # one diverged
    ],
)
def test_what_it_does_not_tell_is_run(rungs: list[Rungs]) -> None:
    assert climbed(BASE, [ROW], rungs) == {}


def test_the_step_that_is_small_enough() -> None:
    assert list(usable([ROW], [RUNGS])) == [(ROW, 1e-3, 2.0)]
    for other in ({"usable_step": None}, {"ladder": "following"}, {"setting": "tuned"}):
        assert list(usable([ROW], [replace(RUNGS, **other)])) == []  # type: ignore[arg-type]
