"""Which release a row is of: the one that was asked for, that ran, in the order of the words."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given.command.report_folders import ROW, report
from given.otherwise import otherwise

from textmech.cases.mistake import CaseError, Mistake
from textmech.reports.front.versions import measure, table
from textmech.reports.front.versions.measure import Measured
from textmech.reports.front.versions.release import Release
from textmech.reports.tables.diff.folder import opened


def measured(place: Path, version: str) -> Measured:
    """A release that was run, with one row."""
    folder = report(place / version, rows=[replace(ROW, version=version)])
    return Measured(Release("mujoco", version), opened({version: folder})[0])


def order(place: Path, versions: tuple[str, ...], module: Any = table) -> list[str]:
    found = [measured(place, version) for version in versions]
    return module.table(found, ["swing"])["version"].tolist()


@pytest.mark.slow
@pytest.mark.mutant("releases sorted as text, 3.10 before 3.9")
def test_releases_stand_in_the_order_in_which_they_are_named(tmp_path: Path) -> None:
    assert order(tmp_path, ("3.9.0", "3.10.0")) == ["3.9.0", "3.10.0"]
    assert order(tmp_path, ("4.0.0", "3.10.0", "3.9.0")) == ["4.0.0", "3.10.0", "3.9.0"]
    sorts = otherwise(table, '["engine", "case"], kind', '["engine", "case", "version"], kind')
    assert order(tmp_path, ("3.9.0", "3.10.0"), sorts) == ["3.10.0", "3.9.0"]


ASKED = ("--engine", "--settings", "mine.yaml")


def document(*mistakes: Mistake) -> str:
    """The document of a run that ended with these mistakes."""
    told = [{"file": m.file, "line": 0, "column": 0, "field": "", "what": m.what} for m in mistakes]
    return json.dumps({"mistakes": told, "exit_code": 2})


@pytest.mark.mutant("a release that was not run counts as measured")
def test_a_release_that_was_not_run_is_not_measured(tmp_path: Path) -> None:
    """Whatever lies in its folder; one that crashed, or is broken, says why."""
    release, out = Release("mujoco", "4.0.0"), report(tmp_path / "out")
    for code in (0, 1):
        assert measure._measured(release, code, "{", out, ASKED).folder is not None
    wrong = Mistake("cart.yaml", 0, 0, "", "no reference")
    nothing = tmp_path / "nothing"
    for code, said, place in ((2, "", out), (2, document(wrong), out), (1, "", nothing)):
        with pytest.raises(CaseError, match="was not run"):
            measure._measured(release, code, said, place, ASKED)
    crashed = measure._measured(release, -9, "", out, ASKED)
    assert (crashed.verdict, crashed.because) == ("crashed", "its process ended by signal 9")
    counts = otherwise(measure, "DONE = (0, 1)", "DONE = (0, 1, 2)")
    assert counts._measured(release, 2, document(wrong), out, ASKED).folder is not None


@pytest.mark.mutant("a mistake in a case is taken for what a release lacks")
def test_what_a_release_says_of_its_own_settings_is_what_it_lacks(tmp_path: Path) -> None:
    release, out = Release("mujoco", "4.0.0"), report(tmp_path / "out")
    lacking = Mistake("--engine", 0, 0, "", "no such module"), Mistake("mine.yaml", 0, 0, "", "x")
    broken = measure._measured(release, 2, document(*lacking), out, ASKED)
    assert (broken.verdict, broken.because) == ("refused", "adapter: no such module; x")
    mixed = document(*lacking, Mistake("cart.yaml", 0, 0, "", "no reference"))
    with pytest.raises(CaseError, match="was not run"):
        measure._measured(release, 2, mixed, out, ASKED)
    any_mistake = otherwise(
        measure, "all(Path(mistake.file) in own", "any(Path(mistake.file) in own"
    )
    assert any_mistake._measured(release, 2, mixed, out, ASKED).verdict == "refused"


@pytest.mark.mutant("a model that a release does not compile costs all other files")
def test_a_model_that_a_release_does_not_compile_costs_that_model_alone(tmp_path: Path) -> None:
    release, out = Release("mujoco", "4.0.0"), report(tmp_path / "out")
    said = document(Mistake("robot.xml", 0, 0, "", "no such element"))
    asked = release, 2, said, out, ASKED, ["robot.xml"]
    assert measure._measured(*asked).folder is not None
    alone = measure._measured(release, 2, said, tmp_path, ASKED, ["robot.xml"])
    assert (alone.verdict, alone.because) == ("refused", "adapter: no such element")
    with pytest.raises(CaseError, match="was not run"):
        measure._measured(release, 2, said, out, ASKED, ["other.xml"])
    all_files = otherwise(measure, "(some or code in DONE)", "(code in DONE)")
    assert all_files._measured(*asked).folder is None


@pytest.mark.mutant("another release than the one asked for is measured")
def test_another_release_than_the_one_asked_for_is_not_measured(tmp_path: Path) -> None:
    out = report(tmp_path / "out", rows=[replace(ROW, version="4.0.0")])
    other = Release("mujoco", "0.1"), 0, "", out, ASKED
    with pytest.raises(CaseError, match=r"is asked for, and Python finds 4\.0\.0"):
        measure._measured(*other)
    any_release = otherwise(measure, "or not alike(version, release.version)", "")
    assert any_release._measured(*other).folder is not None
