"""The order of both integrators, and what a wrong figure in a table costs."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from given.problems import PROBLEMS, Solution

from textmech.reference.integrators.dop853 import DOP853
from textmech.reference.integrators.explicit import dormand_prince_step
from textmech.reference.integrators.implicit import radau_step
from textmech.reference.integrators.march import Slope, Vector
from textmech.reference.integrators.radau import radau_table


def observed_order(
    step: Callable[..., Vector], problem: tuple[Slope, Solution, float], counts: list[int], table
) -> float:
    """Slope of log error over log step, the error being the largest of the run."""
    f, solution, end = problem
    errors = []
    for count in counts:
        h, y, worst = end / count, solution(0.0), 0.0
        for i in range(count):
            y = step(f, i * h, y, h, table=table)
            worst = max(worst, float(np.abs(y - solution((i + 1) * h)).max()))
        errors.append(worst)
    assert min(errors) > 1e-13, "rounding, not the method, would be measured"
    return float(-np.polyfit(np.log(counts), np.log(errors), 1)[0])


# Steps short enough for the leading term of the error to rule and long enough for it to stand
# clear of rounding.
EXPLICIT_COUNTS = {
    "linear": [14, 16, 18, 20],
    "oscillator": [10, 14, 18, 24],
    "kepler": [14, 16, 18, 20],
    "pendulum": [30, 36, 42, 48],
}
IMPLICIT_COUNTS = {
    ("linear", 3): [20, 40, 60, 80],
    ("oscillator", 3): [20, 40, 60, 80],
    ("kepler", 3): [25, 35, 45, 55],
    ("pendulum", 3): [60, 80, 100, 140],
    ("linear", 5): [8, 10, 12, 14],
    ("oscillator", 5): [6, 8, 10, 12],
    ("kepler", 5): [8, 10, 12, 14],
    ("pendulum", 5): [20, 24, 28, 32],
}


@pytest.mark.parametrize("name", PROBLEMS)
def test_explicit_order(name: str):
    order = observed_order(dormand_prince_step, PROBLEMS[name], EXPLICIT_COUNTS[name], DOP853)
    assert 7.7 <= order <= 8.5


@pytest.mark.parametrize(("name", "stages"), IMPLICIT_COUNTS)
def test_implicit_order(name: str, stages: int):
    table = radau_table(stages)
    order = observed_order(radau_step, PROBLEMS[name], IMPLICIT_COUNTS[name, stages], table)
    assert abs(order - (2 * stages - 1)) < 0.2


@pytest.mark.mutant("explicit integrator: figure {entry} of its table 1e-3 off")
@pytest.mark.parametrize("entry", [("a", (6, 4)), ("a", (11, 10)), ("c", 7), ("b", 8)])
def test_a_wrong_figure_in_the_explicit_table_costs_orders(entry):
    order = observed_order(
        dormand_prince_step, PROBLEMS["linear"], EXPLICIT_COUNTS["linear"], broken(DOP853, *entry)
    )
    assert order < 2.0


@pytest.mark.mutant("implicit integrator: figure {entry} of its table 1e-3 off")
@pytest.mark.parametrize("entry", [("a", (0, 1)), ("a", (4, 2)), ("c", 2)])
def test_a_wrong_figure_in_the_implicit_table_costs_orders(entry):
    order = observed_order(
        radau_step, PROBLEMS["linear"], IMPLICIT_COUNTS["linear", 5], broken(radau_table(5), *entry)
    )
    assert order < 2.0


def broken(table, field: str, index):
    values = getattr(table, field).copy()
    values[index] += 1e-3
    return dataclasses.replace(table, **{field: values})
