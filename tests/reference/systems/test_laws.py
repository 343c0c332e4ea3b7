"""Every hand-written system against the chapter's formalisms, its closed form and its limits."""

import importlib
from collections.abc import Callable
from dataclasses import replace
from types import ModuleType
from typing import Any
from unittest import mock

import numpy as np
import pytest
from given import laws
from given.laws import Law
from given.laws.events import LOCATED, event_errors
from given.laws.seen_by import AT_THE_START, PARAMETER
from given.machines import gimbals, muscles, robots, wheels
from given.machines.examples import MODES, PARAMETERS, SMOOTH, VARIANTS, duration, example, only
from given.machines.spatial import SPATIAL
from given.machines.states import states
from given.mutants import mutant

from textmech.reference.formalisms import lagrange
from textmech.reference.motion.follow import follow
from textmech.reference.system import MOVING, Load, Mode, Only
from textmech.reference.systems import SYSTEMS
from textmech.reference.systems.friction.dynamometer import Dynamometer

# Every mode of every hand-written system against the chapter's formalisms.

ASKED = [
    pytest.param(at, law, id=f"{'.'.join(at)}-{law.__name__}")
    for at in MODES
    for law in laws.LAWS
    if at in laws.ONLY.get(law, MODES)
]
STATED_IN_PARAMETERS = (laws.start,)  # what a variant changes


def test_every_system_is_tested():
    """Those in space by their own files."""
    rooms = (wheels.PARAMETERS, wheels.FROM_ABOVE, robots.PARAMETERS, gimbals.PARAMETERS)
    assert set(SYSTEMS) == set().union(PARAMETERS, SPATIAL, muscles.PARAMETERS, *rooms)


@pytest.mark.slow
@pytest.mark.parametrize(("at", "law"), ASKED)
def test_mode_obeys(at: laws.At, law: laws.Law):
    violation = law(example(at[0]), at)
    assert not laws.broken(law, violation), violation


@pytest.mark.parametrize("at", MODES, ids=".".join)
def test_laws_left_out_have_nothing_to_say(at: laws.At):
    system = example(at[0])
    mode = system.modes[at[1]]
    t, q, v = next(states(*at))
    assert len(mode.g(t, q)) == len(mode.f_a(t, q)) == len(lagrange.multipliers(mode, t, q, v)[1])
    starting = at[1] == system.start()[0]
    found = {
        laws.multipliers: len(mode.f_a(t, q)) > 0,
        laws.constraints: len(mode.f_a(t, q)) > 0,
        laws.reactions: bool(mode.reactions(t, q, v)),
        laws.start: starting,
        laws.closed_form: starting and system.closed_form(t) is not None,
    }
    assert found == {law: at in laws.ONLY[law] for law in found}


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_variant_obeys(variant: str):
    name, changed, _ = VARIANTS[variant]
    for at in [at for at in MODES if at[0] == name]:
        for law in laws.LAWS:
            if at in laws.ONLY.get(law, MODES) and law not in STATED_IN_PARAMETERS:
                violation = law(example(name, **changed), at)
                assert not laws.broken(law, violation), (at, law.__name__, violation)


@pytest.mark.parametrize("at", MODES, ids=".".join)
def test_complex_step_equals_central_difference(at: laws.At):
    """The complex step fails silently on abs, norm or max; a difference does not."""
    mode, h = example(at[0]).modes[at[1]], 1e-5
    t, q, v = next(states(*at))
    random = np.random.default_rng(2)
    dq, dv = random.normal(size=(2, len(q)))

    def poses(t: Any, q: Any, v: Any) -> Any:
        return np.array(list(mode.poses(t, q, v).values()))

    ingredients: list[Callable[[Any, Any, Any], Any]] = [
        poses, mode.T, mode.D, mode.Q4,
        lambda t, q, v: mode.U(t, q),
        lambda t, q, v: mode.f(t, q),
        lambda t, q, v: mode.f_a(t, q),
    ]  # fmt: skip
    if at[0].startswith("smooth"):
        ingredients.remove(mode.Q4)  # it casts to float; no formalism differentiates Q₄
    for function in ingredients:
        ahead = np.asarray(function(t + h, q + h * dq, v + h * dv))
        behind = np.asarray(function(t - h, q - h * dq, v - h * dv))
        exact = lagrange.derivative(function, (t, q, v), (1.0, dq, dv))
        np.testing.assert_allclose(exact, (ahead - behind) / (2 * h), rtol=1e-7, atol=1e-7)


# Motions and events of the hand-written systems against their closed forms.


@pytest.mark.slow
@pytest.mark.parametrize("variant", VARIANTS)
def test_motion_and_events_meet_the_closed_form(variant: str):
    name, changed, names = VARIANTS[variant]
    system, times = example(name, **changed), np.linspace(0.0, duration(name), 41)
    found = follow(system, times)
    assert [event.name for event in found.events] == names
    if name not in SMOOTH:
        assert max(event_errors(system, system, times[-1]), default=0.0) <= LOCATED
    for t, mode, y in zip(times.tolist(), found.modes, found.y, strict=True):
        known = system.closed_form(t)
        assert known is not None
        np.testing.assert_allclose(y, np.concatenate(known), rtol=0, atol=1e-12 * (1 + t**3))
        assert system.possible(mode, t, *np.split(y, 2)) is None


def test_published_phase_times_of_example_2_4():
    found = follow(example("dynamometer"), np.linspace(0.0, 10.0, 11)).events
    assert [round(e.time, 6) for e in found] == [1.5, 4.790544, 6.290544, 9.581087]


def test_spring_of_the_dynamometer():
    """Fig 2.24: at the first slip the force is F_s₊; where it stops, 2 F₊ − F_s₊ = 0."""
    system = example("dynamometer")
    assert isinstance(system, Dynamometer)
    forces = []
    for event in follow(system, np.linspace(0.0, 10.0, 11)).events:
        end, force = system.spring(event.time, event.after[:1])
        assert end == 2.0 * event.time
        forces.append(force)
    assert forces == pytest.approx([6.0, 0.0, 6.0, 0.0], abs=1e-12)


# Planted mistakes: the law that must see each is named, and it sees it.

DROPS_OUT = {
    ("rolling_wheel", "mu"),  # rolling needs enough friction, not a certain friction
    ("knife_edge", "J"),  # nothing turns it
}


def explicit_of(other: Mode) -> dict[str, Callable[..., Any]]:
    """The explicit accelerations and reactions of another system."""
    return {
        "accelerations": lambda self, t, q, v: other.accelerations(t, q, v),
        "reactions": lambda self, t, q, v: other.reactions(t, q, v),
    }


def module_of(system: Mode) -> ModuleType:
    return importlib.import_module(type(system).__module__)


def assert_seen(law: Law, name: str, mode: Mode) -> None:
    at = (name, MOVING)
    assert not laws.broken(law, law(Only(only(name)), at)), "sound, and yet refused"
    assert laws.broken(law, law(Only(mode), at))


def flat(table: dict[str, dict[str, Law]]) -> list[Any]:
    return [
        pytest.param(name, parameter, law, id=f"{name}: {parameter} seen by {law.__name__}")
        for name, laws_of in table.items()
        for parameter, law in laws_of.items()
    ]


def test_every_parameter_has_a_mutant():
    """Of what never switches; the others' modes share one law of friction, tested beside it."""
    assert set(PARAMETER) == {name for name in SMOOTH if not name.startswith("smooth")}
    planted = {
        (name, key)
        for table in (PARAMETER, AT_THE_START)
        for name, laws_of in table.items()
        for key in laws_of
    }
    assert planted | DROPS_OUT == {(name, key) for name in PARAMETER for key in PARAMETERS[name]}


@pytest.mark.mutant("{parameter} of {name} 5 % off in its explicit accelerations and reactions")
@pytest.mark.slow
@pytest.mark.parametrize(("name", "parameter", "law"), flat(PARAMETER))
def test_parameter_off_in_the_explicit_accelerations(name: str, parameter: str, law: Law):
    system = only(name)
    off = only(name, **{parameter: 1.05 * PARAMETERS[name][parameter]})
    assert_seen(law, name, mutant(system, **explicit_of(off)))


@pytest.mark.mutant("{parameter} of {name} 5 % off at the start")
@pytest.mark.parametrize(("name", "parameter", "law"), flat(AT_THE_START))
def test_parameter_off_at_the_start(name: str, parameter: str, law: Law):
    off = only(name, **{parameter: 1.05 * PARAMETERS[name][parameter]})
    assert_seen(law, name, mutant(only(name), start=lambda self: off.start()))


@pytest.mark.parametrize(("name", "parameter"), sorted(DROPS_OUT))
def test_parameter_that_drops_out(name: str, parameter: str):
    system = only(name)
    off = only(name, **{parameter: 1.05 * PARAMETERS[name][parameter]})
    for t, q, v in states(name, MOVING, 5):
        np.testing.assert_array_equal(system.accelerations(t, q, v), off.accelerations(t, q, v))
        assert system.reactions(t, q, v) == off.reactions(t, q, v)


# Of those that gravity moves: a sleigh has none, and a pin through its centre carries a disk's.
HEAVY = [name for name in PARAMETER if hasattr(module_of(only(name)), "G")]
HEAVY = [name for name in HEAVY if name not in ("torsion_pendulum", "paired_rotors")]


@pytest.mark.mutant("gravity upside down in the accelerations of {name}")
@pytest.mark.slow
@pytest.mark.parametrize("name", HEAVY)
def test_sign_of_gravity(name: str):
    system = only(name)

    def accelerations(self: Mode, t: float, q: Any, v: Any) -> Any:
        with mock.patch.object(module_of(system), "G", -9.80665):
            return system.accelerations(t, q, v)

    for law in (laws.equations, laws.free_cut, laws.power):
        assert_seen(law, name, mutant(system, accelerations=accelerations))


@pytest.mark.slow
@pytest.mark.mutant("Steiner term left out of the bar's accelerations")
def test_missing_steiner_term_in_the_explicit_accelerations():
    system = only("bar_pendulum")
    lonely = mutant(system, _J_O=lambda self: self.m * self.l**2 / 12)
    for law in (laws.equations, laws.free_cut, laws.power, laws.closed_form):
        assert_seen(law, "bar_pendulum", lonely)


@pytest.mark.mutant("Steiner term left out of the bar's kinetic energy")
def test_missing_steiner_term_in_the_kinetic_energy():
    def T(self: Any, t: Any, q: Any, v: Any) -> Any:
        return self.m * self.l**2 / 24 * v[0] ** 2

    for law in (laws.equations, laws.koenig):
        assert_seen(law, "bar_pendulum", mutant(only("bar_pendulum"), T=T))


@pytest.mark.mutant("four-bar linkage on the other branch of its loop")
def test_wrong_branch_of_the_four_bar():
    """The loop closes in two ways; mirrored at the line from B to Q it meets (2.14) as well."""
    system = only("four_bar")
    q, v = system.start()
    s = PARAMETERS["four_bar"]["d"] - PARAMETERS["four_bar"]["a"] * np.exp(1j * q[0])
    mirrored = np.array([q[0], *(2 * np.angle(s) - q[1:])])
    assert abs(system.f(0.0, mirrored)).max() < 1e-15
    assert_seen(laws.start, "four_bar", mutant(system, start=lambda self: (mirrored, v)))


@pytest.mark.mutant(
    "centrifugal terms left out of double_pendulum",
    "centrifugal terms left out of four_bar",
    "centrifugal terms left out of rhombus",
)
@pytest.mark.slow
def test_missing_centrifugal_terms():
    for name in ("double_pendulum", "four_bar", "rhombus"):
        system = only(name)
        still = mutant(
            system,
            accelerations=lambda self, t, q, v, system=system: system.accelerations(t, q, 0 * v),
        )
        for law in (laws.equations, laws.free_cut):
            assert_seen(law, name, still)


@pytest.mark.mutant("a damper that drives the mass on its spring")
def test_damping_with_the_wrong_sign():
    system = only("spring_mass_damper")
    fed = replace(system, d=-system.d)  # type: ignore[type-var, attr-defined]
    for law in (laws.equations, laws.free_cut, laws.power):
        assert_seen(law, "spring_mass_damper", mutant(system, **explicit_of(fed)))


@pytest.mark.mutant("rolling wheel without its generalized force")
def test_forgotten_generalized_force():
    blind = mutant(only("rolling_wheel"), Q4=lambda self, t, q, v: np.zeros(3))
    for law in (laws.equations, laws.power):
        assert_seen(law, "rolling_wheel", blind)


@pytest.mark.mutant("sign of the angle in the rolling wheel's constraint (2.17)")
def test_constraint_row_with_the_wrong_sign():
    """The book's φ is clockwise: with the angle's sign in (2.17) the wheel would slip."""
    wrong = np.array([[1.0, 0.0, 0.25], [0.0, 1.0, 0.0]])
    slipping = mutant(only("rolling_wheel"), f_a=lambda self, t, q: wrong)
    for law in (laws.constraints, laws.equations):
        assert_seen(law, "rolling_wheel", slipping)


@pytest.mark.mutant("rolling wheel's angle counted clockwise, as in the book")
def test_angle_of_the_wheel_taken_as_the_book_counts_it():
    def poses(self: Any, t: Any, q: Any, v: Any) -> Any:
        return {"wheel": (q[0], q[1], q[2], v[0], v[1], v[2])}

    assert_seen(laws.free_cut, "rolling_wheel", mutant(only("rolling_wheel"), poses=poses))


@pytest.mark.mutant("double pendulum's lower bar with the velocities of the upper one")
def test_pose_velocity_of_another_point():
    system = only("double_pendulum")

    def poses(self: Any, t: Any, q: Any, v: Any) -> Any:
        known = system.poses(t, q, v)
        return known | {"lower": (*known["lower"][:3], *known["upper"][3:])}

    for law in (laws.rates_of_poses, laws.koenig):
        assert_seen(law, "double_pendulum", mutant(system, poses=poses))


@pytest.mark.mutant("force of the elbow's second part on the first for the first's on the second")
def test_reaction_with_the_parts_exchanged():
    """`elbow.fx` is the force of the first part on the second, not of the second on the first."""
    system = only("double_pendulum")

    def reactions(self: Mode, t: float, q: Any, v: Any) -> dict[str, float]:
        known = system.reactions(t, q, v)
        return known | {"elbow.fx": -known["elbow.fx"]}

    assert_seen(laws.reactions, "double_pendulum", mutant(system, reactions=reactions))


@pytest.mark.mutant("rhombus whose spring pulls at one knee only")
def test_spring_that_pulls_at_one_knee_only():
    system = only("rhombus")

    def loads(self: Mode, t: float, q: Any, v: Any) -> list[Load]:
        return system.loads(t, q, v)[:-1]

    assert_seen(laws.free_cut, "rhombus", mutant(system, loads=loads))
