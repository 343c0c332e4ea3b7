"""House rules of the tree: imports form one, and no two answers share a derivation."""

import ast
import tomllib
from collections.abc import Iterator, Mapping
from pathlib import Path

import pytest
from given.command.tree import FILES, PACKAGES, ROOT, imported, module

from textmech.reports.front.page.page import NAME
from textmech.reports.front.show import picture
from textmech.reports.front.versions import table
from textmech.reports.tables.diff.folder import NOT_PACKED
from textmech.reports.tables.row import OF_NO_RUN
from textmech.reports.tables.write import ADVICE

# And of the committed page.
OF_THE_README = (*OF_NO_RUN, ADVICE, table.NAME, picture.NAME, "public_models.csv")

MAY_IMPORT = {
    "cases": {"cases"},
    "reference": {"cases", "reference"},
    "engines": {"cases", "engines"},
    "reports": {"cases", "reference", "engines", "reports"},
}


@pytest.mark.slow
def test_imports_flow_one_way() -> None:
    for file in FILES:
        package = file.relative_to(ROOT).parts[0]
        ours = {name.split(".")[0] for name in imported(file)} & set(PACKAGES)
        assert ours <= MAY_IMPORT[package], file


@pytest.mark.slow
def test_no_module_is_imported_in_a_circle() -> None:
    modules = {module(file): file for file in FILES}
    needs = {name: imported(file) & set(modules) - {name} for name, file in modules.items()}
    while needs:
        free = {name for name, needed in needs.items() if not needed & set(needs)}
        assert free, f"a circle among {sorted(needs)}"
        needs = {name: needed for name, needed in needs.items() if name not in free}


def sentence(docstring: str | None) -> bool:
    """Whether it opens with one: some words and a full stop."""
    opening = (docstring or "").partition("\n\n")[0]
    return len(opening.split()) > 3 and opening.endswith((".", ":"))


def test_every_folder_says_what_belongs_in_it() -> None:
    for folder in sorted({file.parent for file in FILES}):
        text = (folder / "__init__.py").read_text(encoding="utf-8")
        assert sentence(ast.get_docstring(ast.parse(text))), folder


@pytest.mark.parametrize("wrong", [None, "", "Rows.", "Rows and what they say"])
def test_a_folder_that_says_nothing_is_seen(wrong: str | None) -> None:
    assert not sentence(wrong)


def test_everything_is_in_the_wheel() -> None:
    """Each folder with modules, and each file that an installed command reads; a page is made."""
    setup = tomllib.loads((ROOT / "pyproject.toml").read_text())["tool"]["setuptools"]
    folders = {module(file.parent / "__init__.py") for file in FILES}
    assert set(setup["packages"]) == {"textmech", *(f"textmech.{folder}" for folder in folders)}
    assert setup["package-data"]["textmech"] == ["py.typed"]
    data = {
        file
        for package in PACKAGES
        for file in (ROOT / package).rglob("*")
        if file.is_file() and file.suffix not in (".py", ".pyc") and file.name != NAME
    }
    shipped = {
        file
        for package, patterns in setup["package-data"].items()
        for pattern in patterns
        for file in (ROOT / package.removeprefix("textmech.").replace(".", "/")).glob(pattern)
    }
    lacking = {file.relative_to(ROOT).as_posix() for file in data - shipped}
    assert lacking == {f"reports/{name}" for name in (*OF_THE_README, *NOT_PACKED)}


@pytest.mark.slow
def test_only_adapters_know_their_engine() -> None:
    for file in FILES:
        for engine in ("mujoco", "pymunk"):
            if engine in imported(file):
                rooms = [engine, "own_model" if engine == "mujoco" else "own_space"]
                assert any(file.is_relative_to(ROOT / "engines" / room) for room in rooms), file


def test_no_engine_is_named_in_the_cases_code() -> None:
    """Nor in its schema: which engines there are is told to `load`."""
    for file in (ROOT / "cases").rglob("*"):
        if file.suffix in (".py", ".json"):
            text = file.read_text(encoding="utf-8").lower()
            assert not [name for name in ("mujoco", "pymunk") if name in text], file


def undocumented(file: Path) -> list[str]:
    """Returns the public functions and classes of a file that have no docstring."""
    return [
        f"{file.name}: {node.name}"
        for node in top_level(file)
        if isinstance(node, ast.FunctionDef | ast.ClassDef)
        and not node.name.startswith("_")
        and not ast.get_docstring(node)
    ]


@pytest.mark.slow
@pytest.mark.mutant("a public function without a docstring")
def test_every_public_function_says_what_it_is(tmp_path: Path) -> None:
    assert [name for file in FILES for name in undocumented(file)] == []
    planted = tmp_path / "planted.py"
    planted.write_text("def f():\n    return 1\n\n\ndef _g(): pass\n", encoding="utf-8")
    assert undocumented(planted) == ["planted.py: f"]


DANGLING = ("Of", "What", "Those")
"""Words with which a first line opens that nobody understands without the name above it."""


def documented(tree: ast.AST) -> Iterator[tuple[str, str]]:
    """Yields each name of a module with its docstring, and the module's own."""
    for node in ast.walk(tree):
        if isinstance(node, ast.Module | ast.ClassDef | ast.FunctionDef):
            yield getattr(node, "name", "the module"), ast.get_docstring(node) or ""


def dangling(file: Path) -> list[str]:
    """Returns the names in a file whose docstring opens with a word of DANGLING."""
    named = documented(ast.parse(file.read_text(encoding="utf-8")))
    return [f"{file.name}: {name}" for name, text in named if text.split(" ")[0] in DANGLING]


@pytest.mark.slow
@pytest.mark.mutant("a docstring that needs the name above it")
def test_a_docstring_can_be_read_alone(tmp_path: Path) -> None:
    """A command's help is a paragraph of its own, whose first line the reader finds in a list."""
    commands = ROOT / "reports" / "front" / "command"
    files = [file for file in FILES if not file.is_relative_to(commands)]
    assert [name for file in files for name in dangling(file)] == []
    planted = tmp_path / "planted.py"
    planted.write_text('def f():\n    """Of all rungs, one realisation."""\n', encoding="utf-8")
    assert dangling(planted) == ["planted.py: f"]


def top_level(file: Path) -> list[ast.stmt]:
    return ast.parse(file.read_text(encoding="utf-8")).body


BUDGET = {
    "cases": 9890,
    "reference/certificate": 2120,
    "reference/formalisms": 1390,
    "reference/integrators": 1140,
    "reference/mechanism": 6730,
    "reference/motion": 1140,
    "reference/start": 1840,
    "reference/systems": 8350,
    "reference": 25440,
    "engines/mujoco": 6500,
    "engines/pymunk": 5160,
    "engines": 16790,
    "reports/compare": 5140,
    "reports/front": 8480,
    "reports/runs": 2420,
    "reports/search": 2130,
    "reports/tables": 1980,
    "reports": 20160,
    "tests/cases": 4140,
    "tests/engines": 11390,
    "tests/given": 6520,
    "tests/reference": 20490,
    "tests/reports": 18240,
    "tests/second": 4340,
    "tests": 68650,
}
"""Lines of Python that a room may have.

Lower a number after what leaves; raise one only with the reason in the commit.
"""
SPARE = 0.02  # of a budget: what it may stand above the room, before it has to be lowered


def outside(lines: Mapping[str, int]) -> list[str]:
    """Returns the rooms that are above their budget, or far below it."""
    return [
        f"{room}: {lines[room]} lines, the budget is {budget}"
        for room, budget in BUDGET.items()
        if not (1 - SPARE) * budget <= lines[room] <= budget
    ]


def test_every_room_keeps_its_budget_of_lines() -> None:
    lines = {
        room: sum(len(file.read_text(encoding="utf-8").splitlines()) for file in files)
        for room in BUDGET
        for files in [(ROOT / room).rglob("*.py")]
    }
    assert outside(lines) == []
    larger = f"cases: 100000 lines, the budget is {BUDGET['cases']}"
    assert outside(lines | {"cases": 10**5}) == [larger]
    assert outside(lines | {"tests/given": 100})
