"""Each check compares two answers: a mistake in either of the two makes it fail."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes, written_scenes
from given.certified import certified
from given.mutants import mutant, with_mode
from given.typed_scenes import RAILED

from textmech.cases.case import Case
from textmech.reference.certificate import certify as module
from textmech.reference.certificate.agreement import Check
from textmech.reference.certificate.errors import ERROR
from textmech.reference.integrators.explicit import DormandPrince
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.mechanism.modes.mode import Multibody
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve
from textmech.reference.system import Load, System
from textmech.reference.systems import written
from textmech.reference.systems.pendula.bar_pendulum import BarPendulum

Patch = pytest.MonkeyPatch
Plant = Callable[[Case, System, Patch], tuple[Case, System]]
"""A mistake in the case's scene, in its hand-written system, or in an integrator."""

PENDULUM = replace(scenes.SHIPPED["bar_pendulum"], duration=0.8, samples=6)
SPRING = replace(scenes.SHIPPED["spring_mass_damper.underdamped"], duration=0.8, samples=6)

CHARGE = replace(scenes.SHIPPED["charge_in_field.drifting"], duration=0.8, samples=6)


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


def first(share: float) -> Plant:
    """In the explicit integrator, and so also in a second one that were the same: its weights."""

    def plant(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
        attempt = DormandPrince.attempt
        more = lambda self, *arguments: (1 + share) * attempt(self, *arguments)  # noqa: E731
        patch.setattr(DormandPrince, "attempt", more)
        return case, system

    return plant


def second(share: float) -> Plant:
    """In the second integrator: it follows a motion that is so much faster."""

    def plant(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
        other = module._other
        faster = lambda mode, f, n: other(mode, lambda t, y: (1 + share) * f(t, y), n)  # noqa: E731
        patch.setattr(module, "_other", faster)
        return case, system

    return plant


def _delayed(followed: Followed) -> Followed:
    return replace(
        followed, changes=tuple(replace(c, time=c.time + 1e-6) for c in followed.changes)
    )


def first_late(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    """The same motion with its events a microsecond late."""
    patch.setattr("given.certified.follow", lambda *a, **kinds: _delayed(follow(*a, **kinds)))
    return case, system


def second_late(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    patch.setattr(module, "follow", lambda *a, **kinds: _delayed(follow(*a, **kinds)))
    return case, system


def without_guards(case: Case, system: System, patch: Patch) -> tuple[Case, System]:
    patch.setattr(PlanarMechanism, "guards", lambda self, mode: ())
    return case, system


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
        found = getattr(super(type(self), self), name)(*arguments)
        if isinstance(found, Mapping):
            return {key: factor * value for key, value in found.items()}
        return tuple(factor * x for x in found) if isinstance(found, tuple) else factor * found

    return {name: wrong}


def heavier(self: Any, t: float, q: Any, v: Any) -> list[Load]:
    """1 % more weight on the free-cut body."""
    loads: list[Load] = BarPendulum.loads(self, t, q, v)
    return [replace(load, force=(load.force[0], 1.01 * load.force[1])) for load in loads]


@dataclass(frozen=True)
class Two:
    """A case in which the check is made, and a mistake in each of its two answers."""

    case: Case | str
    one: Plant
    other: Plant


LATER = in_system(closed_events=lambda self, until: [("stops", 1.02 + 1e-6)])
CHECKS: dict[str, Two] = {
    ERROR: Two(PENDULUM, first(1e-8), second(1e-8)),
    "accelerations by Lagrange (2.44)": Two(
        PENDULUM, in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "U"))
    ),
    "accelerations by Lagrange with multipliers (2.60)": Two(
        "too steep", in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "Q4"))
    ),
    **{
        f"accelerations by {form}": Two(
            "too steep", in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "Q4"))
        )
        for form in ("Voronets (2.66)", "Chaplygin (2.67)", "Appell (2.80)")
    },
    "power balance (2.51)": Two(
        PENDULUM, in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "T"))
    ),
    "Newton-Euler balance (2.23), (2.27)": Two(
        PENDULUM, in_mode(**times(1.01, "accelerations")), in_mode(loads=heavier)
    ),
    "reactions by Newton-Euler": Two(
        PENDULUM, in_mode(**times(1.01, "reactions")), in_mode(loads=heavier)
    ),
    "Lagrangian (2.51), (2.52)": Two(
        CHARGE, in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "V"))
    ),
    "generated motion": Two(
        PENDULUM, in_mode(**times(1.01, "accelerations")), in_scene(gravity=(0.0, -9.8))
    ),
    "generated accelerations": Two(
        PENDULUM, in_mode(**times(1.01, "accelerations")), in_scene(inertia=1.01)
    ),
    "generated reactions": Two(PENDULUM, in_mode(**times(1.01, "reactions")), in_scene(mass=1.01)),
    "closed form": Two(
        SPRING, in_mode(**times(1.01, "accelerations")), in_mode(**times(1.01, "closed_form"))
    ),
    "implicit integrator: events": Two("braking", first_late, second_late),
    "generated events": Two("braking", late, without_guards),
    "closed events": Two("braking", late, LATER),
    "constraint drift": Two(
        "too steep",
        in_mode(accelerations=lambda self, t, q, v: np.array([1.0, 1e-3, 1.0])),
        in_mode(f=lambda self, t, q: np.array([q[1] - self.R + 1e-6])),
    ),
    "modes possible": Two(
        "too steep", gripping, in_system(possible=lambda self, mode, t, q, v: "never")
    ),
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


def found(tmp_path: Path, two: Two, plant: Plant | None, patch: Patch) -> dict[str, Check]:
    case = two.case
    if isinstance(case, str):
        case = written_scenes.case(tmp_path, case)
    system = written(case.system or "", case.parameters)
    if plant is not None:
        case, system = plant(case, system, patch)
    checks = certified(case, system)
    return {ERROR if c.certified is not None else c.name: c for c in sorted(checks, key=_gravity)}


def _gravity(check: Check) -> tuple[bool, float]:
    return not check.holds, check.difference


@pytest.mark.slow
def test_every_check_of_a_shipped_case_is_here() -> None:
    names = {c.name for name in scenes.SHIPPED for c in scenes.solved(name).checks}
    named = {ERROR if name.startswith(ERROR) else name for name in names}
    assert named == set(CHECKS) | OF_ONE_ANSWER


@pytest.mark.slow
@pytest.mark.parametrize("name", CHECKS)
def test_the_check_holds_where_nothing_is_wrong(tmp_path: Path, name: str, monkeypatch: Patch):
    assert found(tmp_path, CHECKS[name], None, monkeypatch)[name].holds


@pytest.mark.mutant("the {side} of two answers wrong: {name}")
@pytest.mark.slow
@pytest.mark.parametrize("side", ["one", "other"])
@pytest.mark.parametrize("name", CHECKS)
def test_a_mistake_in_either_answer_is_seen(
    tmp_path: Path, name: str, side: str, monkeypatch: Patch
) -> None:
    two = CHECKS[name]
    assert not found(tmp_path, two, getattr(two, side), monkeypatch)[name].holds


@pytest.mark.slow
@pytest.mark.mutant(
    "explicit integrator 1e-4 off where modes switch",
    "implicit integrator 1e-4 off where modes switch",
)
def test_a_wrong_first_integrator_is_seen_where_modes_switch(
    tmp_path: Path, monkeypatch: Patch
) -> None:
    """And the second is no copy of it: both would be wrong alike."""
    two = Two("braking", first(1e-4), second(1e-4))
    for plant in (two.one, two.other):
        with monkeypatch.context() as patch:
            assert not found(tmp_path, two, plant, patch)[ERROR].holds


@pytest.mark.slow
@pytest.mark.mutant("a size by samples alone, which all may find the bodies where they pass zero")
def test_samples_at_zeros_tell_no_size(tmp_path: Path) -> None:
    """Once a period, where it passes the origin: 2π rad/s, vx falls to zero at 0.25 s + k."""
    text = f"""\
{RAILED}\
  forces: {{s: {{spring: [ground.A, b.center], stiffness: 39.47841760435743, rest_length: 1.0}}}}
initial: {{b: {{x: 0, y: 0, vx: 0.3, vy: 0}}}}
events: {{top: {{b.vx: falls to zero}}}}
allow: {{b.vx: 1.0e-3, top.time: 1.0e-3}}
"""
    assert solve(scenes.typed(tmp_path, text, tail=scenes.tail(5.0, 11))).holds


@pytest.mark.slow
@pytest.mark.mutant("a rate that drifts from its drive, taken for power that is missing")
def test_a_long_drive_keeps_its_balance_of_power(tmp_path: Path) -> None:
    """Its rate is integrated: what it drifts by is judged as drift, and is no power."""
    text = f"""\
{RAILED}\
  drive: {{r.speed: {{sine: {{amplitude: 1.0, angular_frequency: 10.0}}}}}}
initial: {{r: {{shift: 0}}}}
allow: {{b.x: 1.0e-3, b.vx: 1.0e-3}}
"""
    for duration, samples in ((60.0, 13), (240.0, 3)):
        assert solve(scenes.typed(tmp_path, text, tail=scenes.tail(duration, samples))).holds


@pytest.mark.slow
@pytest.mark.mutant("g of a drive by 1 + 1e-9, taken for the drift of its rate")
def test_another_drive_is_no_drift(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    text = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 1.0, length: 1.0}}, c: {bar: {mass: 1.0, length: 0.7}}}
  joints: {r: {pin: [ground.O, b.start]}, s: {pin: [b.end, c.start]}}
  drive: {r.omega: {sine: {amplitude: 1.0, angular_frequency: 10.0}}}
initial: {b: {angle: 0}, c: {angle: 0.3, omega: 1}}
allow: {b.x: 1.0e-3, c.angle: 1.0e-3}
"""
    case = scenes.typed(tmp_path, text)
    assert solve(case).holds
    g = Multibody.g
    monkeypatch.setattr(Multibody, "g", lambda self, t, q: (1 + 1e-9) * np.asarray(g(self, t, q)))
    broken = [check.name for check in solve(case).checks if not check.holds]
    assert "power balance (2.51)" in broken
