"""Which equations count as used: those whose function runs."""

import ast
from collections.abc import Callable, Container
from functools import cached_property
from importlib import import_module
from pathlib import Path

import pytest
from given import scenes

from textmech.reference.coverage import Numbered, equations, noting
from textmech.reference.laws import momentum
from textmech.reference.laws.force import spring, weight

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
