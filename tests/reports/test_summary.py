"""The short table: its worst quantity, what agrees, what cures it, and the book's own lines."""

from math import inf, nan
from typing import Any

import pytest
from given.lines import ladder, refused, row
from given.otherwise import otherwise

from textmech.reports.data.row import CHANGED, DIVERGED, FAILS, Comparison
from textmech.reports.show import summary as agreement
from textmech.reports.show import summary as short
from textmech.reports.show.summary import Line, approximations, summary


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
