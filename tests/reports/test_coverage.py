"""Every item of the chapter has a case that covers it, a test that states it, or a reason."""

import ast
import re
from collections.abc import Iterator

import pandas as pd
import pytest
from given import scenes
from given.tree import ROOT

from textmech.reference.coverage import equations
from textmech.reports.data import coverage as covering
from textmech.reports.data.coverage import coverage, otherwise

# Items that nobody covers yet. One that is covered must be struck off here.
NOTHING = ("a photograph of ", "a sketch of ")
FILE = re.compile(r"tests/[\w/]+\.py")


def open_items(table: pd.DataFrame) -> set[tuple[str, str]]:
    """By kind and number, what neither a case nor a declared word covers."""
    left = table[(table.cases == "") & (table.otherwise == "")]
    return set(zip(left.kind, left.number.str.strip("()"), strict=True))


@pytest.fixture(scope="module")
def table() -> pd.DataFrame:
    """Of the shipped cases, solved now."""
    executed = {name: set(scenes.solved(name).equations) for name in scenes.EVERY}
    return coverage(list(scenes.EVERY.values()), executed)


@pytest.mark.slow
def test_nothing_else_is_open(table: pd.DataFrame) -> None:
    assert open_items(table) == set()


@pytest.mark.slow
def test_what_a_case_covers_needs_no_other_word(table: pd.DataFrame) -> None:
    both = table[(table.cases != "") & (table.otherwise != "")]
    assert list(zip(both.kind, both.number, strict=True)) == []


@pytest.mark.slow
def test_an_item_that_loses_its_case_is_seen() -> None:
    lost = {n: c for n, c in scenes.EVERY.items() if n != "four_bar"}
    executed = {name: set(scenes.solved(name).equations) for name in lost}
    assert open_items(coverage(list(lost.values()), executed)) == {("figure", "2.3")}


def test_an_item_that_loses_its_word_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    said = otherwise()
    del said["equation", "2.42"]
    monkeypatch.setattr(covering, "otherwise", lambda: said)
    found = open_items(coverage([], {}))
    assert ("equation", "2.42") in found
    assert ("equation", "2.43") not in found


def stated(file: str) -> Iterator[str]:
    """The equations that open the docstrings of a file's tests."""
    for node in ast.walk(ast.parse((ROOT / file).read_text(encoding="utf-8"))):
        if isinstance(node, ast.FunctionDef) and node.name.startswith("test_"):
            yield from equations(ast.get_docstring(node))


@pytest.mark.parametrize(("kind", "number"), otherwise())
def test_a_declared_test_states_the_equation(kind: str, number: str) -> None:
    what = otherwise()[kind, number]
    if kind == "equation":
        assert FILE.fullmatch(what)
        assert number in set(stated(what))
    else:
        assert what.startswith(NOTHING)


def test_every_item_of_the_chapter_has_a_row() -> None:
    table = coverage([], {})
    assert list(table.columns) == ["kind", "number", "cases", "otherwise"]
    counts = {kind: int(n) for kind, n in table.kind.value_counts().items()}
    assert counts == {"equation": 98, "example": 4, "exercise": 6, "figure": 32}
    known = set(zip(table.kind, table.number.str.strip("()"), strict=True))
    assert set(otherwise()) <= known
