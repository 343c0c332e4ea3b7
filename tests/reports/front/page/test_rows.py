"""What the page is told of a run: each number in its column, and what is counted of them."""

from collections.abc import Mapping
from dataclasses import replace
from types import SimpleNamespace
from typing import Any

import pandas as pd
import pytest
from given.command.report_folders import CERTIFICATE, COVERED, INSTANT, ROW, RUNGS, STEPS
from given.otherwise import otherwise

from textmech.reports.front.page import advice as advised
from textmech.reports.front.page import beside, heat, overview, rows
from textmech.reports.front.page import page as trust
from textmech.reports.front.page.advice import advice
from textmech.reports.front.page.beside import causes, versions
from textmech.reports.front.page.column import Column, column, columns
from textmech.reports.front.page.folder import Folder
from textmech.reports.front.page.heat import Cell, cells, short
from textmech.reports.front.page.work import enough, profile, work, worst
from textmech.reports.tables.row import AGREES, BEYOND, DEVIATES, DIVERGED, FAILS, StepError

# What the page is told of a run: every number in its column, and what is counted of it.

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
FOLDER = Folder([COMPARED], [LADDER], OTHERS + CLIMBED, [INSTANT], [CHECK], [], COVERED, {}, "run")
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
        ("errors of a ladder told as its steps", "_few(step.error)", "_few(step.step)"),
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


# Cells of the heat map: the gravest verdict, the worst error, and a shade for its size.

COUNTED = replace(
    ROW, case="c", quantity="x", unit="m", step=0.1, allowed=2.0, ratio=0.5, because="why"
)


def cell(*changes: dict[str, Any]) -> Cell:
    rows = [replace(COUNTED, **{"quantity": f"x{k}", **change}) for k, change in enumerate(changes)]
    (found,) = cells(rows, []).values()
    return found


def test_the_worst_error_is_told_with_its_quantity() -> None:
    found = cell({"ratio": 0.5}, {"ratio": 470.0, "verdict": BEYOND}, {"ratio": 3.0})
    assert (found.kind, found.text, found.worst, found.shade) == ("beyond", "470", "x1", 6)
    assert (found.beyond, found.judged, found.within) == (2, 3, 1)
    assert found.words == "2 of 3 too far off; worst x1 at 470 of what is allowed"


@pytest.mark.parametrize(
    ("verdicts", "kind"),
    [
        ([AGREES, AGREES], "agrees"),
        ([AGREES, DEVIATES], "declared"),
        ([DEVIATES, BEYOND], "beyond"),
        ([BEYOND, "changed"], "changed"),
        ([BEYOND, DIVERGED], "diverged"),
        ([DIVERGED, FAILS], "fails"),
        ([AGREES, "refused"], "agrees"),
    ],
)
def test_the_gravest_verdict_counts(verdicts: list[str], kind: str) -> None:
    assert cell(*({"verdict": verdict} for verdict in verdicts)).kind == kind


def test_what_is_refused_as_a_whole_says_why_and_has_no_size() -> None:
    why = "not supported: engine: it cannot"
    found = cell({"verdict": "refused", "because": "engine: it cannot", "ratio": None})
    assert (found.kind, found.words, found.shade, found.judged) == ("refused", why, 0, 0)


def test_a_lost_run_is_as_dark_as_the_worst_and_has_nothing_within() -> None:
    found = cell({"verdict": DIVERGED, "ratio": None, "because": "too far"})
    assert (found.shade, found.within, found.words) == (7, 0, "too far")


def test_just_allowed_is_within_and_the_next_is_not() -> None:
    shades = [cell({"ratio": ratio}).shade for ratio in (0.0, 1e-3, 0.5, 1.0, 1.01, 10.0, 1e9)]
    assert shades == [0, 0, 3, 3, 4, 4, 7]


def test_the_audit_is_no_quantity() -> None:
    assert cells([replace(COUNTED, quantity="audit")], []) == {}


@pytest.mark.parametrize(
    ("ratio", "text"),
    [
        (0.0, "0"),
        (2.34, "2.3"),
        (0.021, "0.021"),
        (473.0, "473"),
        (99.7, "100"),
        (3.2e-7, "3e-7"),
        (1.3e5, "1e5"),
    ],
)
def test_a_ratio_is_short(ratio: float, text: str) -> None:
    assert short(ratio) == text


def test_columns_go_from_shipped_to_own_to_tuned_and_the_book_is_last() -> None:
    names = [("pymunk", "tuned", "law"), ("book", "smooth", "native"), ("mujoco", "mine", "native"),
             ("mujoco", "tuned", "native"), ("mujoco", "shipped", "native")]  # fmt: skip
    rows = [replace(COUNTED, engine=e, setting=s, realised=r) for e, s, r in names]
    assert [one.title for one in columns(rows)] == [
        "mujoco shipped", "mujoco mine", "mujoco tuned", "pymunk tuned + our force law",
        "book smooth",
    ]  # fmt: skip
    assert column(rows[0]) == Column("pymunk", "tuned", "law")


def usable(steps: list[float | None], module: Any = heat) -> float | None:
    """The step of a cell whose quantities have these."""
    ladders = [replace(RUNGS, usable_step=step, quantity=f"x{k}") for k, step in enumerate(steps)]
    row = replace(COUNTED, engine=RUNGS.engine, setting=RUNGS.setting, case=RUNGS.case)
    (found,) = module.cells([row], ladders).values()
    return found.step


@pytest.mark.mutant("the step from which on all is within is the largest of all")
def test_all_is_within_from_the_smallest_of_the_usable_steps_on() -> None:
    assert usable([4e-3, 1e-3, 2e-3]) == 1e-3
    assert usable([4e-3, None, 2e-3]) is None
    assert (
        usable([4e-3, 1e-3], otherwise(heat, "min(known) if known", "max(known) if known")) == 4e-3
    )


# Tables that other commands write, as the page sums them up: counted by hand.


def frame_of(text: str) -> pd.DataFrame:
    head, *lines = [line.split() for line in text.strip().splitlines()]
    cells = [[cell.strip("-").replace("_", " ") for cell in line] for line in lines]
    return pd.DataFrame(cells, columns=head)


ADVISED = frame_of("""
case engine tolerance margin want     recipe settings step   cost shipped_cost ratio
a    mujoco -         2      both     RK4    o1       0.008  500  500          0.1
b    mujoco -         2      cheapest RK4    o2       0.001  4000 500          0.2
b    mujoco -         2      fewest_changes many o5   0.0001 9000 500          0.2
c    mujoco -         2      both     bundle o3       0.0001 9    500          0.3
d    mujoco -         2      -        none   -        -      -    500          12
e    mujoco -         2      -        none   -        -      -    -            -
a    mujoco 1e-3      2      both     RK4    o4       0.008  500  500          0.1
""")  # what is refused, as e, was never off by anything, and needs no setting
SELDOM = frame_of("""
case engine tolerance margin want recipe settings step cost shipped_cost ratio
a    mujoco -         2      both RK4    o1       0.01 500  500          0.1
b    mujoco -         2      both bundle o2       0.01 500  500          0.1
c    mujoco -         2      both midway o3       0.01 500  500          0.1
""")
ABOUT = dict.fromkeys("abce", ("pins",)) | {"d": ("pins", "space")}


@pytest.mark.mutant("a setting that keeps a third of a theme's cases is what the theme needs")
def test_where_less_than_half_need_a_setting_there_is_no_one() -> None:
    def most(module: Any = advised) -> bool:
        return module.advice(SELDOM, ABOUT)["themes"][0]["most"]

    assert not most()
    assert most(otherwise(advised, "2 * len(usual) >=", "3 * len(usual) >="))


def test_a_theme_needs_what_most_of_its_cases_need_at_the_smallest_of_their_steps() -> None:
    found = advice(ADVISED, ABOUT)
    assert found is not None
    pins, fine, space = found["themes"]
    assert (pins["theme"], pins["tolerance"]) == ("pins", "as the case allows")
    assert (pins["recipe"], pins["usual"], pins["cured"], pins["cases"]) == ("RK4", 2, 3, 4)
    assert (pins["step"], pins["hardest"], pins["settings"]) == ("1 ms", "b", "o2")
    assert pins["times"] == "×8"
    assert pins["others"] == [("bundle", 1)]
    assert pins["most"]
    assert (fine["tolerance"], fine["cases"]) == ("1e-3", 1)
    assert (space["recipe"], space["cured"], space["cases"]) == ("", 0, 1)


def test_a_case_that_is_not_shown_has_no_link() -> None:
    found = advice(ADVISED, {"a": ("pins",)})
    assert found is not None
    assert {row["case"] for row in found["rows"] if row["linked"]} == {"a"}


def test_cures_are_counted_the_most_useful_first() -> None:
    found = causes(frame_of("""
case engine cure
a    pymunk step
b    pymunk step
b    pymunk step
a    pymunk midpoint
"""))  # fmt: skip
    assert found is not None
    told = [(one["cure"], one["count"], one["cases"]) for one in found["by_knob"]]
    assert told == [("step", 3, ["a", "b"]), ("midpoint", 1, ["a"])]
    assert found["count"] == 4


def test_releases_stand_in_their_order_with_what_moved() -> None:
    found = versions(frame_of("""
engine version setting verdict moved
mujoco 3.10.0  shipped beyond  -
mujoco 3.9.0   shipped beyond  -
mujoco 4.0.0   shipped agrees  yes
mujoco 4.0.0   shipped beyond  -
"""))  # fmt: skip
    assert found is not None
    told = [(one["version"], one["within"], one["judged"], one["moved"]) for one in found["shares"]]
    assert told == [("3.9.0", 0, 1, 0), ("3.10.0", 0, 1, 0), ("4.0.0", 1, 2, 1)]
    assert [row[1] for row in found["moved"]] == ["4.0.0"]


@pytest.mark.mutant("a moved row beside the error of its own release")
def test_a_moved_row_has_the_error_of_the_release_before() -> None:
    frame = frame_of("""
case engine version setting quantity error verdict moved
a    mujoco 4.0.0   shipped x        0.3   agrees  yes
a    mujoco 3.10.0  shipped x        0.2   beyond  yes
a    mujoco 3.9.0   shipped x        0.1   beyond  -
a    mujoco 3.9.0   tuned   x        7     beyond  -
""")

    def told(module: Any = beside) -> list[tuple[str, str]]:
        found = module.versions(frame)
        assert found["names"][-1] == "error before"
        return [(row[2], row[-1]) for row in found["moved"]]

    assert told() == [("4.0.0", "0.2"), ("3.10.0", "0.1")]
    own = otherwise(beside, 'before[k] = last.get(of, "")', 'before[k] = rows[k]["error"]')
    assert told(own) == [("4.0.0", "0.3"), ("3.10.0", "0.2")]


@pytest.mark.parametrize("read", [causes, versions])
def test_without_the_file_there_is_nothing(read: object) -> None:
    assert read(None) is None  # type: ignore[operator]
    assert advice(None, {}) is None


@pytest.mark.mutant("what a release lacks counts as within")
def test_only_what_agrees_is_within_of_a_release() -> None:
    frame = frame_of("""
case engine version setting quantity verdict  moved
a    mujoco 3.9     shipped x        agrees   -
a    mujoco 3.9     shipped y        beyond   -
b    mujoco 3.9     shipped x        diverged -
c    mujoco 3.9     shipped x        refused  -
c    mujoco 3.9     shipped audit    agrees   -
""")

    def within(module: Any = beside) -> list[tuple[int, int, int]]:
        return [(s["within"], s["judged"], s["percent"]) for s in module.versions(frame)["shares"]]

    assert within() == [(1, 4, 25)]
    lax = otherwise(beside, 'row["verdict"] == WITHIN for', 'row["verdict"] != "beyond" for')
    assert within(lax) == [(3, 4, 75)]


# Work against precision: what is drawn, counted by hand.

CLIMBER = replace(COUNTED, case="a", because="")
ERRORS_AT = {0.001: 0.2, 0.002: 1.0, 0.004: 4.0}
TUNED = Column("mujoco", "tuned", "native")


def ladder_of(
    errors: Mapping[float, float], ladder: str = "held", quantity: str = "x"
) -> list[StepError]:
    at = ("a", "mujoco", "tuned", "native", ladder, quantity, "m")
    return [StepError(*at, step, error) for step, error in errors.items()]


@pytest.mark.parametrize(
    ("ladder", "precision", "step"),
    [
        ({0.001: 0.1, 0.002: 0.5, 0.004: 2.0}, 1.0, 0.002),
        ({0.001: 0.1, 0.002: 0.5, 0.004: 2.0}, 0.2, 0.001),
        ({0.001: 0.1, 0.002: 2.0, 0.004: 0.5}, 1.0, 0.001),  # luck at one step does not count
        ({0.001: 3.0, 0.002: 0.5}, 1.0, None),
        ({0.001: float("nan")}, 1.0, None),
    ],
)
def test_enough_is_the_largest_step_from_which_on_all_is_within(
    ladder: dict[float, float], precision: float, step: float | None
) -> None:
    assert enough(ladder, precision) == step


def test_the_worst_quantity_counts_and_the_ladder_that_follows() -> None:
    rows = [CLIMBER, replace(CLIMBER, quantity="y", allowed=0.5)]
    steps = ladder_of(ERRORS_AT) + ladder_of({0.001: 0.1, 0.002: 0.1, 0.004: 5.0}, quantity="y")
    assert worst(rows, steps) == {("a", TUNED): {0.001: 0.2, 0.002: 0.5, 0.004: 10.0}}
    following = ladder_of(dict.fromkeys(ERRORS_AT, 0.0), ladder="following")
    assert worst([CLIMBER], ladder_of(ERRORS_AT) + following) == {
        ("a", TUNED): {0.001: 0, 0.002: 0, 0.004: 0}
    }


def test_a_share_is_of_all_cases_whether_they_run_or_not() -> None:
    ladders = {
        ("a", TUNED): {0.001: 0.5, 0.002: 0.5},
        ("b", TUNED): {0.001: 0.5, 0.002: 3.0},
        ("b", Column("mujoco", "tuned", "law")): {0.01: 0.1},
    }
    cases = ["a", "b", "c", "d"]
    x, y = profile(TUNED, cases, ladders, 1.0)
    assert x[1:-1] == [500.0, 1000.0]
    assert y == [0.0, 25.0, 50.0, 50.0]
    x, y = profile(Column("mujoco", "tuned", "any way"), cases, ladders, 1.0)
    assert x[1:-1] == [100.0, 500.0]  # the law takes the larger step


def test_a_panel_has_a_curve_of_each_precision_for_each_column() -> None:
    themes = {"a": ("pins",), "b": ("space",)}
    (panel,) = work(
        [CLIMBER], ladder_of(ERRORS_AT), themes
    )  # of a theme without a ladder there is none
    assert (panel["theme"], panel["cases"]) == ("pins", 1)
    assert set(panel["curves"]) == {TUNED.key}
    allowed, hundredth = panel["curves"][TUNED.key]
    assert allowed == ([10.0, 500.0, 1e5], [0.0, 100.0, 100.0])
    assert hundredth == ([10.0, 1e5], [0.0, 0.0])
    assert work([CLIMBER], [], themes) == []
