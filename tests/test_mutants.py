"""Mistakes are drawn by chance alone, and each is told by what it changes and what saw it."""

from types import SimpleNamespace
from typing import Any

import mutants
import pytest


def item(line: int, operator: str, occurrence: int = 0) -> Any:
    """A work item of cosmic-ray."""
    mutation = SimpleNamespace(
        module_path="a.py", start_pos=(line, 0), operator_name=operator, occurrence=occurrence
    )
    return SimpleNamespace(mutations=(mutation,))


def test_a_draw_hangs_on_its_seed_and_takes_no_place_twice() -> None:
    every = [
        item(n, f"core/ReplaceBinaryOperator_Add_{to}") for n in range(9) for to in ("Sub", "Mul")
    ]
    every += [item(1, "core/RemoveDecorator"), item(2, "core/ReplaceBinaryOperator_Add_LShift")]
    drawn = mutants.draw(every, 5, 1)
    assert drawn == mutants.draw(every[::-1], 5, 1) != mutants.draw(every, 5, 2)
    assert len({one.mutations[0].start_pos for one in drawn}) == 5
    assert len(mutants.draw(every, 99, 1)) == 9


def test_a_mistake_is_told_by_its_lines() -> None:
    diff = "--- a.py\n+++ a.py\n@@ -1 +1 @@\n x = 1\n-    y = a + b\n+    y = a - b\n"
    assert mutants.changed(diff) == "y = a + b -> y = a - b"


@pytest.mark.parametrize(
    ("outcome", "output", "told"),
    [
        (
            "killed",
            "1 failed\nFAILED tests/test_a.py::test_b - assert",
            ("seen", "tests/test_a.py::test_b"),
        ),
        ("killed", "timeout", ("timeout", "")),
        ("killed", "SyntaxError", ("seen", "no test starts")),
        ("survived", "12 passed", ("survived", "")),
    ],
)
def test_an_outcome_names_the_test(outcome: str, output: str, told: tuple[str, str]) -> None:
    assert mutants.outcome(SimpleNamespace(test_outcome=outcome, output=output)) == told
