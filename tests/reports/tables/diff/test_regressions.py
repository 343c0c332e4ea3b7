"""What a difference is called, and the exit code that says so: each by a mistake that hides one."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given.command import textmech
from given.command.report_folders import CERTIFICATE, ROW, report
from given.otherwise import otherwise

from textmech.reports.tables.diff import columns, compare, forms
from textmech.reports.tables.diff.columns import NEW, WORSE, Rule
from textmech.reports.tables.diff.compare import Difference
from textmech.reports.tables.diff.folder import opened
from textmech.reports.tables.row import Cause

CAUSE = Cause(
    "swing", "mujoco", "tuned", "bar.angle", 2e-2, 1e-2, "softness", "{d: 0.9}", 1e-3, 5e-3, 4.0, ""
)


def found(place: Path, old: dict[str, Any], new: dict[str, Any], module: Any = compare) -> Any:
    """The difference of two small folders that have these rows."""
    place.mkdir(exist_ok=True)
    before, after = opened(
        {"OLD": report(place / "old", **old), "NEW": report(place / "new", **new)}
    )
    return module.difference(before, after, Rule())


def document(difference: Difference, module: Any = forms) -> Any:
    return json.loads(module.as_json(difference))["exit_code"]


@pytest.mark.mutant("`diff --json` always says exit code 0")
def test_the_document_says_the_exit_code_of_the_command(tmp_path: Path) -> None:
    worse = {"rows": [replace(ROW, verdict="beyond")]}
    changed = found(tmp_path, {}, worse)
    assert document(changed) == 1
    assert document(found(tmp_path / "same", {}, {})) == 0
    done = textmech("diff", tmp_path / "old", tmp_path / "new", "--json")
    assert (done.returncode, json.loads(done.stdout)["exit_code"]) == (1, 1)
    assert document(changed, otherwise(forms, "int(difference.regressed)", "0")) == 0


@pytest.mark.mutant("rows judged by what the old run allowed")
def test_a_row_is_judged_by_what_the_new_run_allows(tmp_path: Path) -> None:
    """Twice as large, and of no use to anyone where 10 rad are allowed: no regression."""
    now = {"rows": [replace(ROW, error=4e-3, allowed=10.0)]}
    (change,) = found(tmp_path / "new", {}, now).changes
    assert (change.kind == WORSE, change.allowed) == (False, 10.0)
    was = "for row in (*old.errors, *new.errors)"
    by_the_old = otherwise(compare, was, "for row in (*new.errors, *old.errors)")
    (change,) = found(tmp_path / "old", {}, now, by_the_old).changes
    assert (change.kind, change.allowed) == (WORSE, ROW.allowed)


@pytest.mark.slow
@pytest.mark.mutant("a cure with other options is the same")
def test_a_cure_with_other_options_is_another(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rows = {"causes": [CAUSE]}, {"causes": [replace(CAUSE, options="{d: 0.99}")]}
    (change,) = found(tmp_path / "sound", *rows).changes
    assert (change.file, change.old.words, change.new.words) == (
        "causes.csv", "options {d: 0.9}", "options {d: 0.99}"
    )  # fmt: skip
    blind = otherwise(columns, '"allowed", "options", "step"', '"allowed", "step"')
    monkeypatch.setitem(compare.KNOWN, "causes.csv", blind.CAUSES)  # type: ignore[arg-type]
    assert found(tmp_path / "blind", *rows).changes == ()


@pytest.mark.mutant("a new check that fails is no regression")
@pytest.mark.parametrize(("verdict", "kind"), [("holds", NEW), ("FAILS", WORSE)])
def test_a_check_that_is_new_and_fails_is_a_regression(
    tmp_path: Path, verdict: str, kind: str
) -> None:
    other = replace(CERTIFICATE, check="power balance", verdict=verdict)
    rows = {}, {"certificates": [CERTIFICATE, other]}
    difference = found(tmp_path / "sound", *rows)
    assert [change.kind for change in difference.changes] == [kind]
    assert difference.regressed == (kind == WORSE)
    blind = otherwise(compare, 'WORSE if now.get("verdict") == FAILS else NEW', "NEW")
    changes = found(tmp_path / "blind", *rows, blind).changes
    assert [change.kind for change in changes] == [NEW]
