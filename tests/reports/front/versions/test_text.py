"""The table of releases: as wide as the terminal, and what a release lacks is said once."""

from dataclasses import replace
from pathlib import Path

import pytest
from given.command.report_folders import ROW, report

from textmech.reports.front.versions.measure import Measured
from textmech.reports.front.versions.release import Release
from textmech.reports.front.versions.table import table, text
from textmech.reports.tables.diff.folder import opened

NONE = replace(ROW, quantity="touch.force", error=None)
REFUSED = replace(NONE, verdict="refused", because="engine: no sensor")


@pytest.fixture
def found(tmp_path: Path) -> list[Measured]:
    """Nine releases, the sixth of which moved the angle, the seventh has a sensor."""
    measured = []
    for i in range(1, 10):
        angle = replace(ROW, version=f"1.{i}", error=2e-3 if i < 6 else 1e-3)
        force = replace(REFUSED, version=f"1.{i}")
        if i > 6:
            force = replace(force, verdict="agrees", error=1e-4)
        (folder,) = opened({str(i): report(tmp_path / str(i), rows=[angle, force])})
        measured.append(Measured(Release("mujoco", f"1.{i}"), folder))
    return measured


@pytest.mark.slow
def test_each_release_is_compared_with_the_one_before(found: list[Measured]) -> None:
    frame = table(found, ["swing"])
    moved = frame[frame["moved"] == "yes"]
    assert moved[["version", "quantity", "change"]].to_numpy().tolist() == [
        ["1.6", "bar.angle", "better"],
        ["1.7", "touch.force", "better"],
    ]


@pytest.mark.slow
def test_the_table_has_all_releases_where_they_fit(found: list[Measured]) -> None:
    lines = text(table(found, ["swing"]), 120).splitlines()
    assert lines[1:4] == [
        "  1.1: 1 number",
        "    1 without: refused: engine: no sensor",
        "  1.2: 1 number, 0 moved since 1.1",
    ]
    assert "  1.6: 1 number, 1 moved since 1.5" in lines
    assert "  1.7: 2 numbers, 0 moved since 1.6" in lines
    head, *rest = lines[lines.index("") + 1 :]
    assert head.split() == ["*", "moved", *(f"1.{i}" for i in range(1, 10))]
    assert [line.split() for line in rest] == [
        ["swing", "mujoco.tuned"],
        ["bar.angle", "rad", *["0.002"] * 5, "*0.001", *["0.001"] * 3],
    ]


@pytest.mark.slow
def test_where_they_do_not_it_has_those_that_moved_something(found: list[Measured]) -> None:
    head, _, row = text(table(found, ["swing"]), 80).splitlines()[-3:]
    assert head.split() == ["*", "moved", "1.1", "1.6"]
    assert row.split() == ["bar.angle", "rad", "0.002", "*0.001"]


@pytest.mark.slow
def test_a_release_that_could_not_be_run_is_passed_over(found: list[Measured]) -> None:
    lost = Measured(Release("mujoco", "1.55"), None, "crashed", "its process ended by signal 11")
    lines = text(table([*found[:5], lost, *found[5:]], ["swing"]), 120).splitlines()
    assert "  1.55: crashed: its process ended by signal 11" in lines
    assert "  1.6: 1 number, 1 moved since 1.5" in lines
    assert "1.55" not in " ".join(lines[lines.index("") :])


@pytest.mark.slow
def test_engines_stand_by_themselves_in_whatever_order_they_are_named(
    found: list[Measured],
) -> None:
    other = Measured(Release("pymunk", "7.0"), None, "refused", "adapter: no batch")
    third = Measured(Release("pymunk", "7.1"), None, "refused", "adapter: no batch")
    shown = text(table([other, *found[:2], third], ["swing"]), 80).splitlines()
    assert [line for line in shown if line and line[0] != " "] == ["mujoco", "pymunk"]
