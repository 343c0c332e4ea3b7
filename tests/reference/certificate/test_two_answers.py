"""Which rows a certificate has; each compares two answers, and a mistake in either is seen."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.certified import broken, certified
from given.mutants import mutant, with_mode

from textmech.cases.case import Case
from textmech.reference.certificate import certify, laws
from textmech.reference.certificate.agreement import Check, difference, relative, worst
from textmech.reference.certificate.errors import ERROR
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion import follow as following
from textmech.reference.motion.follow import Followed, either, follow
from textmech.reference.solve import solve
from textmech.reference.system import Load, Mass, Only, System
from textmech.reference.systems import written
from textmech.reference.systems.bodies.spring_mass_damper import SpringMassDamper
from textmech.reference.systems.pendula.bar_pendulum import BarPendulum

Patch = pytest.MonkeyPatch
Plant = Callable[[Case, System, Patch], tuple[Case, System]]
"""A mistake in the case's scene, in its hand-written system, or in an integrator."""

PENDULUM = replace(scenes.SHIPPED["bar_pendulum"], duration=0.8, samples=6)
SPRING = replace(scenes.SHIPPED["spring_mass_damper.underdamped"], duration=0.8, samples=6)
CHARGE = replace(scenes.SHIPPED["charge_in_field.drifting"], duration=0.8, samples=6)
BRAKING = scenes.SHIPPED["sliding_block.braking"]  # it slides down to its stop at 0.76 s
STEEP = replace(scenes.SHIPPED["sliding_disk.too_steep"], duration=0.1, samples=6)  # it slides on

GENERATED, MOVED = "generated motion", "generated accelerations"
REACTIONS, CLOSED = "generated reactions", "closed form"
LAGRANGE, POWER = "accelerations by Lagrange (2.44)", "power balance (2.51)"
BALANCE, FORCES = "Newton-Euler balance (2.23), (2.27)", "reactions by Newton-Euler"
IMPLICIT, OTHER, KNOWN = "implicit integrator: events", "generated events", "closed events"
DRIFT, POSSIBLE = "constraint drift", "modes possible"
EVENTS, WRITTEN = {IMPLICIT, OTHER, KNOWN}, {GENERATED, MOVED, REACTIONS}
OPTIONAL = EVENTS | WRITTEN | {CLOSED, DRIFT, POSSIBLE}
# What of OPTIONAL each case must have, and nothing else of it.
ROWS: dict[str, set[str]] = {
    "bar_pendulum": WRITTEN | {CLOSED},
    "double_pendulum": WRITTEN,
    "four_bar": WRITTEN | {DRIFT},
    "slider_crank": {DRIFT},
    # The contact of a disk that slips on has a residual, friction of a guide has none.
    "sliding_block.braking": WRITTEN | EVENTS | {CLOSED, POSSIBLE},
    "sliding_disk.backspin": WRITTEN | EVENTS | {CLOSED, DRIFT, POSSIBLE},
    "anisotropic_drift": WRITTEN | EVENTS - {KNOWN} | {POSSIBLE},
}


@pytest.mark.slow
@pytest.mark.parametrize("name", ROWS)
def test_a_certificate_has_the_rows_that_compare_something(name: str) -> None:
    assert {c.name for c in scenes.solved(name).checks} & OPTIONAL == ROWS[name]


@pytest.mark.slow
def test_where_nothing_changes_or_none_is_written_there_is_no_row() -> None:
    """Modes are asked all the same; and a generated answer is not compared with itself."""
    steep = {c.name for c in certified(STEEP, answer(STEEP))}
    assert steep & OPTIONAL == WRITTEN | {CLOSED, DRIFT, POSSIBLE}
    alone = {c.name: c for c in certified(BRAKING)}
    assert alone.keys() & OPTIONAL == {IMPLICIT, DRIFT, POSSIBLE}
    assert alone[POSSIBLE].difference == 0


def answer(case: Case) -> System:
    return written(case.system or "", case.parameters)


# Mistakes that are planted.


def in_mode(**methods: Callable[..., Any]) -> Plant:
    """In the mode in which the system starts."""

    def plant(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
        name = system.start()[0]
        return case, with_mode(system, name, mutant(system.modes[name], **methods))

    return plant


def in_system(**methods: Callable[..., Any]) -> Plant:
    return lambda case, system, patch: (case, mutant(system, **methods))


def scaled(number: Any, factor: float) -> Any:
    """A body's mass, or each of its moments of inertia, times a factor."""
    return tuple(factor * x for x in number) if isinstance(number, tuple) else factor * number


def in_scene(**changes: Any) -> Plant:
    """Of what the mechanism is generated from: the first body's, or the scene's."""

    def plant(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
        (name, body), *_ = case.scene.bodies.items()
        if "gravity" in changes:
            return replace(case, scene=replace(case.scene, **changes)), system
        bodies = {
            name: replace(body, **{k: scaled(getattr(body, k), f) for k, f in changes.items()})
        }
        return replace(case, scene=replace(case.scene, bodies=bodies)), system

    return plant


def patched(*given: Any) -> Plant:
    """With something of the reference replaced."""

    def plant(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
        patch.setattr(*given)
        return case, system

    return plant


def first(share: float) -> Plant:
    """In the explicit integrator, and so also in a second one that were the same: its weights."""
    attempt = DormandPrince.attempt
    more = lambda self, *arguments: (1 + share) * attempt(self, *arguments)  # noqa: E731
    return patched(DormandPrince, "attempt", more)


def second(share: float) -> Plant:
    """In the second integrator: it follows a motion that is so much faster."""
    other = certify._other_method
    faster = lambda mode, f, n: other(mode, lambda t, y: (1 + share) * f(t, y), n)  # noqa: E731
    return patched(certify, "_other_method", faster)


def delayed(*given: Any, **named: Any) -> Followed:
    """The same motion with its events a microsecond late."""
    followed = follow(*given, **named)
    changes = tuple(replace(c, time=c.time + 1e-6) for c in followed.changes)
    return replace(followed, changes=changes)


SECOND = certify._second_solution


def lost(*given: Any, **named: Any) -> tuple[str, Followed]:
    """A second integrator to which nothing happens."""
    name, other = SECOND(*given, **named)
    return name, replace(other, changes=())


def late(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    """Guards that fall where v has come to 1e-6 m/s."""
    shifted = lambda self, mode: [  # noqa: E731
        replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) + 1e-6) for g in system.guards(mode)
    ]
    return case, mutant(system, guards=shifted)


def gripping(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    """A disk that rolls wherever it is."""
    _, q, v = system.start()
    return case, mutant(system, start=lambda self: ("rolling", q, v), guards=lambda self, mode: ())


def times(factor: float, name: str) -> dict[str, Callable[..., Any]]:
    """The method of the pendulum, the spring or the disk, with all it answers so much larger."""

    def wrong(self: Any, *arguments: Any) -> Any:
        right = getattr(super(type(self), self), name)(*arguments)
        if isinstance(right, Mapping):
            return {key: factor * value for key, value in right.items()}
        return tuple(factor * x for x in right) if isinstance(right, tuple) else factor * right

    return {name: wrong}


def said(known: Callable[[list[tuple[str, float]]], list[tuple[str, float]]]) -> Plant:
    """What a block's system says that it does, said otherwise."""
    events = answer(BRAKING).closed_events
    return in_system(closed_events=lambda self, until: known(events(until) or []))


def heavier(share: float) -> Plant:
    """So much more weight on the free-cut body of the pendulum."""

    def loads(self: Any, t: float, q: Any, v: Any) -> list[Load]:
        sound: list[Load] = BarPendulum.loads(self, t, q, v)
        return [replace(each, force=(each.force[0], (1 + share) * each.force[1])) for each in sound]

    return in_mode(loads=loads)


POWER_TERMS = laws.energy.power_terms


def sometimes(system: Any, t: float, q: Any, v: Any) -> Any:
    return np.array([np.nan]) if 0.3 < t < 0.5 else POWER_TERMS(system, t, q, v)


def sloppy(*given: Any, tolerance: float, **named: Any) -> Any:
    return either(*given, tolerance=1e-6, **named)


FASTER = in_mode(**times(1.01, "accelerations"))
NO_GUARDS = patched(PlanarMechanism, "guards", lambda self, mode: ())


def checks(case: Case, plant: Plant | None, patch: Patch) -> dict[str, Check]:
    """By name, of the errors the worst."""
    system = answer(case)
    if plant is not None:
        case, system = plant(case, system, patch)
    rows = sorted(certified(case, system), key=lambda check: (not check.holds, check.difference))
    return {ERROR if c.certified is not None else c.name: c for c in rows}


@dataclass(frozen=True)
class Two:
    """A case in which the check is made, and a mistake in each of its two answers."""

    case: Case
    one: Plant
    other: Plant


CHECKS: dict[str, Two] = {
    ERROR: Two(PENDULUM, first(1e-8), second(1e-8)),
    LAGRANGE: Two(PENDULUM, FASTER, in_mode(**times(1.01, "U"))),
    **{
        f"accelerations by {form}": Two(STEEP, FASTER, in_mode(**times(1.01, "Q4")))
        for form in (
            "Lagrange with multipliers (2.60)",
            "Voronets (2.66)",
            "Chaplygin (2.67)",
            "Appell (2.80)",
        )
    },
    POWER: Two(PENDULUM, FASTER, in_mode(**times(1.01, "T"))),
    BALANCE: Two(PENDULUM, FASTER, heavier(0.01)),
    FORCES: Two(PENDULUM, in_mode(**times(1.01, "reactions")), heavier(0.01)),
    "Lagrangian (2.51), (2.52)": Two(CHARGE, FASTER, in_mode(**times(1.01, "V"))),
    GENERATED: Two(PENDULUM, FASTER, in_scene(gravity=(0.0, -9.8))),
    MOVED: Two(PENDULUM, FASTER, in_scene(inertia=1.01)),
    REACTIONS: Two(PENDULUM, in_mode(**times(1.01, "reactions")), in_scene(mass=1.01)),
    CLOSED: Two(SPRING, FASTER, in_mode(**times(1.01, "closed_form"))),
    IMPLICIT: Two(
        BRAKING,
        patched("given.laws.certified.follow", delayed),
        patched(certify, "follow", delayed),
    ),
    OTHER: Two(BRAKING, late, NO_GUARDS),
    KNOWN: Two(BRAKING, late, said(lambda events: [(name, t + 1e-6) for name, t in events])),
    DRIFT: Two(
        STEEP,
        in_mode(accelerations=lambda self, t, q, v: np.array([1.0, 1e-3, 1.0])),
        in_mode(f=lambda self, t, q: np.array([q[1] - self.R + 1e-6])),
    ),
    POSSIBLE: Two(STEEP, gripping, in_system(possible=lambda self, mode, t, q, v: "never")),
}
OF_ONE_ANSWER = {
    # read from poses and from the file alone: tests/reference/certificate/test_as_the_file_says.py
    "drives follow their laws",
    "driven points follow their laws",
    "forces follow their laws",
    "joints hold",
    "nothing slips",
    "nothing passes what holds it",
    "what presses touches",
    "friction is the file's",
    "blows are the file's",
    "springs act from their length on",
    "contacts move free bodies by (2.22)",
    "starts as it is given",
    "starts near what is said",
    "forces determined",  # tests/reference/test_determined.py
    "turns by their rates",  # tests/reference/motion/test_turns.py
}


@pytest.mark.slow
def test_every_check_of_a_shipped_case_is_here() -> None:
    names = {c.name for name in scenes.SHIPPED for c in scenes.solved(name).checks}
    named = {ERROR if name.startswith(ERROR) else name for name in names}
    assert named == set(CHECKS) | OF_ONE_ANSWER


@pytest.mark.slow
@pytest.mark.parametrize("case", [PENDULUM, SPRING, CHARGE, BRAKING, STEEP], ids=lambda c: c.name)
def test_the_checks_hold_where_nothing_is_wrong(case: Case, monkeypatch: Patch) -> None:
    assert broken(checks(case, None, monkeypatch).values()) == set()


@pytest.mark.mutant("the {side} of two answers wrong: {name}")
@pytest.mark.slow
@pytest.mark.parametrize("side", ["one", "other"])
@pytest.mark.parametrize("name", CHECKS)
def test_a_mistake_in_either_answer_is_seen(name: str, side: str, monkeypatch: Patch) -> None:
    two = CHECKS[name]
    assert not checks(two.case, getattr(two, side), monkeypatch)[name].holds


J_LARGER = 1e-6


def J_everywhere(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    """In the equations, in the energy and in the body, so that the system agrees with itself."""
    sound: Any = BarPendulum(**case.parameters)
    more = J_LARGER * sound._J_O()
    J = lambda self: sound._J_O() + more  # noqa: E731
    T = lambda self, t, q, v: sound.T(t, q, v) + more * v[0] ** 2 / 2  # noqa: E731
    wrong = mutant(sound, _J_O=J, T=T, closed_form=lambda self, t: None)
    object.__setattr__(wrong, "masses", {"bar": Mass(sound.m, sound.masses["bar"].J + more)})
    return replace(case, allow={"bar.angle": 1.0}, reach={}), Only(wrong)


def started_off(self: Any) -> Any:
    q, v = BarPendulum.start(self)
    return q + 1e-3, v


def undamped(self: Any, t: float, q: Any, v: Any) -> Any:
    return SpringMassDamper.accelerations(self, t, q, 0 * v)


def otherwise_damped(self: Any, t: float) -> Any:
    other = {**SPRING.parameters, "d": 1.001 * self.d}
    return SpringMassDamper(**other).closed_form(t)


HAND = "hand-written system: "
TOLD = "known functions tell of the events "
# By what is planted: the case, how, and all the rows that see it, or some of them.
PLANTED: dict[str, tuple[Case, Plant, set[str]]] = {
    f"{HAND}(2.34) with J 5 % too large in the explicit accelerations": (
        PENDULUM, in_mode(**times(1 / 1.05, "accelerations")),
        {GENERATED, MOVED, REACTIONS, CLOSED, LAGRANGE, POWER, BALANCE, ERROR},
    ),
    f"{HAND}starts a thousandth of a radian off": (
        PENDULUM, in_mode(start=started_off), {GENERATED, CLOSED, ERROR},
    ),
    f"{HAND}reactions on the ground instead of on the bar": (
        PENDULUM, in_mode(**times(-1, "reactions")), {REACTIONS, FORCES, ERROR},
    ),
    f"{HAND}the free-cut body without its weight": (PENDULUM, heavier(-1), {BALANCE}),
    f"{HAND}a damper in the energies that the accelerations do not know": (
        PENDULUM, in_mode(D=lambda self, t, q, v: 1e-3 * v[0] ** 2), {LAGRANGE, POWER},
    ),
    f"{HAND}d dropped in the explicit accelerations": (
        SPRING, in_mode(accelerations=undamped),
        {GENERATED, MOVED, CLOSED, LAGRANGE, POWER, BALANCE, ERROR},
    ),
    f"{HAND}the closed form of another damping": (
        SPRING, in_mode(closed_form=otherwise_damped), {CLOSED, ERROR},
    ),
    "J of a bar 1e-6 too large in all that the system says": (PENDULUM, J_everywhere, {MOVED}),
    "1e-10 of a bar's weight left out": (PENDULUM, heavier(-1e-10), {BALANCE}),
    "another gravity in the generated bar": (
        PENDULUM, in_scene(gravity=(0.0, 0.0)), {GENERATED, REACTIONS},
    ),
    "another inertia in the generated bar": (
        PENDULUM, in_scene(inertia=1.05), {GENERATED, REACTIONS},
    ),
    "another mass in the generated bar": (PENDULUM, in_scene(mass=1.05), {GENERATED, REACTIONS}),
    "an integrator with a tolerance of 1e-6": (
        PENDULUM, patched("given.laws.certified.either", sloppy), {ERROR},
    ),
    "explicit integrator 1e-4 off where modes switch": (BRAKING, first(1e-4), {ERROR}),
    "implicit integrator 1e-4 off where modes switch": (BRAKING, second(1e-4), {ERROR}),
    "NaN in the power balance of a part of the motion": (
        PENDULUM, patched(laws.energy, "power_terms", sometimes), {POWER},
    ),
    "a hand-written block that never stops": (
        BRAKING, in_system(guards=lambda self, mode: ()), {GENERATED, OTHER, KNOWN},
    ),
    "a generated block that never stops": (BRAKING, NO_GUARDS, {OTHER}),
    "events lost by the second integrator": (
        BRAKING, patched(certify, "_second_solution", lost), {IMPLICIT},
    ),
    "a stop at −1e-6 m/s, not at zero": (BRAKING, late, {OTHER, KNOWN}),
    "a mode that is never possible": (
        BRAKING, in_system(possible=lambda self, mode, t, q, v: "never"), {POSSIBLE},
    ),
    "floor 1 mm too low in (2.18)": (
        STEEP, in_mode(f=lambda self, t, q: np.array([q[1] - self.R + 1e-3])), {DRIFT},
    ),
    f"{TOLD}one fewer": (BRAKING, said(lambda events: events[1:]), {KNOWN}),
    f"{TOLD}one more": (BRAKING, said(lambda e: [*e, (e[0][0], e[0][1] + 0.1)]), {KNOWN}),
    f"{TOLD}one of another name": (BRAKING, said(lambda e: [*e, ("leaves", e[0][1])]), {KNOWN}),
    f"{TOLD}another name": (BRAKING, said(lambda e: [("leaves", t) for _, t in e]), {KNOWN}),
    f"{TOLD}1e-9 s later": (BRAKING, said(lambda e: [(n, t + 1e-9) for n, t in e]), {KNOWN}),
}  # fmt: skip
# Which rows have nothing to see, since both of what they compare say the same.
UNSEEN = {
    "J of a bar 1e-6 too large in all that the system says": {LAGRANGE, ERROR},
    "a generated block that never stops": {KNOWN},
    f"{HAND}reactions on the ground instead of on the bar": {GENERATED, MOVED},
}


# The block is certified soon, but for an integrator that fails again and again.
QUICK = [m for m in PLANTED if PLANTED[m][0] is BRAKING and "integrator 1e-4" not in m]
SLOW = [pytest.param(m, marks=pytest.mark.slow) for m in PLANTED if m not in QUICK]


@pytest.mark.mutant("{mistake}")
@pytest.mark.parametrize("mistake", [*QUICK, *SLOW])
def test_what_is_planted_is_seen(mistake: str, monkeypatch: Patch) -> None:
    case, plant, seen = PLANTED[mistake]
    fails = {name for name, c in checks(case, plant, monkeypatch).items() if not c.holds}
    assert seen <= fails
    assert not fails & UNSEEN.get(mistake, set())


@pytest.mark.slow
@pytest.mark.mutant("the first integrator a millionth too fast, in a scene alone")
@pytest.mark.parametrize("case", [PENDULUM, BRAKING], ids=["smooth", "switching"])
def test_the_second_integrator_is_no_copy_of_the_first(case: Case, monkeypatch: Patch) -> None:
    """Of a scene alone no other answer is known: a first one gone wrong shows beside it only."""
    faster = lambda f, *told: DormandPrince(lambda t, y: (1 + 1e-6) * f(t, y), *told)  # noqa: E731
    monkeypatch.setattr(following, "DormandPrince", faster)
    assert f"error of {next(iter(case.allow))}" in broken(certified(case))


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


# What is no mistake, though samples or a drift make it look like one.

RAILED = """\
scene:
  gravity: none
  points: {O: [0, 0], A: [-1, 0]}
  bodies: {b: {particle: {mass: 1.0}}}
  joints: {r: {slide: [ground.O, b.center], along: [1, 0]}}
"""


@pytest.mark.slow
@pytest.mark.mutant("a size by samples alone, which all may find the bodies where they pass zero")
def test_samples_at_zeros_tell_no_size() -> None:
    """Once a period, where it passes the origin: 2π rad/s, vx falls to zero at 0.25 s + k."""
    text = f"""\
{RAILED}\
  forces: {{s: {{spring: [ground.A, b.center], stiffness: 39.47841760435743, rest_length: 1.0}}}}
initial: {{b: {{x: 0, y: 0, vx: 0.3, vy: 0}}}}
events: {{top: {{b.vx: falls to zero}}}}
allow: {{b.vx: 1.0e-3, top.time: 1.0e-3}}
"""
    assert solve(scenes.parsed(text, tail=scenes.tail(5.0, 11))).holds


@pytest.mark.slow
@pytest.mark.mutant("a rate that drifts from its drive, taken for power that is missing")
@pytest.mark.parametrize(("duration", "samples"), [(60.0, 13), (240.0, 3)])
def test_a_long_drive_keeps_its_balance_of_power(duration: float, samples: int) -> None:
    """Its rate is integrated: what it drifts by is judged as drift, and is no power."""
    text = f"""\
{RAILED}\
  drive: {{r.speed: {{sine: {{amplitude: 1.0, angular_frequency: 10.0}}}}}}
initial: {{r: {{shift: 0}}}}
allow: {{b.x: 1.0e-3, b.vx: 1.0e-3}}
"""
    assert solve(scenes.parsed(text, tail=scenes.tail(duration, samples))).holds


@pytest.mark.slow
@pytest.mark.mutant("g of a drive by 1 + 1e-9, taken for the drift of its rate")
def test_another_drive_is_no_drift(monkeypatch: Patch) -> None:
    text = """\
scene: {drive: {hip.omega: {sine: {amplitude: 1.0, angular_frequency: 10.0}}}}
initial: {upper: {angle: 0}, lower: {angle: 0.3, omega: 1}}
allow: {upper.angle: null, upper.x: 1.0e-3, lower.angle: 1.0e-3}
"""
    case = scenes.scene("two_bars", text)
    assert solve(case).holds
    g = Multibody.g
    monkeypatch.setattr(Multibody, "g", lambda self, t, q: (1 + 1e-9) * np.asarray(g(self, t, q)))
    assert POWER in broken(solve(case))
