"""What is kept complete: the equations, which of them run, names, and what all answers share."""

import ast
import re
from collections.abc import Callable, Container
from functools import cache, cached_property
from importlib import import_module
from pathlib import Path

import pytest
from given import scenes
from given.command.tree import ROOT

from textmech.reference import certificate
from textmech.reference.coverage import Numbered, equations, noting
from textmech.reference.laws import momentum
from textmech.reference.laws.force import spring, weight

# Each equation of the chapter's mechanics has a function that states it, or a test of its own.

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


# Which equations count as used: those whose function runs.

REFERENCE = Path(__file__).parents[2] / "reference"


@pytest.mark.parametrize(
    ("docstring", "numbers"),
    [
        ("(2.44) d/dt ∂T/∂q̇", ["2.44"]),
        ("(2.23), (2.27) m r̈_c = F", ["2.23", "2.27"]),
        ("(2.23), (2.27): all of it", ["2.23", "2.27"]),
        ("(2.1) r = r_c + d and (2.6) ṙ", ["2.1"]),
        ("(2.1) and (2.6) r", ["2.1", "2.6"]),
        ("(2.10) is not (2.1)", ["2.10"]),
        ("\n    (2.14) on the next line", ["2.14"]),
        ("Newton's law (2.23)", []),
        ("2.23 without brackets", []),
        ("(3.1) another chapter", []),
        ("", []),
        (None, []),
    ],
)
def test_equations_that_open_a_docstring(docstring: str | None, numbers: list[str]) -> None:
    assert equations(docstring) == numbers


def noted(work: Callable[[], object]) -> set[str]:
    with noting() as found:
        work()
    return found


def test_only_what_runs_is_noted() -> None:
    assert noted(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}
    assert noted(lambda: None) == set()


def test_naming_a_function_is_not_running_it() -> None:
    assert noted(lambda: momentum.spin_rate) == set()


def test_what_is_not_of_the_reference_does_not_count() -> None:
    def elsewhere() -> None:
        """(2.99) A docstring in a test."""

    assert noted(elsewhere) == set()


def test_an_error_ends_it_too() -> None:
    with pytest.raises(ZeroDivisionError):
        noted(lambda: 1 / 0)
    assert noted(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}


def test_what_runs_late_is_noted() -> None:
    def late() -> None:
        for _ in range(100_000):
            equations(None)
        spring(1.0, 0.5, (1.0, 0.0))

    assert noted(late) == {"2.82"}


def test_what_runs_in_an_inner_one_is_noted_in_both() -> None:
    inner: set[str] = set()

    def outer() -> None:
        inner.update(noted(lambda: spring(1.0, 0.5, (1.0, 0.0))))
        weight(1.0, (0.0, -1.0))

    assert noted(outer) == {"2.81", "2.82"}
    assert inner == {"2.82"}


def test_what_ran_before_is_not_noted() -> None:
    weight(1.0, (0.0, -1.0))
    assert noted(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}


def wrongly_marked(text: str, numbered: Container[str]) -> list[str]:
    """The functions of a module's text that state equations and are not noted, or are in vain.

    numbered: its classes whose methods are noted by their docstrings.
    """
    wrong = []
    for parent in ast.walk(ast.parse(text)):
        for node in ast.iter_child_nodes(parent):
            if not isinstance(node, ast.FunctionDef):
                continue
            marked = any(
                isinstance(d, ast.Name) and d.id == "equation" for d in node.decorator_list
            )
            only_said = all(isinstance(line, ast.Expr | ast.Raise) for line in node.body)
            states = bool(equations(ast.get_docstring(node))) and not only_said
            if isinstance(parent, ast.ClassDef):
                states = states and parent.name not in numbered
            if marked != states:
                wrong.append(node.name)
    return wrong


def numbered_in(file: Path) -> set[str]:
    """The names of a module's classes whose methods note their equations."""
    module = import_module(
        ".".join(("textmech.reference", *file.relative_to(REFERENCE).parts))[:-3]
    )
    classes = (item for item in vars(module).values() if isinstance(item, type))
    return {each.__name__ for each in classes if issubclass(each, Numbered)}


@pytest.mark.slow
@pytest.mark.mutant("an equation that is not marked as one")
def test_each_equation_is_noted() -> None:
    """Those whose body does something: an interface only says."""
    texts = {file: file.read_text(encoding="utf-8") for file in REFERENCE.rglob("*.py")}
    found = {file.name: wrongly_marked(text, numbered_in(file)) for file, text in texts.items()}
    assert {name: wrong for name, wrong in found.items() if wrong} == {}
    sound = next(text for file, text in texts.items() if file.name == "voronets.py")
    assert "accelerations" in wrongly_marked(sound.replace("@equation\n", "", 1), ())
    linkage = next(text for file, text in texts.items() if file.name == "four_bar.py")
    assert "accelerations" in wrongly_marked(linkage, ())
    assert wrongly_marked('@equation\ndef f():\n    """Not one."""\n    return 1\n', ()) == ["f"]


class Ladder(Numbered):
    """Its methods are all kinds that a class may have."""

    def method(self) -> float:
        """(2.1) one."""
        return 1.0

    @property
    def value(self) -> float:
        """(2.2) two."""
        return 2.0

    @cached_property
    def kept(self) -> float:
        """(2.3) three."""
        return 3.0

    @staticmethod
    def apart() -> float:
        """(2.4) four."""
        return 4.0

    def other(self) -> float:
        """Of no equation."""
        return 5.0


def test_each_kind_of_method_is_noted() -> None:
    ladder = Ladder()
    assert noted(lambda: ladder.method()) == {"2.1"}
    assert noted(lambda: ladder.value) == {"2.2"}
    assert noted(lambda: ladder.kept) == {"2.3"}
    assert noted(ladder.apart) == {"2.4"}
    assert noted(lambda: ladder.other()) == set()


def test_what_cannot_be_noted_is_refused() -> None:
    with pytest.raises(TypeError, match="cannot be noted"):

        class Wrong(Numbered):
            class Inner:
                """(2.5) A class is no function."""


@pytest.mark.slow
def test_claimed_equations_are_executed() -> None:
    for name, case in scenes.EVERY.items():
        left = sorted(set(case.origin.equations) - scenes.solved(name).equations)
        assert not left, f"{name} claims {left}, which nothing in its solution executes"


# The names that NOTATION.md says the code has are names in the code.

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


# reference/SHARED.md: what all answers share, each with the rows and the tests that see it.

LIST = ROOT / "reference" / "SHARED.md"
CERTIFICATE = Path(certificate.__file__ or "").parent
ISLANDS = CERTIFICATE.parent / "islands.py"


def entries() -> list[list[str]]:
    """The cells of each line of the table."""
    lines = LIST.read_text(encoding="utf-8").splitlines()
    cells = [[cell.strip() for cell in line.strip("|").split("|")] for line in lines if "|" in line]
    return cells[2:]


ENTRIES = {cells[0]: cells for cells in entries()}


def quoted(cell: str) -> list[str]:
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
    assert quoted(code)
    assert [name for name in quoted(code) if not (ROOT / name).exists()] == []
    words = "\n".join(
        file.read_text(encoding="utf-8") for file in (ISLANDS, *CERTIFICATE.glob("*.py"))
    )
    assert [row for row in quoted(rows) if f'"{row}"' not in words] == []
    assert quoted(rows) or rows == "none"
    assert quoted(tests)
    for test in quoted(tests):
        file, _, name = test.partition("::")
        assert name in functions(file), test


def test_every_row_that_reads_the_file_is_listed() -> None:
    """And nothing is taken for one that the certificate does not have."""
    rows = {row for cells in ENTRIES.values() for row in quoted(cells[2])}
    files = (ISLANDS, CERTIFICATE / "file_checks.py", CERTIFICATE / "one_sided_checks.py")
    words = "".join(file.read_text(encoding="utf-8") for file in files)
    assert rows == set(re.findall(r'Check\("([^"]+)"', words))
