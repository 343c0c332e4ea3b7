"""The sleigh whose blade is driven: its path by quadrature, and where that is given up."""

from typing import Any

import pytest
from mpmath import cos, exp, mp, mpf, quad

from textmech.reference.systems.rolling import driven_edge
from textmech.reference.systems.rolling.driven_edge import DrivenEdge

SHIPPED = {"m": 1.7, "J": 0.09, "a": 0.35, "w0": 1.5, "A": 0.8, "Omega": 2.0, "alpha": 0.9}


def angle(system: DrivenEdge, t: float) -> float:
    """θ by 30 digits."""
    kappa = mpf(system.m) * system.a / (mpf(system.J) + mpf(system.m) * mpf(system.a) ** 2)
    reach = kappa * system.A / system.Omega
    with mp.workdps(30):
        law = lambda s: exp(-reach * (cos(system.alpha) - cos(system.Omega * s + system.alpha)))  # noqa: E731
        turned: Any = quad(law, [t * k / 16 for k in range(17)])
        return float(system.w0 * turned)


@pytest.mark.parametrize("A", [0.8, -0.4, 2.4, 4.0])
def test_its_angle_is_exact_however_strongly_it_is_driven(A: float) -> None:
    system = DrivenEdge(**{**SHIPPED, "A": A})
    known = system.closed_form(5.0)
    assert known is not None
    assert known[0][2] == pytest.approx(angle(system, 5.0), rel=1e-14)


def test_its_path_is_that_of_twice_as_many_panels(monkeypatch: pytest.MonkeyPatch) -> None:
    system = DrivenEdge(**SHIPPED)
    known = system.closed_form(5.0)
    monkeypatch.setattr(driven_edge, "PANELS", 2 * driven_edge.PANELS)
    finer = system.closed_form(5.0)
    assert known is not None
    assert finer is not None
    assert known[0] == pytest.approx(finer[0], abs=1e-14)
    slopes = [(system.closed_form(t) or known)[0] for t in (1.0 - 1e-5, 1.0 + 1e-5)]
    here = system.closed_form(1.0)
    assert here is not None
    assert (slopes[1] - slopes[0]) / 2e-5 == pytest.approx(here[1], abs=1e-8)


@pytest.mark.parametrize("changed", [{"A": 40.0}, {"A": -8.0}, {"Omega": 300.0}, {"w0": 900.0}])
def test_what_takes_minutes_has_none(changed: dict[str, float]) -> None:
    """Then the two marches answer for each other, as where nobody knows a function."""
    assert DrivenEdge(**{**SHIPPED, **changed}).closed_form(5.0) is None
