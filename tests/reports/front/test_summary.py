"""What a run shows on a terminal: rows, the short table, cures."""

from dataclasses import replace
from math import inf, nan
from pathlib import Path
from typing import Any

import pytest
from given.command.lines import ladder, refused, row
from given.otherwise import otherwise
from given.scenes.swing import SWING

from textmech.cases.load import load
from textmech.reports.front.show import cures, terminal
from textmech.reports.front.show import summary as agreement
from textmech.reports.front.show import summary as short
from textmech.reports.front.show.summary import Line, approximations, summary
from textmech.reports.front.show.table import WIDTH, markdown, narrow, page
from textmech.reports.front.show.terminal import certificate_lines, rows
from textmech.reports.runs.selection import choose_cases
from textmech.reports.runs.suite import Report
from textmech.reports.tables import write
from textmech.reports.tables.row import (
    CHANGED,
    DIVERGED,
    FAILS,
    Cause,
    Certificate,
    Comparison,
    Rungs,
)

# The short table: its worst quantity, what agrees, what cures it, and the book's own lines.


def line(*rows: Comparison, rungs: tuple = (), **cures: str) -> Line:
    known = {("swing", "mujoco", "shipped", name): cure for name, cure in cures.items()}
    (found,) = summary(rows, rungs, known)
    return found


@pytest.mark.parametrize(
    ("rows", "worst"),
    [
        ([row()], "agrees"),
        ([row(), row(ratio=12.0, quantity="rod.omega")], "rod.omega ×12"),
        ([row(), row(ratio=12.0, quantity="arm.omega")], "arm.omega ×12"),
        ([row(ratio=3.0), row(ratio=340.0, quantity="b.x")], "b.x ×340"),
        ([row(ratio=1.04)], "rod.angle ×1.04"),
        ([row(ratio=13456.0)], "rod.angle ×1.3e4"),
        ([row(ratio=inf)], "rod.angle ×inf"),
        ([row(ratio=2.0), row(ratio=nan, quantity="b.x")], "b.x ×inf"),
        ([row(), refused(quantity="b.x")], "agrees, 1 not read"),
        ([refused()], "refused"),
        ([row(ratio=None, verdict=DIVERGED)], "diverged"),
        ([row(verdict=CHANGED), row(quantity="b.x")], "changed, agrees"),
    ],
)
def test_the_worst_quantity_over_what_is_allowed(rows: list[Comparison], worst: str) -> None:
    assert line(*rows).worst == worst


def test_an_audit_is_no_quantity() -> None:
    assert line(row(), row(ratio=1e6, quantity="audit")).worst == "agrees"


@pytest.mark.parametrize(
    ("rows", "rungs", "agrees"),
    [
        # Beyond as shipped, and from a step on within: that is what agrees.
        ([row(ratio=3.0)], [ladder(5e-4)], "shipped 0.5 ms"),
        ([row(ratio=3.0)], [ladder(None)], ""),  # nobody asked for the best
        ([row(ratio=3.0), row("tuned", 3.0)], [ladder(None)], "none"),
        # The largest step, of what the engine itself does.
        ([row(ratio=3.0), row("tuned")], [ladder(5e-4), ladder(8e-3, "tuned")], "tuned 8 ms"),
        ([row(), row("tuned")], [ladder(8e-3), ladder(8e-3, "tuned")], "shipped 8 ms"),
        ([row("mine"), row(ratio=3.0)], [ladder(4e-3, "mine"), ladder(None)], "mine 4 ms"),
        # One quantity that no step brings within is enough for none.
        (
            [row(ratio=3.0), row(ratio=3.0, quantity="b.x")],
            [ladder(5e-4), ladder(None, quantity="b.x")],
            "",
        ),
        # What is on no ladder has to be within where it was judged.
        ([row(ratio=3.0), row(ratio=2.0, quantity="lands.count")], [ladder(5e-4)], ""),
        ([row(), row(quantity="lands.count")], [ladder(None)], "shipped 2 ms"),
        ([row("tuned", step=None)], [], "tuned"),  # states
        ([refused(), row("tuned", realised="law")], [ladder(2e-3, "tuned", "law")], "law 2 ms"),
        (
            [row("tuned"), row("tuned", realised="law")],
            [ladder(1e-3, "tuned"), ladder(8e-3, "tuned", "law")],
            "tuned 1 ms",
        ),
        ([refused()], [], ""),
        ([row(ratio=None, verdict=DIVERGED)], [], ""),
        ([row(), row("tuned", 2.0, verdict=FAILS)], [ladder(2e-3)], "tuned FAILS; shipped 2 ms"),
        ([row("tuned", 6.5e-9, verdict=FAILS)], [], "tuned FAILS; tuned 2 ms"),
    ],
)
def test_what_agrees_at_the_largest_step(rows: list[Comparison], rungs: list, agrees: str) -> None:
    assert {found.agrees for found in summary(rows, rungs)} == {agrees}


def test_shipped_and_the_users_own_have_a_line_and_tuned_only_where_it_is_alone() -> None:
    rows = [row("tuned"), row("mine"), row(), row("tuned", realised="law")]
    settings = [found.setting for found in summary(rows, [])]
    assert settings == ["mujoco.shipped", "mujoco.mine"]
    assert [found.setting for found in summary([row("tuned")], [])] == ["mujoco.tuned"]
    only = [row("tuned", realised="law"), row("tuned", realised="driver")]
    assert [found.setting for found in summary(only, [])] == ["mujoco.tuned"]


def test_the_cure_is_that_of_the_worst_quantity() -> None:
    rows = row(ratio=3.0, quantity="crank"), row(ratio=9.0, quantity="rocker")
    assert line(*rows, crank="RK4", rocker="RK4, or the step").cured == "RK4, or the step"
    assert line(*rows, crank="RK4").cured == ""
    assert line(row(quantity="crank"), crank="RK4").cured == ""


def test_the_books_approximations_are_told_apart() -> None:
    book = row("boxcar", 5.0, engine="book"), row("karnopp", engine="book")
    rungs = [ladder(1e-4, "boxcar", engine="book"), ladder(1e-3, "karnopp", engine="book")]
    assert approximations([row(), *book], rungs) == [
        Line("swing", "book.boxcar", "rod.angle ×5", "0.1 ms", ""),
        Line("swing", "book.karnopp", "agrees", "1 ms", ""),
    ]
    assert [found.setting for found in summary([row(), *book], rungs)] == ["mujoco.shipped"]


def told(module: Any = short) -> list[tuple[str, str, str, str]]:
    """Two engines of which nothing is alike."""
    rows = [row(ratio=3.0), row(ratio=7.0, engine="pymunk")]
    rungs = [ladder(5e-4), ladder(2.5e-4, engine="pymunk")]
    cures = {("swing", r.engine, "shipped", "rod.angle"): f"{r.engine}'s" for r in rows}
    found = module.summary(rows, rungs, cures)
    return [(one.setting, one.worst, one.agrees, one.cured) for one in found]


@pytest.mark.mutant("the engines of the README's tables exchanged")
def test_each_engine_has_its_own_numbers() -> None:
    assert told() == [
        ("mujoco.shipped", "rod.angle ×3", "shipped 0.5 ms", "mujoco's"),
        ("pymunk.shipped", "rod.angle ×7", "shipped 0.25 ms", "pymunk's"),
    ]
    other = '{"mujoco": "pymunk", "pymunk": "mujoco"}[engine]'
    exchanged = told(otherwise(short, "yield case, engine, ways", f"yield case, {other}, ways"))
    assert [line[:2] for line in exchanged] == [
        ("pymunk.shipped", "rod.angle ×3"),
        ("mujoco.shipped", "rod.angle ×7"),
    ]


def usable(steps: list[float | None], module: Any = agreement) -> str:
    """With what a case agrees of which the quantities have these usable steps."""
    rows = [row(ratio=3.0, quantity=f"x{k}") for k in range(len(steps))]
    rungs = [ladder(step, quantity=f"x{k}") for k, step in enumerate(steps)]
    way = ("shipped", "native")
    return module.agreement({way: rows}, {way: rungs})


@pytest.mark.mutant("it agrees up to the largest of all usable steps")
def test_all_quantities_agree_up_to_the_smallest_of_their_steps() -> None:
    assert usable([2e-3, 5e-4, 1e-3]) == "shipped 0.5 ms"
    assert usable([2e-3, None]) == ""
    assert usable([2e-3, 5e-4], otherwise(agreement, "return min(known)", "return max(known)")) == (
        "shipped 2 ms"
    )


# Tables for a terminal of 80 columns and for a page.

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


# The rows of a run on a terminal of 80 columns.

LONG_REASON = (
    "does not vanish with the step: 0.346 stay; "
    + "one number for friction where there are two; " * 3
)


def test_a_setting_has_its_step_and_each_quantity_its_bound() -> None:
    found = [row(), row(quantity="rod.omega", error=0.2, ratio=20.0, because="the step")]
    assert list(rows(found)) == [
        "",
        "swing in mujoco 4.0.0 shipped (defaults), h = 2 ms",
        "  rod.angle  1.00e-03 rad  of 1.0e-02   agrees",
        "  rod.omega  2.00e-01 rad  of 1.0e-02   too far off",
        "      the step",
    ]


def test_a_reason_that_rows_share_is_told_once() -> None:
    twice = [row(quantity=name, ratio=2.0, because="the step") for name in ("a.x", "b.x")]
    other = row(quantity="c.x", ratio=2.0, because="the model")
    assert [line.split()[0] for line in list(rows([*twice, other]))[2:]] == [
        "a.x",
        "b.x",
        "the",
        "c.x",
        "the",
    ]


def test_what_agrees_needs_no_reason() -> None:
    assert "read back" not in "\n".join(rows([row(because="6 numbers read back")]))


def test_what_is_refused_is_named_together() -> None:
    names = [refused(quantity=name) for name in ("a.x", "b.x")]
    assert list(rows([row(), *names]))[3:] == ["  a.x, b.x", "      not supported: engine: no"]
    assert list(rows([refused(because="why")]))[1:] == [
        "swing in mujoco 4.0.0 shipped (defaults)",
        "  rod.angle",
        "      not supported: why",
    ]


def test_nothing_is_wider_than_a_terminal() -> None:
    found = [row(protocol=LONG_REASON), row(quantity="b.x", ratio=2.0, because=LONG_REASON)]
    found += [
        row("tuned", realised="law"),
        *(refused("tuned", quantity=f"q{i}") for i in range(40)),
    ]
    lines = list(rows(found))
    assert max(map(len, lines)) <= 80
    assert "swing in mujoco 4.0.0 tuned (best found, our force law), h = 2 ms" in lines
    assert LONG_REASON.split() == " ".join(lines[2:5]).split()


def test_what_a_reference_is_certified_to(capsys: pytest.CaptureFixture[str]) -> None:
    angle = "error of rod.angle"
    certified = Certificate("swing", "", "generated", angle, 3e-10, 0.01, 3e-12, "rad", "holds")
    law = Certificate("swing", "", "generated", "power balance", 1e-16, 1e-12, None, "", "holds")
    assert list(certificate_lines([law])) == []
    said = "swing: the reference is certified: rod.angle to 3e-12 rad"
    assert list(certificate_lines([law, certified])) == ["", said]
    for detailed in (True, False):
        terminal.show(Report(certificates=[law, certified]), detailed=detailed, written=None)
        assert (said in capsys.readouterr().out) == detailed
    assert max(map(len, certificate_lines([certified] * 9))) <= 80
    broken = replace(law, verdict=FAILS)
    assert [*certificate_lines([broken, certified])] == []  # nothing is known of what breaks


# Cures from the report of causes: joined by row, and of a user's own case none.

HEAD = "case,engine,setting,quantity,error,allowed,cure,options,step,error_after,cost,law\n"
ROWS = """\
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,RK4,{integrator: RK4},0.002,1e-7,4,
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,step,{},0.0005,0.6,4,h^1
bar_pendulum,mujoco,shipped,energy.total,2.4,0.01,implicit + midpoint,{},0.002,0.6,9,
bar_pendulum,pymunk,shipped,bar.angle,340,0.01,error_bias 0 + step,{error_bias: 0},0.00125,,20,
bar_pendulum,pymunk,shipped,b.x,340,0.01,our force law in place of its own,,,,,
bar_pendulum,pymunk,shipped,hinge.gap,340,0.01,not searched,,,,,
"""


def test_without_the_report_nothing_is_known(tmp_path: Path) -> None:
    assert cures.cures(tmp_path) == {}


def test_the_two_cheapest_cures_of_a_row_are_joined_and_steps_told(tmp_path: Path) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    assert cures.cures(tmp_path) == {
        ("bar_pendulum", "mujoco", "shipped", "energy.total"): "RK4 or step 0.5 ms",
        ("bar_pendulum", "pymunk", "shipped", "bar.angle"): "error_bias 0 + step 1.25 ms",
        ("bar_pendulum", "pymunk", "shipped", "b.x"): "our force law",
    }


def test_a_case_of_ones_own_has_none_of_a_shipped_ones(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / cures.NAME).write_text(HEAD + ROWS, encoding="utf-8")
    monkeypatch.setattr(cures, "HERE", tmp_path)
    assert len(cures.committed(choose_cases(["bar_pendulum"]))) == 3
    own = tmp_path / "bar_pendulum.yaml"
    own.write_text(SWING, encoding="utf-8")
    assert cures.committed(load(own)) == {}


def test_what_a_run_has_searched_is_told_alike() -> None:
    one = Cause("mine", "mujoco", "shipped", "b.x", 2.0, 1.0, "step", "{}", 5e-4, 0.6, 4.0, "h^1")
    none = replace(one, quantity="b.y", cure="not searched", step=None)
    both = replace(one, cure="RK4", options="{integrator: RK4}", step=2e-3)
    assert cures.found_cures([both, one, none]) == {
        ("mine", "mujoco", "shipped", "b.x"): "RK4 or step 0.5 ms"
    }
