"""What needs no multipliers, in the certificate: which formalism a case has, and what it sees."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.examples import only
from given.formal import FORMAL, drawn
from given.mutants import mutant
from given.states import states
from given.turning_bodies import J

from textmech.reference.certificate import laws
from textmech.reference.certificate.agreement import Check
from textmech.reference.formalisms import voronets
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.system import Array, Mode

TIMES = np.linspace(0.0, 2.0, 5)
VORONETS, CHAPLYGIN, APPELL = (f"accelerations by {name}" for name in laws.ELIMINATED)


class Unit(laws.Scale):
    """1 m/s² or rad/s² is what all is small against."""

    def __init__(self) -> None:
        pass

    def alone(self, mode: Mode, t: float, q: Array, v: Array) -> float:
        return 1.0

    def idle(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        return np.ones(n)

    def turned(self, mode: Mode, t: float, q: Array, n: int) -> Array:
        return np.full(n, np.inf)

    def assembled(self, mode: Mode, t: float, q: Array, v: Array, there: Array) -> bool:
        return True


def checks(mode: Mode, y: Array) -> dict[str, Check]:
    return {check.name: check for check in laws.eliminated(mode, Unit(), TIMES, y)}


def rows(name: str) -> Array:
    return np.array([np.concatenate(at[1:]) for at in drawn(name, 5)])


@pytest.mark.parametrize(
    ("name", "names"),
    [
        ("sleigh", [VORONETS, CHAPLYGIN, APPELL]),
        ("upright wheel", [VORONETS, CHAPLYGIN, APPELL]),
        ("top", [VORONETS, APPELL]),
    ],
)
def test_the_ingredients_tell_which_apply(name: str, names: list[str]) -> None:
    found = checks(FORMAL[name], rows(name))
    assert list(found) == names
    assert all(check.holds for check in found.values())


def _other_beta(patch: pytest.MonkeyPatch) -> None:
    beta = voronets.beta
    patch.setattr(voronets, "beta", lambda *at: -beta(*at))


def _other_gravity(patch: pytest.MonkeyPatch) -> None:
    U = type(FORMAL["sleigh"]).U
    patch.setattr(type(FORMAL["sleigh"]), "U", lambda self, t, q: 1.000001 * U(self, t, q))


@pytest.mark.mutant("sign of β in (2.65)", "a potential 1e-6 too large")
@pytest.mark.parametrize(
    ("plant", "seen"),
    [(_other_beta, {VORONETS}), (_other_gravity, {VORONETS, CHAPLYGIN, APPELL})],
)
def test_a_mistake_is_seen(
    plant: Callable[[pytest.MonkeyPatch], None], seen: set[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    plant(monkeypatch)
    found = checks(FORMAL["sleigh"], rows("sleigh"))
    assert {name for name, check in found.items() if not check.holds} == seen


@pytest.mark.mutant("gyroscopic moment left out where the motion has none")
def test_what_the_motion_never_shows_is_seen_beside_it() -> None:
    """A body that turns about a principal axis has no gyroscopic moment to lose."""
    sound: Any = FORMAL["free body"]
    axis = np.linalg.eigh(J)[1][:, 2]
    row = np.concatenate([np.zeros(3), [1.0, 0.0, 0.0, 0.0], np.zeros(3), 2.0 * axis])

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        return sound.accelerations(t, q, np.concatenate([v[:3], 0.0 * v[3:]]))

    lost = mutant(sound, accelerations=accelerations)
    np.testing.assert_allclose(
        lost.accelerations(0.0, row[:7], row[7:]),
        sound.accelerations(0.0, row[:7], row[7:]),
        atol=1e-14,
    )
    found = checks(lost, np.array([row] * 5))
    assert not any(check.holds for check in found.values())
    assert found.keys() == {VORONETS, APPELL}


@pytest.mark.parametrize(("light", "bound"), [(0.7, 1e-12), (1e-4, 1e-10), (1e-9, 1e-5)])
def test_the_bound_tells_what_uneven_masses_lose(light: float, bound: float) -> None:
    """Ten times ε and the ratio of the masses, in whole powers of ten."""
    mode = only("double_pendulum", m1=light, m2=1.0)
    y = np.array([np.concatenate(at[1:]) for at in states("double_pendulum", "moving", 5)])
    (check,) = checks(mode, y).values()
    assert check.holds
    assert check.bound == pytest.approx(bound)


@pytest.mark.parametrize(("light", "asked"), [(1e-7, True), (1e-10, False)])
def test_equations_that_lost_half_of_their_digits_are_not_asked(light: float, asked: bool) -> None:
    """The lower body of a crossed pendulum as light as that: their condition is about 1 over it."""
    case = scenes.SHIPPED["crossed_pendulum"]
    sound = scenes.mechanism(case).base
    bodies = {**case.scene.bodies}
    last: Any = list(bodies.values())[-1]
    inertia = tuple(light * x for x in last.inertia)
    bodies[last.name] = replace(last, mass=light * last.mass, inertia=inertia)
    mode = SpatialMultibody(replace(sound.scene, bodies=bodies), sound.start())
    found = checks(mode, np.array([np.concatenate(mode.start())] * 5))
    assert list(found) == ([VORONETS, APPELL] if asked else [])
    assert all(check.holds for check in found.values())


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "numbers"),
    [
        ("rolling_wheel.pushed", {"2.61", "2.63", "2.65", "2.66", "2.67", "2.74", "2.77", "2.80"}),
        ("four_bar", {"2.61", "2.63", "2.65", "2.66", "2.73", "2.78", "2.80"}),
        ("bar_pendulum", {"2.73", "2.74", "2.77", "2.78", "2.80"}),
    ],
)
def test_equations_are_executed_by_the_certificate(name: str, numbers: set[str]) -> None:
    assert numbers <= scenes.solved(name).equations
