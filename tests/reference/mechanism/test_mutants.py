"""Mistakes planted in the generated modes, by name: the certificate sees each."""

from collections.abc import Callable
from pathlib import Path

import pytest
from given import written_scenes

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.constraints.contact import Coulomb
from textmech.reference.mechanism.modes import blow, mechanism
from textmech.reference.mechanism.modes import element as contact_modes
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.element import State, Touching, sign
from textmech.reference.solve import solve


def failing(tmp_path: Path, name: str) -> set[str]:
    """The checks that do not hold, or `refused`."""
    try:
        checks = solve(written_scenes.case(tmp_path, name)).checks
    except CaseError:
        return {"refused"}
    return {check.name for check in checks if not check.holds}


def _coulomb(
    coefficient: Callable[[Touching], float],
) -> Callable[[Touching, State], list[Coulomb]]:
    def coulomb(self: Touching, state: State) -> list[Coulomb]:
        s = sign(state)
        assert self.normal is not None
        return [Coulomb(self.normal, self.tangent, coefficient(self) * s)] if s else []

    return coulomb


@pytest.mark.slow
@pytest.mark.mutant("static friction in the place of kinetic")
def test_mutant_static_for_kinetic(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: -touch.static))
    assert {"generated motion", "generated events"} <= failing(tmp_path, "braking")


@pytest.mark.slow
@pytest.mark.mutant("kinetic friction that drives")
def test_mutant_sign_of_kinetic_friction(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: touch.kinetic))
    assert {"generated motion", "generated events"} <= failing(tmp_path, "braking")


@pytest.mark.mutant("a contact that never sticks")
@pytest.mark.slow
def test_mutant_without_sticking(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (contact_modes, mechanism):
        monkeypatch.setattr(module, "REST", ("slides +", "slides -"))
    assert failing(tmp_path, "braking")
    assert failing(tmp_path, "backspin")


@pytest.mark.mutant("restitution of an impact left out")
@pytest.mark.slow
def test_mutant_restitution_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    class Dead(blow.Meeting):
        def __init__(self, element, normal, tangent, after, strikes) -> None:  # type: ignore[no-untyped-def]
            super().__init__(element, normal, tangent, 0.0, strikes)

    monkeypatch.setattr(landing, "Meeting", Dead)
    assert {"generated motion", "generated events"} <= failing(tmp_path, "elastic")


@pytest.mark.slow
@pytest.mark.mutant("friction cone left out: a disk rolls on any slope")
def test_mutant_cone_ignored(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk on a slope too steep for rolling would roll."""
    monkeypatch.setattr(Touching, "margins", lambda self, forces: (1.0, 1.0))
    assert "generated motion" in failing(tmp_path, "too steep")


@pytest.mark.mutant("bounds of stiction forward and backward exchanged")
@pytest.mark.slow
def test_mutant_forward_for_backward(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A sign in (2.89): seen where the two bounds differ, not in Example 2.4."""
    margins = contact_modes.Sliding.margins
    monkeypatch.setattr(
        contact_modes.Sliding, "margins", lambda self, forces: margins(self, forces)[::-1]
    )
    assert failing(tmp_path, "drift")
