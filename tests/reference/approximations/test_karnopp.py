"""The band in place of v = 0, by Karnopp's own rule, taken literally, and as a boxcar."""

import numpy as np
import pytest
from given.examples import example

from textmech.reference.approximations.approximation import Karnopp, boxcars
from textmech.reference.laws.friction import Dry
from textmech.reference.motion.follow import follow

BOOK = Dry(3.0, 3.0, 6.0, 6.0)
STEPS = (1e-3, 5e-4, 2.5e-4, 1.25e-4)


def _karnopp(*, literal: bool, Delta: float) -> Karnopp:
    pull = example("dynamometer").modes["stuck"].pull  # type: ignore[attr-defined]
    return Karnopp(1.0, pull, BOOK, Delta, literal)


def test_karnopp_by_his_own_rule_is_the_exact_law_for_small_bands():
    """Erratum 15. The stop comes Δ/|v̇| early, Δ²/(2 |v̇|) short; |v̇| is 3 m/s² there."""
    times, Delta = np.linspace(0.0, 10.0, 51), 5e-4
    exact = follow(example("dynamometer"), times)
    found = follow(_karnopp(literal=False, Delta=Delta), times)
    assert [e.name for e in found.events] == [e.name for e in exact.events]
    late = [a.time - b.time for a, b in zip(found.events, exact.events, strict=True)]
    assert late == pytest.approx([0.0, -Delta / 3, 0.0, -Delta / 3], abs=1e-7)
    assert np.abs(found.y - exact.y)[:, 0].max() == pytest.approx(2 * Delta**2 / 6, rel=0.01)


@pytest.mark.slow
def test_karnopp_taken_literally_keeps_its_speed_while_it_sticks():
    times, Delta = np.linspace(0.0, 10.0, 2001), 5e-4
    exact = follow(example("dynamometer"), times)
    found = follow(_karnopp(literal=True, Delta=Delta), times)
    sticks = found.y[(times > 4.8) & (times < 6.2)]
    np.testing.assert_allclose(sticks[:, 1], Delta, rtol=1e-12)
    assert np.abs(found.y - exact.y)[:, 0].max() == pytest.approx(8.7e-4, rel=0.01)


@pytest.mark.slow
def test_boxcar_form_approaches_karnopp_taken_literally():
    times = np.linspace(0.0, 10.0, 101)
    known = follow(_karnopp(literal=True, Delta=5e-4), times).y
    errors = []
    for h in STEPS:
        rows = boxcars(1.0, lambda t, x: 4 * t - 2 * x, BOOK, Delta=5e-4, h=h, steps=round(10 / h))
        errors.append(np.abs(rows[:: round(0.1 / h)] - known)[:, 0].max())
    assert 0.75 < np.polyfit(np.log(STEPS), np.log(errors), 1)[0] < 1.35, errors
