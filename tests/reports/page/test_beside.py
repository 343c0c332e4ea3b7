"""Tables that other commands write, as the page sums them up: counted by hand."""

from typing import Any

import pandas as pd
import pytest
from given.otherwise import otherwise

from textmech.reports.page import advice as advised
from textmech.reports.page import beside
from textmech.reports.page.advice import advice
from textmech.reports.page.beside import causes, versions


def rows(text: str) -> pd.DataFrame:
    head, *lines = [line.split() for line in text.strip().splitlines()]
    cells = [[cell.strip("-").replace("_", " ") for cell in line] for line in lines]
    return pd.DataFrame(cells, columns=head)


ADVICE = rows("""
case engine tolerance margin want     recipe settings step   cost shipped_cost ratio
a    mujoco -         2      both     RK4    o1       0.008  500  500          0.1
b    mujoco -         2      cheapest RK4    o2       0.001  4000 500          0.2
b    mujoco -         2      fewest_changes many o5   0.0001 9000 500          0.2
c    mujoco -         2      both     bundle o3       0.0001 9    500          0.3
d    mujoco -         2      -        none   -        -      -    500          12
e    mujoco -         2      -        none   -        -      -    -            -
a    mujoco 1e-3      2      both     RK4    o4       0.008  500  500          0.1
""")  # what is refused, as e, was never off by anything, and needs no setting
SELDOM = rows("""
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
    found = advice(ADVICE, ABOUT)
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
    found = advice(ADVICE, {"a": ("pins",)})
    assert found is not None
    assert {row["case"] for row in found["rows"] if row["linked"]} == {"a"}


def test_cures_are_counted_the_most_useful_first() -> None:
    found = causes(rows("""
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
    found = versions(rows("""
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
    frame = rows("""
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
    own = otherwise(beside, 'found[k] = last.get(of, "")', 'found[k] = rows[k]["error"]')
    assert told(own) == [("4.0.0", "0.3"), ("3.10.0", "0.2")]


@pytest.mark.parametrize("read", [causes, versions])
def test_without_the_file_there_is_nothing(read: object) -> None:
    assert read(None) is None  # type: ignore[operator]
    assert advice(None, {}) is None


@pytest.mark.mutant("what a release lacks counts as within")
def test_only_what_agrees_is_within_of_a_release() -> None:
    frame = rows("""
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
