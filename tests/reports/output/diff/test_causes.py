"""Cures are compared where both runs have searched for them."""

from dataclasses import replace
from pathlib import Path

from given.report_folders import report

from textmech.reports.data.row import Cause
from textmech.reports.output.diff.columns import LOST, NEW, Rule
from textmech.reports.output.diff.compare import Difference, Seen, difference
from textmech.reports.output.diff.folder import opened
from textmech.reports.output.diff.forms import looked_at

CAUSE = Cause("swing", "mujoco", "tuned", "bar.angle", 2e-2, 1e-2, "RK4", "", 1e-3, 5e-3, 4.0, "")
UNASKED = replace(CAUSE, cure="not searched", step=None, error_after=None, cost=None)


def found(folder: Path, old: list[Cause], new: list[Cause]) -> Difference:
    folders = {"OLD": report(folder / "old", causes=old), "NEW": report(folder / "new", causes=new)}
    before, after = opened(folders)
    return difference(before, after, Rule())


def test_causes_are_compared_where_both_runs_searched_for_them(tmp_path: Path) -> None:
    """The committed reports have them, a plain run does not."""
    other = replace(CAUSE, quantity="bar.omega")
    both = [CAUSE, other]
    part = found(tmp_path / "a", both, [UNASKED, replace(other, cure="the step")])
    assert [(c.kind, c.place.what) for c in part.changes] == [
        (LOST, "bar.omega, RK4"),
        (NEW, "bar.omega, the step"),
    ]
    assert part.counts["causes.csv"].searched == (1, 1)
    (told,) = [line for line in looked_at(part) if "causes" in line]
    assert told.startswith("not looked at: 1 row of OLD and 1 of NEW in causes.csv")
    moved = found(tmp_path / "b", both, [replace(CAUSE, cost=8.0), other])
    (change,) = moved.changes
    assert (change.was, change.now) == (Seen("cost 4"), Seen("cost 8"))
    assert not any("causes" in line for line in looked_at(moved))


def test_what_nobody_searched_is_neither_lost_nor_new(tmp_path: Path) -> None:
    cured = found(tmp_path, [UNASKED], [])
    assert not cured.changes
