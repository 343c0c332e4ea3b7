"""The certificate can fail: one thing broken at a time, and the check that sees it."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.certified import certified
from given.mutants import mutant

from textmech.cases.case import Case
from textmech.reference import systems
from textmech.reference.certificate import laws
from textmech.reference.certificate.agreement import Check, difference, relative, worst
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.motion import follow
from textmech.reference.motion.follow import TOLERANCE
from textmech.reference.system import Array, Load, Mass, Mode, Only
from textmech.reference.systems.particles.spring_mass_damper import SpringMassDamper
from textmech.reference.systems.pendula.bar_pendulum import BarPendulum

GENERATED, MOVED = "generated motion", "generated accelerations"
REACTIONS, CLOSED = "generated reactions", "closed form"
LAGRANGE = "accelerations by Lagrange (2.44)"
POWER, BALANCE, FORCES = (
    "power balance (2.51)",
    "Newton-Euler balance (2.23), (2.27)",
    "reactions by Newton-Euler",
)
ANGLE = "error of bar.angle"


def failing(case: Case, mode: Mode, *, tolerance: float = TOLERANCE) -> set[str]:
    """The checks that do not hold if the case is answered by this mode."""
    checks = certified(case, Only(mode), tolerance=tolerance)
    return {check.name for check in checks if not check.holds}


def written(case: Case) -> Mode:
    """The hand-written mode of a smooth case."""
    found = systems.SYSTEMS[case.system or ""](**case.parameters)
    assert isinstance(found, Mode)
    return found


PENDULUM = replace(scenes.SHIPPED["bar_pendulum"], duration=2.0, samples=26)
SPRING = replace(scenes.SHIPPED["spring_mass_damper.underdamped"], duration=2.0, samples=26)
STOPS = scenes.SHIPPED["sliding_block.braking"]


class Heavy(BarPendulum):
    """(2.34) with J 5 % too large in the explicit accelerations."""

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return super().accelerations(t, q, v) / 1.05


class Started(BarPendulum):
    """Starts a thousandth of a radian off."""

    def start(self) -> tuple[Array, Array]:
        q, v = super().start()
        return q + 1e-3, v


class Swapped(BarPendulum):
    """Reactions on the ground instead of on the bar."""

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        return {name: -force for name, force in super().reactions(t, q, v).items()}


class Weightless(BarPendulum):
    """The free-cut body without its weight."""

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        return []


class Leaking(BarPendulum):
    """A damper in the energies that the accelerations do not know."""

    def D(self, t: float, q: Array, v: Array) -> float:
        return 1e-3 * v[0] ** 2


class Undamped(SpringMassDamper):
    """d dropped in the explicit accelerations."""

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        return super().accelerations(t, q, 0 * v)


class Otherwise(SpringMassDamper):
    """The closed form of another damping."""

    def closed_form(self, t: float) -> tuple[Array, Array]:
        other = {**SPRING.parameters, "d": 1.001 * self.d}
        return SpringMassDamper(**other).closed_form(t)


BROKEN: dict[type[Mode], tuple[Case, set[str]]] = {
    Heavy: (PENDULUM, {GENERATED, MOVED, REACTIONS, CLOSED, LAGRANGE, POWER, BALANCE, ANGLE}),
    Started: (PENDULUM, {GENERATED, CLOSED, ANGLE}),
    Swapped: (PENDULUM, {REACTIONS, FORCES, "error of hinge.fx"}),
    Weightless: (PENDULUM, {BALANCE}),
    Leaking: (PENDULUM, {LAGRANGE, POWER}),
    Undamped: (SPRING, {GENERATED, MOVED, CLOSED, LAGRANGE, POWER, BALANCE, "error of mass.y"}),
    Otherwise: (SPRING, {CLOSED, "error of mass.y"}),
}


@pytest.mark.slow
@pytest.mark.parametrize("case", [PENDULUM, SPRING], ids=lambda case: case.name)
def test_unbroken_systems_hold(case: Case) -> None:
    assert failing(case, written(case)) == set()


@pytest.mark.mutant("hand-written system: {kind}")
@pytest.mark.slow
@pytest.mark.parametrize("kind", BROKEN, ids=lambda kind: kind.__name__)
def test_a_broken_system_is_seen(kind: type[Mode]) -> None:
    case, seen = BROKEN[kind]
    assert seen <= failing(case, kind(**case.parameters))


@pytest.mark.slow
@pytest.mark.mutant("an integrator with a tolerance of 1e-6")
def test_a_sloppy_integrator_is_seen() -> None:
    system = BarPendulum(**PENDULUM.parameters)
    assert ANGLE in failing(PENDULUM, system, tolerance=1e-6)


@pytest.mark.slow
@pytest.mark.mutant("the first integrator a millionth too fast, in a scene alone")
@pytest.mark.parametrize("case", [PENDULUM, STOPS], ids=["smooth", "switching"])
def test_the_second_integrator_is_no_copy_of_the_first(
    case: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Of a scene alone no other answer is known: a first one gone wrong shows beside it only."""

    def broken() -> set[str]:
        return {check.name for check in certified(case) if not check.holds}

    assert not broken()
    faster = lambda f, *told: DormandPrince(lambda t, y: (1 + 1e-6) * f(t, y), *told)  # noqa: E731
    monkeypatch.setattr(follow, "DormandPrince", faster)
    assert f"error of {next(iter(case.allow))}" in broken()


@pytest.mark.mutant("another {change} in the generated bar")
@pytest.mark.slow
@pytest.mark.parametrize("change", ["gravity", "inertia", "mass"])
def test_a_wrong_generated_answer_is_seen(change: str) -> None:
    """The mistake is in the scene here: the written system does not look there."""
    scene = PENDULUM.scene
    bar = scene.bodies["bar"]
    wrong = {
        "gravity": replace(scene, gravity=(0.0, 0.0)),
        "inertia": replace(scene, bodies={"bar": replace(bar, inertia=(1.05 * bar.moment,))}),
        "mass": replace(scene, bodies={"bar": replace(bar, mass=1.05 * bar.mass)}),
    }[change]
    case = replace(PENDULUM, scene=wrong)
    assert {GENERATED, REACTIONS} <= failing(case, BarPendulum(**case.parameters))


@pytest.mark.slow
def test_nan_never_holds() -> None:
    """Python's max drops a NaN that does not come first."""
    assert not Check("any", float("nan"), 1.0).holds
    assert np.isnan(worst([1.0, float("nan"), 2.0]))
    assert np.isnan(relative(np.array([1.0, 2.0]), np.array([1.0, np.nan])))
    one = scenes.solved("bar_pendulum").trajectory
    states = {name: rows.copy() for name, rows in one.states.items()}
    states["bar"][3, 5] = np.nan
    assert np.isnan(difference(one, replace(one, states=states)))


@pytest.mark.slow
@pytest.mark.mutant("NaN in the power balance of a part of the motion")
def test_nan_in_a_law_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    terms: Callable[..., Array] = laws.energy.power_terms

    def sometimes(system: Mode, t: float, q: Array, v: Array) -> Array:
        return np.array([np.nan]) if 0.9 < t < 1.0 else terms(system, t, q, v)

    monkeypatch.setattr(laws.energy, "power_terms", sometimes)
    assert failing(PENDULUM, BarPendulum(**PENDULUM.parameters)) == {POWER}


@pytest.mark.slow
@pytest.mark.mutant("J of a bar 1e-6 too large in all that the system says")
def test_a_millionth_is_seen_however_loose_the_tolerances_are() -> None:
    """J 1e-6 too large in all that the system says, so that it agrees with itself."""
    case = replace(PENDULUM, allow={"bar.angle": 1.0}, reach={})
    sound: Any = written(case)
    more = 1e-6 * sound._J_O()
    J = lambda self: sound._J_O() + more  # noqa: E731
    T = lambda self, t, q, v: sound.T(t, q, v) + more * v[0] ** 2 / 2  # noqa: E731
    wrong = mutant(sound, _J_O=J, T=T, closed_form=lambda self, t: None)
    object.__setattr__(wrong, "masses", {"bar": Mass(sound.m, sound.masses["bar"].J + more)})
    broken = {c.name for c in certified(case, Only(wrong)) if not c.holds}
    assert MOVED in broken
    assert not broken & {LAGRANGE, ANGLE}


@pytest.mark.slow
@pytest.mark.mutant("1e-10 of a bar's weight left out")
def test_a_residual_is_told_in_its_size() -> None:
    """A hundred times the bound: a ten thousand millionth of the weight that is not there."""
    case = replace(PENDULUM, allow={"bar.angle": 1.0}, reach={})
    sound = written(case)
    weight = sound.loads(0.0, np.zeros(1), np.zeros(1))[0].force[1]
    missing = lambda self, t, q, v: [  # noqa: E731
        replace(load, force=(0.0, weight * (1 - 1e-10))) for load in sound.loads(t, q, v)
    ]
    system = Only(mutant(sound, loads=missing))
    checks = {c.name: c for c in certified(case, system)}
    check = checks[BALANCE]
    assert not check.holds
    assert math.log10(check.difference / 1e-10) == pytest.approx(0.0, abs=1.0)
