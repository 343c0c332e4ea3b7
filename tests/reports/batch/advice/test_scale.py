"""Another tolerance than the case's: errors over a part of each quantity's own size."""

from collections.abc import Callable
from typing import Any

import pytest
from given.otherwise import otherwise

from textmech.reports.batch.advice import advise
from textmech.reports.batch.advice import criterion as bar
from textmech.reports.batch.search.candidate import Candidate
from textmech.reports.compare.trial.trial import Trial

ONE = Candidate.of({}, 1e-3)


def scale(made: Trial, tolerance: float | None, module: Any = advise) -> Any:
    return module._scale(made, tolerance)


@pytest.mark.mutant("what is asked for upside down")
def test_an_error_is_told_over_a_part_of_the_quantitys_size(trial: Callable[..., Trial]) -> None:
    """It reaches 1 m, and 1 cm is allowed: ten times a thousandth of it."""
    made = trial()
    assert scale(made, None) == {}
    assert scale(made, 1e-3) == {"ball.x": pytest.approx(10.0)}
    assert scale(made, 1e-1) == {"ball.x": pytest.approx(0.1)}
    was = "(trial.allowed(name) or 0.0) / (tolerance * size)"
    other = otherwise(advise, was, "(tolerance * size) / (trial.allowed(name) or 1.0)")
    assert scale(made, 1e-3, other) == {"ball.x": pytest.approx(0.1)}


@pytest.mark.mutant("a thousandth of what is zero but for rounding is asked for")
@pytest.mark.parametrize("size", [0.0, 4e-17])
def test_what_is_zero_has_no_size(
    trial: Callable[..., Trial], size: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    made = trial()
    monkeypatch.setattr(Trial, "size", lambda self, name: size)
    assert scale(made, 1e-3) == {}
    was = "size > ZERO * (trial.allowed(name) or 0.0)"
    assert (scale(made, 1e-3, otherwise(advise, was, "size > 0")) == {}) is (size == 0.0)


def holds(margin: float, factor: float, module: Any = bar) -> bool:
    """Of an error of 0.4 of what the case allows."""
    return module.Bar({ONE: {"x": (0.4, 0.4)}}, margin, {"x": factor}).holds(ONE)


@pytest.mark.mutant("the tolerance that is asked for, or the margin, left out")
def test_the_margin_and_the_tolerance_that_is_asked_for_are_kept() -> None:
    assert [holds(margin, 1.0) for margin in (1.0, 2.0, 3.0)] == [True, True, False]
    assert [holds(1.0, factor) for factor in (0.1, 2.0, 10.0)] == [True, True, False]
    assert holds(1.0, 10.0, otherwise(bar, " * self.scale.get(name, 1.0)", ""))
    assert holds(3.0, 1.0, otherwise(bar, "<= 1 / self.margin", "<= 1"))
