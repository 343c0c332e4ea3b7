"""Mistakes planted in generated modes that switch: the certificate of a written scene sees each."""

from collections.abc import Callable

import pytest
from given import scenes
from given.scenes import written_scenes

from textmech.cases.mistake import CaseError
from textmech.reference.mechanism.constraints.contact import Coulomb
from textmech.reference.mechanism.modes import blow, mechanism
from textmech.reference.mechanism.modes import element as contact_modes
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.element import State, Touching, sign
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve

G = 9.80665


def test_what_is_lifted_opens_its_contact() -> None:
    """(2.87) The floor no longer pushes at 20 t = m g."""
    changes = f"""
scene:
  gravity: {G}
  contacts: {{floor: {{between: [ball, ground.floor], friction: 0.3}}}}
  forces: {{rope: {{push: ball.center, ramp: [0, 20]}}}}
allow: {{ball.x: null, ball.y: 1.0e-3}}
"""
    case = scenes.scene("free_particle", changes)
    (opens,) = follow(scenes.mechanism(case), case.times).changes
    assert opens.name == "floor opens"
    assert opens.time == pytest.approx(G / 20, abs=1e-12)


def failing(name: str) -> set[str]:
    """The checks that do not hold, or `refused`."""
    scene, end = written_scenes.text(name)
    try:
        checks = solve(scenes.parsed(scene, tail=end)).checks
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
def test_mutant_static_for_kinetic(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: -touch.static))
    assert {"generated motion", "generated events"} <= failing("braking")


@pytest.mark.slow
@pytest.mark.mutant("kinetic friction that drives")
def test_mutant_sign_of_kinetic_friction(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Touching, "coulomb", _coulomb(lambda touch: touch.kinetic))
    assert {"generated motion", "generated events"} <= failing("braking")


@pytest.mark.mutant("a contact that never sticks")
@pytest.mark.slow
def test_mutant_without_sticking(monkeypatch: pytest.MonkeyPatch) -> None:
    for module in (contact_modes, mechanism):
        monkeypatch.setattr(module, "REST", ("slides +", "slides -"))
    assert failing("braking")
    assert failing("backspin")


@pytest.mark.mutant("restitution of an impact left out")
@pytest.mark.slow
def test_mutant_restitution_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    class Dead(blow.Meeting):
        def __init__(self, element, normal, tangent, after, strikes) -> None:  # type: ignore[no-untyped-def]
            super().__init__(element, normal, tangent, 0.0, strikes)

    monkeypatch.setattr(landing, "Meeting", Dead)
    assert {"generated motion", "generated events"} <= failing("elastic")


@pytest.mark.slow
@pytest.mark.mutant("friction cone left out: a disk rolls on any slope")
def test_mutant_cone_ignored(monkeypatch: pytest.MonkeyPatch) -> None:
    """A disk on a slope too steep for rolling would roll."""
    monkeypatch.setattr(Touching, "margins", lambda self, forces: (1.0, 1.0))
    assert "generated motion" in failing("too steep")


@pytest.mark.mutant("bounds of stiction forward and backward exchanged")
@pytest.mark.slow
def test_mutant_forward_for_backward(monkeypatch: pytest.MonkeyPatch) -> None:
    """A sign in (2.89): seen where the two bounds differ, not in Example 2.4."""
    margins = contact_modes.Sliding.margins
    monkeypatch.setattr(
        contact_modes.Sliding, "margins", lambda self, forces: margins(self, forces)[::-1]
    )
    assert failing("drift")
