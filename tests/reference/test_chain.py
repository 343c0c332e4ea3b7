"""A chain costs evaluations by its motion, and each by its length: no more with more bars."""

from collections import Counter
from pathlib import Path

import numpy as np
import pytest

from textmech.cases.load import load
from textmech.reference.integrators import implicit
from textmech.reference.mechanism.constraints import constraint_solver as holding
from textmech.reference.mechanism.constraints.constraint_solver import Band
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.solve import Solution, solve

BAR = "{bar: {mass: 1.0, length: 0.4}}"


def chain(bars: int) -> str:
    """Bars in a row, released horizontally; the first three turn."""
    ends = ["ground.O", *(f"b{i}.end" for i in range(bars))]
    bodies = ", ".join(f"b{i}: {BAR}" for i in range(bars))
    joints = ", ".join(f"j{i}: {{pin: [{ends[i]}, b{i}.start]}}" for i in range(bars))
    start = ", ".join(f"b{i}: {{angle: 0}}" for i in range(bars))
    scene = f"{{points: {{O: [0, 0]}}, bodies: {{{bodies}}}, joints: {{{joints}}}}}"
    return (
        f"title: A chain\nscene: {scene}\ninitial: {{{start}}}\nduration: 0.1\nsamples: 3\n"
        "allow: {b0.angle: 1.0e-2, b2.angle: 1.0e-2, j0.force: 1.0}\n"
    )


def solved(folder: Path, bars: int, count: pytest.MonkeyPatch) -> tuple[Solution, Counter[str]]:
    """The certified motion, and how often its parts were computed."""
    calls: Counter[str] = Counter()

    def counted(owner: object, name: str) -> None:
        original = getattr(owner, name)

        def again(*given: object, **named: object) -> object:
            calls[name] += 1
            return original(*given, **named)

        count.setattr(owner, name, again)

    counted(Multibody, "accelerations")
    counted(implicit, "difference_jacobian")
    counted(implicit, "stage_factors")
    counted(holding, "full")
    counted(Band, "held")
    file = folder / "chain.yaml"
    file.write_text(chain(bars), encoding="utf-8")
    (case,) = load(file)
    return solve(case), calls


@pytest.fixture(scope="module")
def long(tmp_path_factory: pytest.TempPathFactory) -> tuple[Solution, Counter[str]]:
    with pytest.MonkeyPatch.context() as patch:
        return solved(tmp_path_factory.mktemp("long"), 20, patch)


@pytest.mark.slow
def test_a_long_chain_costs_no_more_evaluations(
    long: tuple[Solution, Counter[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    _, few = solved(tmp_path, 5, monkeypatch)
    _, many = long
    columns = 2 * 3 * (20 - 5)  # more of each Jacobian
    more = columns * many["difference_jacobian"]
    assert many["accelerations"] <= 1.5 * few["accelerations"] + more
    assert many["stage_factors"] <= many["difference_jacobian"] + 10


@pytest.mark.slow
def test_no_matrix_of_a_long_chain_is_full(long: tuple[Solution, Counter[str]]):
    _, calls = long
    assert calls["full"] == 0
    assert calls["held"] >= calls["accelerations"] > 0


def test_the_certificate_is_of_two_answers(long: tuple[Solution, Counter[str]]):
    """Two integrators differ by rounding; one compared with itself would not differ at all."""
    solution, calls = long
    assert solution.holds
    assert calls["difference_jacobian"] > 0
    own = {check.name: check.certified for check in solution.checks}
    assert 0.0 < (own["error of j0.force"] or 0.0) < 1e-9


@pytest.mark.slow
@pytest.mark.mutant("a long chain gets a new Jacobian at every other step")
def test_a_large_jacobian_is_kept_while_it_serves(
    long: tuple[Solution, Counter[str]], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
):
    """It has a column for every coordinate and rate: of 40 bars 240, which a step cannot pay."""
    _, of_20 = long  # 120 columns, refreshed as of any mechanism
    solution, of_40 = solved(tmp_path, 40, monkeypatch)
    assert solution.holds
    assert of_40["difference_jacobian"] <= 0.5 * of_20["difference_jacobian"]


@pytest.mark.mutant(
    "the point of a driven ground is left at its start, in the residuals of many rows"
)
def test_residuals_of_many_rows_are_those_of_each(tmp_path: Path):
    """All at once, in real and in complex numbers, with points of the ground that move."""
    text = chain(12).replace("O: [0, 0]", "O: {at: [0.2, 0.1], velocity: [0.3, -0.4]}")
    text = text.replace("j5: {pin:", "j5: {weld:").replace("j7: {pin:", "j7: {weld:")
    file = tmp_path / "chain.yaml"
    file.write_text(text, encoding="utf-8")
    scene = load(file)[0].scene
    mode = Multibody(scene, (np.zeros(36), np.zeros(36)))
    random = np.random.default_rng(1)
    for _ in range(5):
        t = float(random.uniform(0.1, 1.0))
        q = random.uniform(-2.0, 2.0, len(mode.coordinates))
        for place in (q, q + 1e-3j * random.uniform(-1.0, 1.0, len(q))):
            each = [entry for part in mode._constraints for entry in part.f(t, place.tolist())]
            assert mode.f(t, place) == pytest.approx(np.array(each), abs=1e-14)
