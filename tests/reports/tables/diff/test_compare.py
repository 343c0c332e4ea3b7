"""What changed is told, with its kind; what only rounding changed is not."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import pandas as pd
import pytest
from given.command.report_folders import CERTIFICATE, COVERED, INSTANT, ROW, RUNGS, STEPS, report

from textmech.cases.mistake import CaseError
from textmech.reports.tables import write
from textmech.reports.tables.diff.columns import (  # fmt: skip
    BETTER,
    CHANGED,
    KNOWN,
    LOST,
    NEW,
    OF_A_RUN,
    WORSE,
    Rule,
)
from textmech.reports.tables.diff.compare import Change, Content, Difference, difference
from textmech.reports.tables.diff.folder import opened
from textmech.reports.tables.diff.forms import looked_at
from textmech.reports.tables.row import Cause

RULE = Rule()


def found(tmp_path: Path, old: dict[str, Any], new: dict[str, Any], **how: Any) -> Difference:
    folders = {"OLD": report(tmp_path / "old", **old), "NEW": report(tmp_path / "new", **new)}
    before, after = opened(folders)
    return difference(before, after, how.pop("rule", RULE), **how)


def only(difference: Difference) -> Change:
    (change,) = difference.changes
    return change


@pytest.mark.slow
def test_the_committed_reports_do_not_differ_from_themselves() -> None:
    (folder,) = opened({"reports": write.HERE})
    same = difference(folder, folder, RULE)
    assert not same.changes
    compared = {name: count.compared for name, count in same.counts.items()}
    assert compared == {name: len(rows) for name, rows in folder.tables.items()}
    assert all(compared[name] > 100 for name in KNOWN)


@pytest.mark.slow
def test_every_known_file_is_one_that_a_run_writes_with_these_columns() -> None:
    (folder,) = opened({"reports": write.HERE})
    assert set(write.NAMES) - {"models.csv"} == OF_A_RUN  # its numbers stand in the others
    assert set(folder.tables) == set(KNOWN)
    for name, columns in KNOWN.items():
        assert set(columns.needed) <= set(folder.tables[name][0])


@pytest.mark.parametrize(
    ("now", "kind"),
    [
        ({"verdict": "FAILS"}, WORSE),
        ({"verdict": "refused", "because": "engine: it cannot"}, WORSE),
        ({"verdict": "diverged", "error": None}, WORSE),
        ({"verdict": "beyond"}, WORSE),
        ({"error": 3.1e-3}, WORSE),
        ({"error": 2.5e-3}, CHANGED),
        ({"error": 1e-3}, BETTER),
        ({"allowed": 1e-1}, CHANGED),
        ({"unit": "deg", "error": 2e-1}, CHANGED),  # not a number to compare
        ({"error": 2.02e-3}, None),
        ({"rms": 1.0, "final": 1.0, "when": 3.0, "because": "x", "protocol": "y"}, None),
        ({"version": "4.1.0", "step": 2e-3, "source": "(2.1)"}, None),
    ],
)
def test_a_row_of_tolerance(tmp_path: Path, now: dict[str, Any], kind: str | None) -> None:
    changes = found(tmp_path, {}, {"rows": [replace(ROW, **now)]})
    assert [change.kind for change in changes.changes] == ([kind] if kind else [])
    assert changes.regressed is (kind == WORSE)


@pytest.mark.parametrize("verdict", ["agrees", "beyond", "deviates", "changed"])
def test_a_row_that_judged_a_number_and_is_gone_is_a_regression(
    tmp_path: Path, verdict: str
) -> None:
    other = replace(ROW, quantity="energy.total", verdict=verdict)
    change = only(found(tmp_path, {"rows": [ROW, other]}, {}))
    assert (change.kind, change.place[2], change.new) == (WORSE, "energy.total", None)


@pytest.mark.parametrize("verdict", ["refused", "diverged", "crashed", "FAILS"])
def test_a_row_that_judged_none_and_is_gone_is_lost(tmp_path: Path, verdict: str) -> None:
    other = replace(ROW, quantity="energy.total", verdict=verdict, error=None)
    assert only(found(tmp_path, {"rows": [ROW, other]}, {})).kind == LOST


@pytest.mark.parametrize(("verdict", "kind"), [("agrees", NEW), ("beyond", NEW), ("FAILS", WORSE)])
def test_a_new_row(tmp_path: Path, verdict: str, kind: str) -> None:
    other = replace(ROW, quantity="energy.total", verdict=verdict)
    change = only(found(tmp_path, {}, {"rows": [ROW, other]}))
    assert (change.kind, change.old) == (kind, None)


@pytest.mark.parametrize(
    ("now", "kind"),
    [
        ({"usable_step": 1e-3}, WORSE),
        ({"usable_step": None}, WORSE),
        ({"usable_step": 4e-3}, BETTER),
        ({"verdict": "beyond"}, CHANGED),
        ({"verdict": "exact", "uncertainty": 1e-9}, CHANGED),  # the old one was sure
        ({"order": 2.0, "limit": 1.0}, None),
    ],
)
def test_a_row_of_convergence(tmp_path: Path, now: dict[str, Any], kind: str | None) -> None:
    changes = found(tmp_path, {}, {"rungs": [replace(RUNGS, **now)]}).changes
    assert [change.kind for change in changes] == ([kind] if kind else [])


def test_words_that_rounding_decides_are_not_compared(tmp_path: Path) -> None:
    sure = replace(RUNGS, uncertainty=1e-9)  # below 1e-6 of what the quantity is allowed
    other = replace(sure, verdict="exact", uncertainty=5e-9)
    assert not found(tmp_path, {"rungs": [sure]}, {"rungs": [other]}).changes


def test_a_step_that_only_one_ladder_has(tmp_path: Path) -> None:
    """Their errors are not compared: those of the judged step are in tolerance.csv."""
    change = only(found(tmp_path, {}, {"steps": [replace(STEPS[0], error=9.0)]}))
    assert (change.kind, change.new) == (LOST, None)
    assert change.place == ("swing", "mujoco.tuned", "bar.angle (held, h = 0.002 s)")


@pytest.mark.parametrize(
    ("time", "other", "changed"),
    [
        (0.451600756, 0.451600757, False),
        (0.451600756, 0.451600759, True),
        (12.3456789, 12.345679, False),  # the last digit that is written
        (12.3456789, 12.3456792, True),
        (0.0, 1e-10, False),
    ],
)
def test_the_time_of_an_event(tmp_path: Path, time: float, other: float, changed: bool) -> None:
    old, new = ({"instants": [replace(INSTANT, time=t)]} for t in (time, other))
    changes = found(tmp_path, old, new).changes
    assert [change.kind for change in changes] == ([CHANGED] if changed else [])


@pytest.mark.parametrize(
    ("now", "kind"),
    [
        ({"verdict": "FAILS"}, WORSE),
        ({"certified": 1e-11}, None),  # the next power of ten
        ({"certified": 1e-10}, CHANGED),
        ({"certified": None}, CHANGED),
        ({"difference": 1e-12, "bound": 1e-8}, None),
    ],
)
def test_a_check_of_a_reference(tmp_path: Path, now: dict[str, Any], kind: str | None) -> None:
    changes = found(tmp_path, {}, {"certificates": [replace(CERTIFICATE, **now)]}).changes
    assert [change.kind for change in changes] == ([kind] if kind else [])


def test_an_equation_that_nothing_covers_any_more_is_a_regression(tmp_path: Path) -> None:
    bare = COVERED.assign(cases="")
    change = only(found(tmp_path, {}, {"covered": bare}))
    assert (change.kind, change.place[2]) == (WORSE, "equation (2.44)")
    assert (change.old, change.new) == (Content("swing"), Content("not covered"))


def test_of_what_covers_only_cases_of_both_count(tmp_path: Path) -> None:
    rest = COVERED.assign(cases=["other", ""])  # no longer by `swing`, which both have
    assert only(found(tmp_path, {}, {"covered": rest})).kind == WORSE
    more = COVERED.assign(cases=["swing third", ""])
    assert not found(tmp_path / "more", {}, {"covered": more}).changes


@pytest.mark.slow
def test_a_partial_run_is_compared_as_far_as_it_goes(tmp_path: Path) -> None:
    other = replace(ROW, case="other", verdict="agrees")
    slow = replace(ROW, setting="shipped")
    part = found(tmp_path, {"rows": [ROW, other, slow]}, {})
    assert not part.changes
    count = part.counts["tolerance.csv"]
    assert (count.compared, count.left) == (1, (2, 0))
    whole = found(tmp_path, {"rows": [ROW, other, slow]}, {}, whole=True)
    assert {(c.kind, c.place[0], c.place[1]) for c in whole.changes} == {
        (WORSE, "other", "mujoco.tuned"),
        (WORSE, "swing", "mujoco.shipped"),
    }


@pytest.mark.parametrize(
    ("field", "message"), [("case", "no case"), ("setting", "no engine with the same setting")]
)
def test_folders_with_nothing_in_common_are_a_mistake(
    tmp_path: Path, field: str, message: str
) -> None:
    with pytest.raises(CaseError, match=message):
        found(tmp_path, {}, {"rows": [replace(ROW, **{field: "another"})]})


@pytest.mark.slow
def test_thresholds_are_options(tmp_path: Path) -> None:
    now = {"rows": [replace(ROW, error=2.5e-3)]}
    assert found(tmp_path, {}, now, rule=Rule(worse=1.2)).regressed
    assert not found(tmp_path, {}, now, rule=Rule(moved=0.3)).changes
    assert not found(tmp_path, {}, now, rule=Rule(floor=0.1)).changes


ADVICE = pd.DataFrame(
    [
        ("swing", "mujoco", "", 2, "both", "RK4", 1.0),
        ("swing", "mujoco", 0.001, 2, "both", "", 2.0),
    ],
    columns=["case", "engine", "tolerance", "margin", "want", "recipe", "cost"],
).assign(settings="", step=1e-3, shipped_cost=1.0, ratio=0.5, quantity="bar.angle", remains="")


@pytest.mark.parametrize(
    ("column", "cells", "was", "now"),
    [
        ("cost", [1.0, 3.0], "cost 2", "cost 3"),
        ("cost", [1.0, 2.001], None, None),
        ("recipe", ["RK4", "none"], "", "recipe none"),
    ],
)
def test_a_file_without_a_judge_is_compared_cell_by_cell(
    tmp_path: Path, column: str, cells: list[Any], was: str | None, now: str
) -> None:
    files = (
        {"further": {"advice.csv": frame}} for frame in (ADVICE, ADVICE.assign(**{column: cells}))
    )
    changes = found(tmp_path, *files).changes
    assert [(c.old, c.new) for c in changes] == (
        [] if was is None else [(Content(was), Content(now))]
    )
    for change in changes:
        assert (change.kind, change.place) == (CHANGED, ("swing", "mujoco", "0.001, 2, both"))


def test_a_file_of_one_folder_is_named(tmp_path: Path) -> None:
    part = found(tmp_path, {}, {"further": {"advice.csv": ADVICE}})
    assert (part.alone, part.changes) == (("advice.csv",), ())


CAUSE = Cause("swing", "mujoco", "tuned", "bar.angle", 2e-2, 1e-2, "RK4", "", 1e-3, 5e-3, 4.0, "")
UNASKED = replace(CAUSE, cure="not searched", step=None, error_after=None, cost=None)


def test_causes_are_compared_where_both_runs_searched_for_them(tmp_path: Path) -> None:
    """The committed reports have them, a plain run does not."""
    other = replace(CAUSE, quantity="bar.omega")
    old = {"causes": [CAUSE, other]}
    part = found(tmp_path / "a", old, {"causes": [UNASKED, replace(other, cure="the step")]})
    assert [(c.kind, c.place[2]) for c in part.changes] == [
        (LOST, "bar.omega, RK4"),
        (NEW, "bar.omega, the step"),
    ]
    assert part.counts["causes.csv"].searched == (1, 1)
    (line,) = [line for line in looked_at(part) if "causes" in line]
    assert line.startswith("not looked at: 1 row of OLD and 1 of NEW in causes.csv")
    moved = found(tmp_path / "b", old, {"causes": [replace(CAUSE, cost=8.0), other]})
    assert (only(moved).old, only(moved).new) == (Content("cost 4"), Content("cost 8"))
    assert not any("causes" in line for line in looked_at(moved))
    assert not found(tmp_path / "c", {"causes": [UNASKED]}, {"causes": []}).changes
