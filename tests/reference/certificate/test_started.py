"""A start beside a dead centre is known less well than the motion from it, and that is stated."""

import math
from pathlib import Path

import pytest
from given.linkages import SLIDER_CRANK
from given.scenes import tail, typed
from mpmath import acos, mp, mpf

from textmech.cases.case import Case
from textmech.cases.scene.observe import observe
from textmech.reference.solve import mechanism, solve
from textmech.reference.start import assembly

DIGITS = 40


def stated(case: Case) -> tuple[float, float]:
    """By how much the crank's first angle is off, and what the reference says of that [rad]."""
    found = solve(case)
    assert found.holds
    mp.dps = DIGITS
    x, l, L = mpf(case.initial["piston"].given["x"]), mpf(0.2), mpf(0.6)
    true = acos((l * l + x * x - L * L) / (2 * l * x))  # by the law of cosines
    first = observe(case.scene, found.trajectory, "crank.angle")[0]
    (error,) = (c.certified for c in found.checks if c.name == "error of crank.angle")
    assert error is not None
    return float(abs(mpf(float(first)) - true)), error


def beside(folder: Path, short: float) -> Case:
    """So many metres short of being stretched."""
    text = SLIDER_CRANK.replace("scene:\n", "scene:\n  gravity: none\n", 1)
    text += (
        f"initial: {{piston: {{x: {0.8 - short!r}, vx: -0.1}}}}\nnear: {{crank: {{angle: 0.1}}}}\n"
    )
    return typed(folder, text, tail=tail(1e-5, 3))


@pytest.mark.slow
@pytest.mark.mutant("the error of an ill-conditioned start is nobody's")
@pytest.mark.parametrize("digits", [6, 7, 8])
def test_what_a_start_is_known_to_is_stated(
    digits: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    case = beside(tmp_path, 10.0**-digits)
    off, error = stated(case)
    assert off <= error < 1e-8
    assert error > 1e-13 / math.sqrt(10.0 ** -(digits - 5))
    monkeypatch.setattr(assembly, "ILL", 0.0)
    assert stated(case)[1] < 1e-15


@pytest.mark.slow
def test_a_sound_start_costs_no_second_motion(tmp_path: Path) -> None:
    assert mechanism(beside(tmp_path, 0.1)).beside is None
