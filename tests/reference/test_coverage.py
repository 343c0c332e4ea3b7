"""Which equations count as used: those whose function runs."""

import sys
from dataclasses import replace

import pytest
import scenes

from textmech.cases.case import Case
from textmech.reference.certificate.coverage import equations, executed
from textmech.reference.laws import momentum
from textmech.reference.laws.force import spring
from textmech.reference.solve import solve

SAMPLES = 3  # as the reports do it: enough to run every function once


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


def test_only_what_runs_is_executed() -> None:
    assert executed(lambda: spring(1.0, 0.5, (1.0, 0.0))) == {"2.82"}
    assert executed(lambda: None) == set()


def test_naming_a_function_is_not_running_it() -> None:
    assert executed(lambda: momentum.spin_rate) == set()


def test_what_is_not_of_the_reference_does_not_count() -> None:
    def elsewhere() -> None:
        """(2.99) A docstring in a test."""

    assert executed(elsewhere) == set()


def test_another_profiler_is_put_back_even_after_an_error() -> None:
    before = sys.getprofile()
    with pytest.raises(ZeroDivisionError):
        executed(lambda: 1 / 0)
    assert sys.getprofile() is before


def short(case: Case) -> Case:
    if case.events:  # they may come at any time
        return case
    return replace(case, samples=SAMPLES, duration=(SAMPLES - 1) * case.interval)


@pytest.mark.parametrize("name", scenes.SHIPPED)
def test_claimed_equations_are_executed(name: str) -> None:
    case = scenes.SHIPPED[name]
    missing = set(case.origin.equations) - executed(lambda: solve(short(case)))
    assert not missing, f"{name} claims {sorted(missing)}, which nothing in its solution executes"
