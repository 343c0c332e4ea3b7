"""Cells of the heat map: the gravest verdict, the worst error, and a shade for its size."""

from dataclasses import replace
from typing import Any

import pytest
from given.otherwise import otherwise
from given.report_folders import RUNGS

from textmech.reports.data.row import AGREES, BEYOND, DEVIATES, DIVERGED, FAILS, Comparison
from textmech.reports.page import heat
from textmech.reports.page.column import Column, column, columns
from textmech.reports.page.heat import Cell, cells, short

ROW = Comparison("c", "", "", "mujoco", "4", "tuned", "native", "", "x", "m", 0.1, 1.0, 0.5, 1.0,
                 1.0, 2.0, 0.5, AGREES, "why")  # fmt: skip


def cell(*changes: dict[str, Any]) -> Cell:
    rows = [replace(ROW, **{"quantity": f"x{k}", **change}) for k, change in enumerate(changes)]
    (found,) = cells(rows, []).values()
    return found


def test_the_worst_error_is_told_with_its_quantity() -> None:
    found = cell({"ratio": 0.5}, {"ratio": 470.0, "verdict": BEYOND}, {"ratio": 3.0})
    assert (found.kind, found.text, found.worst, found.shade) == ("beyond", "470", "x1", 6)
    assert (found.beyond, found.judged, found.within) == (2, 3, 1)
    assert found.words == "2 of 3 too far off; worst x1 at 470 of what is allowed"


@pytest.mark.parametrize(
    ("verdicts", "kind"),
    [
        ([AGREES, AGREES], "agrees"),
        ([AGREES, DEVIATES], "declared"),
        ([DEVIATES, BEYOND], "beyond"),
        ([BEYOND, "changed"], "changed"),
        ([BEYOND, DIVERGED], "diverged"),
        ([DIVERGED, FAILS], "fails"),
        ([AGREES, "refused"], "agrees"),
    ],
)
def test_the_gravest_verdict_counts(verdicts: list[str], kind: str) -> None:
    assert cell(*({"verdict": verdict} for verdict in verdicts)).kind == kind


def test_what_is_refused_as_a_whole_says_why_and_has_no_size() -> None:
    why = "not supported: engine: it cannot"
    found = cell({"verdict": "refused", "because": "engine: it cannot", "ratio": None})
    assert (found.kind, found.words, found.shade, found.judged) == ("refused", why, 0, 0)


def test_a_lost_run_is_as_dark_as_the_worst_and_has_nothing_within() -> None:
    found = cell({"verdict": DIVERGED, "ratio": None, "because": "too far"})
    assert (found.shade, found.within, found.words) == (7, 0, "too far")


def test_just_allowed_is_within_and_the_next_is_not() -> None:
    shades = [cell({"ratio": ratio}).shade for ratio in (0.0, 1e-3, 0.5, 1.0, 1.01, 10.0, 1e9)]
    assert shades == [0, 0, 3, 3, 4, 4, 7]


def test_the_audit_is_no_quantity() -> None:
    assert cells([replace(ROW, quantity="audit")], []) == {}


@pytest.mark.parametrize(
    ("ratio", "text"),
    [
        (0.0, "0"),
        (2.34, "2.3"),
        (0.021, "0.021"),
        (473.0, "473"),
        (99.7, "100"),
        (3.2e-7, "3e-7"),
        (1.3e5, "1e5"),
    ],
)
def test_a_ratio_is_short(ratio: float, text: str) -> None:
    assert short(ratio) == text


def test_columns_go_from_shipped_to_own_to_tuned_and_the_book_is_last() -> None:
    names = [("pymunk", "tuned", "law"), ("book", "smooth", "native"), ("mujoco", "mine", "native"),
             ("mujoco", "tuned", "native"), ("mujoco", "shipped", "native")]  # fmt: skip
    rows = [replace(ROW, engine=e, setting=s, realised=r) for e, s, r in names]
    assert [one.title for one in columns(rows)] == [
        "mujoco shipped", "mujoco mine", "mujoco tuned", "pymunk tuned + our force law",
        "book smooth",
    ]  # fmt: skip
    assert column(rows[0]) == Column("pymunk", "tuned", "law")


def usable(steps: list[float | None], module: Any = heat) -> float | None:
    """The step of a cell whose quantities have these."""
    ladders = [replace(RUNGS, usable_step=step, quantity=f"x{k}") for k, step in enumerate(steps)]
    row = replace(ROW, engine=RUNGS.engine, setting=RUNGS.setting, case=RUNGS.case)
    (found,) = module.cells([row], ladders).values()
    return found.step


@pytest.mark.mutant("the step from which on all is within is the largest of all")
def test_all_is_within_from_the_smallest_of_the_usable_steps_on() -> None:
    assert usable([4e-3, 1e-3, 2e-3]) == 1e-3
    assert usable([4e-3, None, 2e-3]) is None
    assert (
        usable([4e-3, 1e-3], otherwise(heat, "min(known) if known", "max(known) if known")) == 4e-3
    )
