"""Each equation of the chapter's mechanics has a function that states it, or a test of its own."""

import ast
from functools import cache
from pathlib import Path

import pytest
from given.tree import ROOT

from textmech.reference.coverage import equations

NUMBERS = range(1, 81)  # kinematics, the synthetic method, and the analytical one
PLACES = [ROOT / "reference", ROOT / "tests" / "reference"]


def stated(file: Path) -> set[str]:
    """The equations that open the docstring of a function or test in it."""
    tree = ast.walk(ast.parse(file.read_text(encoding="utf-8")))
    functions = [node for node in tree if isinstance(node, ast.FunctionDef)]
    return {number for node in functions for number in equations(ast.get_docstring(node))}


@cache
def found() -> set[str]:
    """All of them."""
    return {number for place in PLACES for file in place.rglob("*.py") for number in stated(file)}


@pytest.mark.slow
@pytest.mark.parametrize("number", NUMBERS)
def test_equation_is_stated(number: int) -> None:
    assert f"2.{number}" in found()


def test_an_equation_that_nobody_states_is_seen(tmp_path: Path) -> None:
    file = tmp_path / "some.py"
    file.write_text('def f():\n    """(2.7) a, as (2.99) has it."""\n', encoding="utf-8")
    assert stated(file) == {"2.7"}
