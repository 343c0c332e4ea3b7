"""CONTRIBUTING.md and tests/README.md say what to touch: their lists are those of the code."""

import ast
import re
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[1]
SHORT = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
TEXT = SHORT + (ROOT / "tests" / "README.md").read_text(encoding="utf-8")
# The dataclasses of reports/tables/row.py.
ROWS = {"Comparison", "Rungs", "StepError", "Certificate", "Instant", "Cause", "Advice"}
BOUNDS = {"forward", "backward"}  # the numbers of a law of dry friction


@cache
def trees() -> dict[str, ast.AST]:
    """The programs of the four rooms."""
    return {
        str(file.relative_to(ROOT)): ast.parse(file.read_text(encoding="utf-8"))
        for room in ("cases", "reference", "engines", "reports")
        for file in sorted((ROOT / room).rglob("*.py"))
    }


def listed(what: str) -> set[str]:
    """The files that the table names for a thing to add."""
    (row,) = [line for line in TEXT.splitlines() if line.startswith(f"| {what} |")]
    return set(re.findall(r"`([\w/]+\.py)`", row.split("|")[2]))


def makes(tree: ast.AST) -> bool:
    """Whether a program fills a row."""
    calls = [node.func for node in ast.walk(tree) if isinstance(node, ast.Call)]
    return any(isinstance(name, ast.Name) and name.id in ROWS for name in calls)


def reads(tree: ast.AST) -> bool:
    """Whether a program reads the numbers of dry friction."""
    return any(isinstance(n, ast.Attribute) and n.attr in BOUNDS for n in ast.walk(tree))


def test_what_is_read_first_is_short() -> None:
    assert len(SHORT.splitlines()) <= 60


def test_every_path_exists() -> None:
    paths = set(re.findall(r"`((?:cases|reference|engines|reports|tests)/[\w./<>]*)`", TEXT))
    assert len(paths) > 20
    missing = {path for path in paths if "<" not in path and not (ROOT / path).exists()}
    assert not missing


@pytest.mark.slow
def test_rows_are_filled_where_it_says() -> None:
    filled = {file for file, tree in trees().items() if makes(tree)}
    assert filled | {"reports/tables/row.py"} == listed("a column of a report")


@pytest.mark.slow
def test_a_law_of_friction_is_where_it_says() -> None:
    """But for the engines' own folders: what an engine knows of friction is its own."""
    ours = re.compile(r"engines/\w+/|cases/language/|cases/scene/joint")
    told = {file for file, tree in trees().items() if reads(tree) and not ours.match(file)}
    assert told | {"cases/fields/friction.py", "reference/laws/friction.py"} == listed(
        "a law of friction"
    )
