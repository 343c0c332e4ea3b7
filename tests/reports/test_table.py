"""Tables for a terminal of 80 columns and for a page."""

import pytest

from textmech.reports.data.row import Comparison, Rungs
from textmech.reports.output import write
from textmech.reports.show.summary import Line, approximations, summary
from textmech.reports.show.table import WIDTH, markdown, narrow, page

LONG = "RK4 with the connects' softness: 8h, hard, or a step of 0.125 ms"
LINES = [
    Line("four_bar", "mujoco.shipped", "A.force ×220", "tuned 1.6 ms", LONG),
    Line("four_bar", "pymunk.shipped", "energy.total ×470", "tuned 0.8 ms", ""),
    Line("rhombus", "mujoco.shipped", "agrees", "shipped 2 ms", ""),
]


def test_below_a_case_are_its_settings_and_long_words_are_broken_in_their_column() -> None:
    head, *lines = narrow(LINES).splitlines()
    assert head.endswith("  cured by")
    assert [line for line in lines if not line.startswith(" ")] == ["four_bar", "rhombus"]
    column = head.index("cured by")
    assert " ".join(line[column:] for line in lines).split() == LONG.split()
    assert all(len(line) <= WIDTH for line in (head, *lines))


def test_a_column_of_which_nothing_is_known_is_left_out() -> None:
    assert "cured by" not in narrow(LINES[1:])
    assert page(LINES[1:])[0] == ["case", "setting", "worst, × allowed", "agrees with"]


def test_a_name_is_never_broken() -> None:
    name = "mujoco." + "m" * 90
    assert f"  {name}" in narrow([Line("c", name, "a b ×2", "none", "x y")])


@pytest.mark.slow
def test_the_committed_reports_fit() -> None:
    rows = write.read(write.HERE / "tolerance.csv", Comparison)
    rungs = write.read(write.HERE / "convergence.csv", Rungs)
    cures = {(r.case, r.engine, r.setting, r.quantity): LONG for r in rows}
    for known in ({}, cures):
        for lines in (summary(rows, rungs, known), approximations(rows, rungs)):
            assert lines
            assert max(map(len, narrow(lines).splitlines())) <= WIDTH


def test_a_page_names_a_case_once() -> None:
    text = markdown(page(LINES))
    assert text.splitlines()[2:4] == [
        f"| `four_bar` | mujoco.shipped | A.force ×220 | tuned 1.6 ms | {LONG} |",
        "|  | pymunk.shipped | energy.total ×470 | tuned 0.8 ms |  |",
    ]
