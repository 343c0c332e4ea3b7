"""What the page is told of a run: every number in its column, and what is counted of it."""

from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pytest
from given.otherwise import otherwise
from given.report_folders import CERTIFICATE, COVERED, INSTANT, ROW, RUNGS, STEPS

from textmech.reports.data.row import FAILS
from textmech.reports.page import overview, rows
from textmech.reports.page import page as trust
from textmech.reports.page.column import Column, column
from textmech.reports.page.folder import Folder
from textmech.reports.page.heat import Cell

# No two numbers of a row are the same: one in the place of another is seen.
COMPARED = replace(
    ROW, step=1e-3, error=2e-3, when=0.4, rms=3e-3, final=4e-3, allowed=1e-2, ratio=0.2,
    because="for a reason",
)  # fmt: skip
LADDER = replace(RUNGS, order=1.0, order_low=0.9, order_high=1.1, limit=5e-9, uncertainty=1e-6)
CHECK = replace(CERTIFICATE, difference=1e-14, bound=1e-9, certified=1e-12)
CLIMBED = [replace(step, error=3 * step.error) for step in STEPS]
OTHERS = [
    replace(step, **other, error=9.0)
    for step in STEPS
    for other in ({"ladder": "following"}, {"quantity": "bar.omega"}, {"engine": "pymunk"})
]
FOLDER = Folder([COMPARED], [LADDER], OTHERS + CLIMBED, [INSTANT], [CHECK], COVERED, {}, "run")
COLUMNS = [column(COMPARED)]


def told(module: Any = rows) -> dict[str, Any]:
    """The case's lists, with texts for the numbers of words."""
    found = module.rows(FOLDER, COLUMNS)
    words = {
        "rows": (1, 2, 8, 9), "ladders": (1, 2, 8), "instants": (1,), "checks": (0, 4, 5)
    }  # fmt: skip
    for kind, places in words.items():
        (row,) = found["cases"]["swing"][kind]
        for place in places:
            row[place] = found["words"][row[place]]
    return found["cases"]["swing"]


def test_every_number_stands_in_its_column() -> None:
    assert told() == {
        "rows": [
            [0, "bar.angle", "rad", 1e-3, 1e-2, 2e-3, 0.4, 0.2, "agrees", "for a reason"],
        ],
        "ladders": [
            [0, "bar.angle", "held", [1e-3, 2e-3], [3e-3, 6e-3], 1, 5e-9, 2e-3,
             "converges to the textbook"],
        ],
        "instants": [[0, "stops", 1, 0.451600756, 1e-9]],
        "checks": [["drift", 1e-14, 1e-9, 1e-12, "m", "holds"]],
        "causes": [],
    }  # fmt: skip


@pytest.mark.mutant("the page's {named}")
@pytest.mark.parametrize(
    ("named", "was", "now"),
    [
        ("rms told as the largest error", "_few(row.error)", "_few(row.rms)"),
        ("bound told as what is certified", "_few(check.certified)", "_few(check.bound)"),
        ("errors of a ladder told as its steps", "_few(one.error)", "_few(one.step)"),
        (
            "steps of a ladder told with those of the other",
            "rung.quantity, rung.ladder)",
            "rung.quantity, 'following')",
        ),
        ("units lost", "words.number(row.unit)", "words.number('')"),
        ("units of certificates lost", "words.number(check.unit)", "words.number('')"),
    ],
)
def test_a_number_of_another_column_is_seen(named: str, was: str, now: str) -> None:
    assert told(otherwise(rows, was, now)) != told()


def failing(module: Any = trust) -> int:
    checks = [CHECK, replace(CHECK, case="other", verdict=FAILS)]
    return module.trust(replace(FOLDER, certificates=checks))["failing"]


@pytest.mark.mutant("no check of a reference is told to fail")
def test_checks_that_fail_are_counted() -> None:
    assert failing() == 1
    assert failing(otherwise(trust, "sum(row.verdict == FAILS", "sum(False")) == 0


def share(within: int, judged: int, module: Any = overview) -> int:
    cell = Cell("beyond", "", beyond=judged - within, judged=judged)
    folder: Any = SimpleNamespace(comparisons=[COMPARED])
    (found,) = module.overview(folder, {("swing", COLUMNS[0]): cell}, COLUMNS)["shares"]
    return found["percent"]


@pytest.mark.slow
@pytest.mark.mutant("99.6 % is shown as all")
def test_only_all_is_a_hundred_percent() -> None:
    assert [share(n, 250) for n in (249, 250, 0)] == [99, 100, 0]
    whole = otherwise(overview, "100 * within // judged", "round(100 * within / judged)")
    assert share(249, 250, whole) == 100


@pytest.mark.mutant("twice what is allowed is within in the sentence of the result")
def test_the_result_is_one_sentence() -> None:
    """Each engine's settings in their order, counted in cases; of the book none, nor refusals."""
    within, beyond = replace(COMPARED, case="a"), replace(COMPARED, case="b", ratio=2.0)
    rows = [within, beyond, replace(within, setting="recommended"), replace(within, setting="mine"),
            replace(within, setting="shipped", ratio=5.0), replace(within, engine="pymunk"),
            replace(within, quantity="other", ratio=1.5), replace(within, engine="book"),
            replace(within, case="c", verdict="refused")]  # fmt: skip

    def told(module: Any = overview) -> str:
        return module.result(rows)

    assert told() == (
        "mujoco keeps every quantity within the textbook’s tolerance in 0 of 1 case as shipped, "
        "1 of 1 as its documentation recommends, 1 of 1 with mine and 0 of 2 tuned; "
        "pymunk in 1 of 1 tuned."
    )
    lax = otherwise(overview, "sum(ratio <= 1 for", "sum(ratio <= 2 for")
    assert "2 of 2 tuned" in told(lax)


@pytest.mark.mutant("what misses its tolerance is told to keep it, of one case")
def test_the_result_of_one_case_speaks_of_it() -> None:
    """Not of shares of one; by how much each setting misses, and what an engine cannot do."""
    kept = Cell("agrees", "0.5", "a", 0.5, judged=2)
    off = Cell("beyond", "7.9", "pin.force", 7.9, beyond=1, judged=2)
    cells = {
        ("swing", Column("mujoco", "shipped", "native")): off,
        ("swing", Column("mujoco", "tuned", "law")): kept,
        ("swing", Column("pymunk", "shipped", "native")): off,
        ("swing", Column("toy", "shipped", "native")): Cell("refused", "–"),
        ("swing", Column("book", "smooth", "native")): kept,
    }

    def told(module: Any = overview) -> str:
        return module.result_of_one(cells)

    assert told() == (
        "mujoco keeps all quantities of swing within their tolerances tuned with our force law, "
        "but not as shipped (pin.force ×7.9); pymunk does not keep them as shipped "
        "(pin.force ×7.9); toy does not support this scene."
    )
    lax = otherwise(overview, "if cell.within == cell.judged]", "if cell.judged]")
    assert "keeps them as shipped" in told(lax)


def kind(module: Any = trust) -> tuple[str, str]:
    """Of two checks of one kind: the worst case, and how much of its bound is used."""
    checks = [
        replace(CHECK, case="much of a small bound", difference=1e-12, bound=2e-12),
        replace(CHECK, case="little of a large bound", difference=1e-6, bound=1.0),
    ]
    (found,) = module.trust(replace(FOLDER, certificates=checks))["kinds"]
    return found["worst"], found["part"]


@pytest.mark.mutant("the worst check is the one with the {named}")
@pytest.mark.parametrize(
    ("named", "was", "now"),
    [
        ("largest difference", "row.difference / row.bound if", "row.difference if"),
        ("smallest part of its bound", "max(rows, key=part)", "min(rows, key=part)"),
    ],
)  # fmt: skip
def test_the_worst_check_uses_most_of_its_bound(named: str, was: str, now: str) -> None:
    assert kind() == ("much of a small bound", "0.5")
    assert kind(otherwise(trust, was, now))[0] == "little of a large bound"


@pytest.mark.mutant("a case that deviates as declared counts as within")
def test_a_case_is_within_where_all_of_it_agrees() -> None:
    kinds = ("agrees", "declared", "beyond", "refused")
    cells = {(kind, COLUMNS[0]): Cell(kind, "", judged=1) for kind in kinds}
    folder: Any = SimpleNamespace(comparisons=[COMPARED])

    def counted(module: Any = overview) -> tuple[int, int, int, int]:
        (found,) = module.overview(folder, cells, COLUMNS)["shares"]
        return found["cases_within"], found["declared"], found["cases"], found["refused"]

    assert counted() == (1, 1, 3, 1)
    lax = otherwise(overview, "cell.kind == AGREES for", 'cell.kind in (AGREES, "declared") for')
    assert counted(lax) == (2, 1, 3, 1)
