"""Work against precision: what is drawn, counted by hand."""

from collections.abc import Mapping
from dataclasses import replace

import pytest

from textmech.reports.data.row import AGREES, Comparison, StepError
from textmech.reports.page.column import Column
from textmech.reports.page.work import enough, profile, work, worst

ROW = Comparison("a", "", "", "mujoco", "4", "tuned", "native", "", "x", "m", 0.1, 1.0, 0.5, 1.0,
                 1.0, 2.0, 0.5, AGREES, "")  # fmt: skip
STEPS = {0.001: 0.2, 0.002: 1.0, 0.004: 4.0}
TUNED = Column("mujoco", "tuned", "native")


def climbed(
    errors: Mapping[float, float], ladder: str = "held", quantity: str = "x"
) -> list[StepError]:
    at = ("a", "mujoco", "tuned", "native", ladder, quantity, "m")
    return [StepError(*at, step, error) for step, error in errors.items()]


@pytest.mark.parametrize(
    ("ladder", "precision", "step"),
    [
        ({0.001: 0.1, 0.002: 0.5, 0.004: 2.0}, 1.0, 0.002),
        ({0.001: 0.1, 0.002: 0.5, 0.004: 2.0}, 0.2, 0.001),
        ({0.001: 0.1, 0.002: 2.0, 0.004: 0.5}, 1.0, 0.001),  # luck at one step does not count
        ({0.001: 3.0, 0.002: 0.5}, 1.0, None),
        ({0.001: float("nan")}, 1.0, None),
    ],
)
def test_enough_is_the_largest_step_from_which_on_all_is_within(
    ladder: dict[float, float], precision: float, step: float | None
) -> None:
    assert enough(ladder, precision) == step


def test_the_worst_quantity_counts_and_the_ladder_that_follows() -> None:
    rows = [ROW, replace(ROW, quantity="y", allowed=0.5)]
    steps = climbed(STEPS) + climbed({0.001: 0.1, 0.002: 0.1, 0.004: 5.0}, quantity="y")
    assert worst(rows, steps) == {("a", TUNED): {0.001: 0.2, 0.002: 0.5, 0.004: 10.0}}
    following = climbed(dict.fromkeys(STEPS, 0.0), ladder="following")
    assert worst([ROW], climbed(STEPS) + following) == {
        ("a", TUNED): {0.001: 0, 0.002: 0, 0.004: 0}
    }


def test_a_share_is_of_all_cases_whether_they_run_or_not() -> None:
    ladders = {
        ("a", TUNED): {0.001: 0.5, 0.002: 0.5},
        ("b", TUNED): {0.001: 0.5, 0.002: 3.0},
        ("b", Column("mujoco", "tuned", "law")): {0.01: 0.1},
    }
    cases = ["a", "b", "c", "d"]
    x, y = profile(TUNED, cases, ladders, 1.0)
    assert x[1:-1] == [500.0, 1000.0]
    assert y == [0.0, 25.0, 50.0, 50.0]
    x, y = profile(Column("mujoco", "tuned", "any way"), cases, ladders, 1.0)
    assert x[1:-1] == [100.0, 500.0]  # the law takes the larger step


def test_a_panel_has_a_curve_of_each_precision_for_each_column() -> None:
    themes = {"a": ("pins",), "b": ("space",)}
    (panel,) = work([ROW], climbed(STEPS), themes)  # of a theme without a ladder there is none
    assert (panel["theme"], panel["cases"]) == ("pins", 1)
    assert set(panel["curves"]) == {TUNED.key}
    allowed, hundredth = panel["curves"][TUNED.key]
    assert allowed == ([10.0, 500.0, 1e5], [0.0, 100.0, 100.0])
    assert hundredth == ([10.0, 1e5], [0.0, 0.0])
    assert work([ROW], [], themes) == []
