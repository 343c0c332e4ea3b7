"""The names that NOTATION.md says the code has are names in the code."""

import re

import pytest
from given.tree import ROOT

TABLES = (ROOT / "reference" / "NOTATION.md").read_text(encoding="utf-8")
WORD = r"[A-Za-z_]\w*"
CODE = {
    word
    for file in (ROOT / "reference").rglob("*.py")
    for word in re.findall(WORD, file.read_text(encoding="utf-8"))
}


def named(row: str) -> list[str]:
    """The words in backticks of a row's second column."""
    column = row.split("|")[2]
    return [word for code in re.findall(r"`([^`]*)`", column) for word in re.findall(WORD, code)]


ROWS = [row for row in TABLES.splitlines() if row.startswith("|") and named(row)]


@pytest.mark.parametrize("row", ROWS, ids=lambda row: row.split("|")[1].strip())
def test_names_of_a_row_are_in_the_code(row: str) -> None:
    assert set(named(row)) <= CODE


def test_a_name_that_is_gone_is_seen() -> None:
    assert not set(named("| S | `appell.lost_energy` | | J/s² | 2.77 |")) <= CODE
    assert len(ROWS) > 60
