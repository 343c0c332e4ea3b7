"""reference/SHARED.md: what all answers share, each with the rows and the tests that see it."""

import ast
import re
from pathlib import Path

import pytest
from given.tree import ROOT

from textmech.reference import certificate

LIST = ROOT / "reference" / "SHARED.md"
ROWS = Path(certificate.__file__ or "").parent
ISLANDS = ROWS.parent / "islands.py"


def entries() -> list[list[str]]:
    """The cells of each line of the table."""
    lines = LIST.read_text(encoding="utf-8").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if "|" in line]
    return cells[2:]


ENTRIES = {cells[0]: cells for cells in entries()}


def named(cell: str) -> list[str]:
    """What stands in back quotes."""
    return re.findall(r"`([^`]+)`", cell)


def functions(file: str) -> set[str]:
    """The names of a test file's functions."""
    tree = ast.parse((ROOT / "tests" / file).read_text(encoding="utf-8"))
    return {node.name for node in tree.body if isinstance(node, ast.FunctionDef)}


@pytest.mark.slow
@pytest.mark.parametrize("entry", ENTRIES)
def test_each_entry_has_its_code_its_rows_and_a_test(entry: str) -> None:
    _, code, rows, tests = ENTRIES[entry]
    assert named(code)
    assert [name for name in named(code) if not (ROOT / name).exists()] == []
    words = "\n".join(file.read_text(encoding="utf-8") for file in (ISLANDS, *ROWS.glob("*.py")))
    assert [row for row in named(rows) if f'"{row}"' not in words] == []
    assert named(rows) or rows == "none"
    assert named(tests)
    for test in named(tests):
        file, _, name = test.partition("::")
        assert name in functions(file), test


def test_every_row_that_reads_the_file_is_listed() -> None:
    """And nothing is taken for one that the certificate does not have."""
    rows = {row for cells in ENTRIES.values() for row in named(cells[2])}
    files = (ISLANDS, ROWS / "file_checks.py", ROWS / "one_sided_checks.py")
    words = "".join(file.read_text(encoding="utf-8") for file in files)
    assert rows == set(re.findall(r'Check\("([^"]+)"', words))
