"""Which release a row is of: the one that was asked for, that ran, in the order of the words."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from given.command import NEW
from given.otherwise import otherwise
from given.report_folders import ROW, report

from textmech.cases.mistake import CaseError
from textmech.reports.output.diff.folder import opened
from textmech.reports.versions import install, measure, one, table
from textmech.reports.versions.measure import Measured
from textmech.reports.versions.wanted import Release


def measured(place: Path, version: str) -> Measured:
    """A release that was run, with one row."""
    folder = report(place / version, rows=[replace(ROW, version=version)])
    return Measured(Release("mujoco", version), opened({version: folder})[0])


def order(place: Path, versions: tuple[str, ...], module: Any = table) -> list[str]:
    found = module.steps([measured(place, version) for version in versions])
    return module.table(found, ["swing"])["version"].tolist()


@pytest.mark.slow
@pytest.mark.mutant("releases sorted as text, 3.10 before 3.9")
def test_releases_stand_in_the_order_in_which_they_are_named(tmp_path: Path) -> None:
    assert order(tmp_path, ("3.9.0", "3.10.0")) == ["3.9.0", "3.10.0"]
    assert order(tmp_path, ("4.0.0", "3.10.0", "3.9.0")) == ["4.0.0", "3.10.0", "3.9.0"]
    sorts = otherwise(table, '["engine", "case"], kind', '["engine", "case", "version"], kind')
    assert order(tmp_path, ("3.9.0", "3.10.0"), sorts) == ["3.10.0", "3.9.0"]


@pytest.mark.mutant("another release in the folder is taken")
def test_a_folder_holds_its_own_release_and_no_other(tmp_path: Path) -> None:
    info = tmp_path / "pymunk-7.3.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: pymunk\nVersion: 7.3.0\n")
    assert install._holds(tmp_path, Release("pymunk", "7.3.0"))
    assert not install._holds(tmp_path, Release("pymunk", "7.3.1"))
    assert not install._holds(tmp_path, Release("mujoco", "7.3.0"))
    was = "(one.name, one.version) == (release.engine, release.version)"
    any_release = otherwise(install, was, "one.name == release.engine")
    assert any_release._holds(tmp_path, Release("pymunk", "7.3.1"))


@pytest.mark.mutant("a release that was not run counts as measured")
def test_a_release_that_was_not_run_is_not_measured(tmp_path: Path) -> None:
    """Whatever lies in its folder; one that crashed, or is broken, says why."""
    release, out = Release("mujoco", "4.0.0"), report(tmp_path / "out")
    assert measure._measured(release, 0, out).folder is not None
    for code in (1, one.MISTAKEN):
        with pytest.raises(CaseError, match="was not run"):
            measure._measured(release, code, out)
    crashed = measure._measured(release, -9, out)
    assert (crashed.verdict, crashed.because) == ("crashed", "its process ended by signal 9")
    counts = otherwise(measure, "if code > 0:", "if code > 2:")
    assert counts._measured(release, one.MISTAKEN, out).folder is not None
    (out / one.BROKEN).write_text("no such module", encoding="utf-8")
    broken = measure._measured(release, 0, out)
    assert (broken.verdict, broken.because) == ("refused", "adapter: no such module")


def asked(place: Path, version: str, module: Any = one) -> int:
    """The exit code of a run of that release of MuJoCo in this environment."""
    place.mkdir()
    (place / "cart.yaml").write_text(NEW, encoding="utf-8")
    words = {"engine": "mujoco", "version": version, "cases": [str(place / "cart.yaml")]}
    return module.main(
        json.dumps({**words, "settings": ["shipped"], "folder": str(place), "jobs": 1,
                    "long": False})
    )  # fmt: skip


@pytest.mark.slow
@pytest.mark.mutant("another release than the one asked for is measured")
def test_another_release_than_the_one_asked_for_is_not_measured(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setenv("TEXTMECH_CACHE", str(tmp_path / "cache"))
    here = install.here("mujoco") or ""
    assert asked(tmp_path / "other", "0.1") == one.MISTAKEN
    assert f"mujoco 0.1 is asked for, and Python finds {here}" in capsys.readouterr().err
    assert [file.name for file in (tmp_path / "other").iterdir()] == ["cart.yaml"]
    assert asked(tmp_path / "same", here) == 0
    assert (tmp_path / "same" / "tolerance.csv").is_file()
    any_release = otherwise(one, "    if other:\n", "    if other and False:\n")
    assert asked(tmp_path / "any", "0.1", any_release) == 0
