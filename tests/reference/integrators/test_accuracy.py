"""What both integrators reach: the figures of their tables, their order and their errors."""

import dataclasses
from collections.abc import Callable

import numpy as np
import pytest
from given.machines.problems import BOTH, PROBLEMS, Solution, kepler, kepler_solution

from textmech.reference.integrators import march
from textmech.reference.integrators.dop853 import DOP853, STAGES
from textmech.reference.integrators.explicit import dormand_prince, dormand_prince_step
from textmech.reference.integrators.implicit import radau_step
from textmech.reference.integrators.march import Slope, Vector
from textmech.reference.integrators.radau import Collocation, radau_table

# The figures of both methods against the conditions of their orders, and against print.


def test_explicit_table_conditions():
    a, b, c = DOP853.a, DOP853.b, DOP853.c
    assert np.abs(a.sum(axis=1) - c).max() < 1e-14
    for k in range(8):
        assert b @ c**k == pytest.approx(1.0 / (k + 1), abs=1e-14)
    for k in range(1, 7):  # two conditions of trees that are not bushes, for each order up to 8
        assert b @ a @ c**k == pytest.approx(1.0 / ((k + 1) * (k + 2)), abs=1e-14)
        assert (b * c) @ a @ c ** (k - 1) == pytest.approx(1.0 / (k * (k + 2)), abs=1e-14)
    assert np.array_equal(a, np.tril(a, -1))
    assert len(b) == STAGES


@pytest.mark.parametrize(("row", "order"), [("e5", 5), ("e3", 3)])
def test_error_rows_vanish_up_to_their_order(row: str, order: int):
    weights = getattr(DOP853, row)
    moments = [abs(weights @ DOP853.c**k) for k in range(order + 1)]
    assert max(moments[:order]) < 1e-14
    assert moments[order] > 1e-5


@pytest.mark.parametrize("stages", range(1, 10))
def test_radau_conditions(stages: int):
    table: Collocation = radau_table(stages)
    a, c, b = table.a, table.c, table.a[-1]
    assert c[-1] == 1.0
    for figures in (a, c, table.gamma, table.error, table.leading):
        assert np.isrealobj(figures)
    for k in range(1, 2 * stages):  # B(2s - 1)
        assert b @ c ** (k - 1) == pytest.approx(1.0 / k, abs=2e-15)
    assert abs(b @ c ** (2 * stages - 1) - 0.5 / stages) > 1e-12  # and not B(2s)
    for k in range(1, stages + 1):  # C(s)
        assert np.abs(a @ c ** (k - 1) - c**k / k).max() < 2e-15
    weights = b + table.error @ a  # of the embedded formula, with gamma at the start
    assert weights.sum() + table.gamma == pytest.approx(1.0, abs=1e-13)
    for k in range(2, stages + 1):
        assert weights @ c ** (k - 1) == pytest.approx(1.0 / k, abs=1e-13)


def test_radau_with_three_stages_is_the_published_one():
    r = np.sqrt(6.0)
    table = radau_table(3)
    assert np.abs(table.c - [(4 - r) / 10, (4 + r) / 10, 1.0]).max() < 1e-15
    assert np.abs(table.a[2] - [(16 - r) / 36, (16 + r) / 36, 1 / 9]).max() < 1e-15
    published = table.gamma / 3.0 * np.array([-13.0 - 7.0 * r, -13.0 + 7.0 * r, -1.0])
    assert np.abs(table.error - published).max() < 1e-13
    assert 1.0 / table.gamma == pytest.approx(3.0 + 3.0 ** (2 / 3) - 3.0 ** (1 / 3), abs=1e-13)


@pytest.mark.parametrize("stages", [1, 2, 3, 5, 7])
def test_the_spectrum_of_radau_is_its_matrix(stages: int):
    """One eigenvalue of each pair, the real one first: γ, where the number of stages is odd."""
    table = radau_table(stages)
    assert len(table.values) == (stages + 1) // 2
    back = (table.back * table.values) @ table.into
    np.testing.assert_allclose(back.real, table.a, atol=1e-13)
    if stages % 2:
        assert table.values[0].imag == 0.0
        assert table.values[0].real == pytest.approx(table.gamma, rel=1e-12)


# The order of both integrators, and what a wrong figure in a table costs.


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


# What both integrators reach at the tolerance that the reference uses.


@BOTH
@pytest.mark.parametrize("name", PROBLEMS)
def test_reference_accuracy(method, name: str):
    f, solution, _ = PROBLEMS[name]
    times = np.linspace(0.0, 10.0, 21)
    exact = np.array([solution(t) for t in times])
    result = method(f, times, exact[0], tolerance=1e-14)
    assert np.abs(result.y - exact).max() < 1e-12


@BOTH
def test_the_error_follows_the_tolerance(method):
    times = np.array([0.0, 10.0])
    exact = kepler_solution(10.0)
    for tolerance in (1e-6, 1e-8, 1e-10, 1e-12):
        y = method(kepler, times, kepler_solution(0.0), tolerance=tolerance).y
        assert np.abs(y[-1] - exact).max() < 100.0 * tolerance


@pytest.mark.slow
def test_what_rounding_cuts_off_a_step_is_carried_on():
    """Steps of 1e-5 s, 20000 of them: a plain sum would be off by a hundred ulp and more."""
    times = np.linspace(0.0, 0.2, 20001)
    found = dormand_prince(lambda t, y: np.full(1, 1.0 / 3.0), times, [1.0])
    assert abs(found.y[-1, 0] - (1.0 + 0.2 / 3.0)) <= 20 * np.spacing(1.0)


def summed(tolerance: float = 1e-13) -> float:
    """How far y = 1000 + t/3 is off after ten thousand steps, in its last digits."""
    times = np.linspace(0.0, 1.0, 10_001)
    y = dormand_prince(lambda t, y: np.array([1.0 / 3.0]), times, [1000.0], tolerance=tolerance).y
    return float(np.abs(y[:, 0] - (1000.0 + times / 3.0)).max() / np.spacing(1000.0))


@pytest.mark.slow
def test_what_rounding_cuts_off_a_step_is_kept():
    """A step adds 3e-5, of which 1000 has eight digits."""
    assert summed() <= 1.0


@pytest.mark.slow
@pytest.mark.mutant("what rounding cuts off a step is lost")
def test_a_sum_that_is_not_compensated_is_seen(monkeypatch: pytest.MonkeyPatch):
    accept = march._Walker._accept

    def lossy(self, *given):
        step = accept(self, *given)
        self.low = 0.0 * self.low
        return step

    monkeypatch.setattr(march._Walker, "_accept", lossy)
    assert summed() > 10.0
