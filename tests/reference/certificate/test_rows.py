"""Which rows a certificate has: those that compare something; and each of them can fail."""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes, written_scenes
from given.certified import certified
from given.mutants import mutant, with_mode

from textmech.cases.case import Case
from textmech.reference.certificate import certify as module
from textmech.reference.certificate.agreement import Check
from textmech.reference.mechanism.modes.mechanism import PlanarMechanism
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.system import MOVING, Array, Guard, System
from textmech.reference.systems import written

EVENTS = {"implicit integrator: events", "generated events", "closed events"}
WRITTEN = {"generated motion", "generated accelerations", "generated reactions"}
OPTIONAL = EVENTS | WRITTEN | {"closed form", "constraint drift", "modes possible"}

# What of OPTIONAL each case must have, and nothing else of it.
ROWS: dict[str, set[str]] = {
    "bar_pendulum": WRITTEN | {"closed form"},
    "double_pendulum": WRITTEN,
    "four_bar": WRITTEN | {"constraint drift"},
    "slider_crank": {"constraint drift"},
}
SWITCHING: dict[str, set[str]] = {
    # The contact of a disk that slips on has a residual, friction of a guide has none.
    "braking": WRITTEN | EVENTS | {"closed form", "modes possible"},
    "too steep": WRITTEN | {"closed form", "constraint drift", "modes possible"},
    "backspin": WRITTEN | EVENTS | {"closed form", "constraint drift", "modes possible"},
    "drift": WRITTEN | EVENTS - {"closed events"} | {"modes possible"},
}


def by_name(checks: Sequence[Check]) -> dict[str, Check]:
    return {check.name: check for check in checks}


def answer(case: Case) -> System:
    return written(case.system or "", case.parameters)


@pytest.fixture
def braking(tmp_path: Path) -> Case:
    """A block that slides down to its stop at 1.02 s."""
    return written_scenes.case(tmp_path, "braking")


@pytest.mark.parametrize("name", ROWS)
def test_rows_of_what_never_switches(name: str) -> None:
    case = replace(scenes.SHIPPED[name], duration=0.3, samples=4)
    checks = by_name(certified(case, answer(case) if case.system else None))
    assert checks.keys() & OPTIONAL == ROWS[name]
    assert all(check.holds for check in checks.values())


@pytest.mark.slow
@pytest.mark.parametrize("name", SWITCHING)
def test_rows_of_what_may_switch(tmp_path: Path, name: str) -> None:
    """Where nothing changes there is no row of events, but the modes are asked all the same."""
    case = written_scenes.case(tmp_path, name)
    checks = by_name(certified(case, answer(case)))
    assert checks.keys() & OPTIONAL == SWITCHING[name]
    assert all(check.holds for check in checks.values())


@pytest.mark.slow
def test_a_generated_answer_is_not_compared_with_itself(tmp_path: Path) -> None:
    checks = by_name(certified(written_scenes.generated(tmp_path, "braking")))
    seen = {"implicit integrator: events", "constraint drift", "modes possible"}
    assert checks.keys() & OPTIONAL == seen
    assert checks["modes possible"].difference == 0


@pytest.mark.slow
def test_modes_are_asked_where_there_are_others_or_what_ends_them(tmp_path: Path) -> None:
    """A disk that rolls from rest, which nothing ends; a pendulum with a guard that never falls."""
    scene, end = written_scenes.text("too steep")
    case = scenes.typed(tmp_path, scene.replace("60 deg", "10 deg"), tail=end)
    rolls = answer(case)
    assert rolls.guards(rolls.start()[0]) == ()
    assert "modes possible" in by_name(certified(case, rolls))
    case = replace(scenes.SHIPPED["bar_pendulum"], duration=0.3, samples=4)
    quiet = Guard("never", lambda t, q, v: 1.0, lambda t, q, v: (MOVING, q, v))
    guarded = mutant(answer(case), guards=lambda self, mode: (quiet,))
    assert "modes possible" in by_name(certified(case, guarded))


@pytest.mark.mutant("a hand-written block that never stops")
def test_a_written_system_without_the_change_is_seen(braking: Case) -> None:
    """It slides on where the generated one stops: no difference of times, another count."""
    on = mutant(answer(braking), guards=lambda self, mode: ())
    checks = by_name(certified(braking, on))
    for row in ("generated events", "closed events"):
        assert math.isinf(checks[row].difference)
        assert not checks[row].holds
    assert "implicit integrator: events" not in checks  # in neither of the two anything changes
    assert not checks["generated motion"].holds


@pytest.mark.mutant("a generated block that never stops")
def test_a_generated_one_without_the_change_is_seen(
    braking: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(PlanarMechanism, "guards", lambda self, mode: ())
    checks = by_name(certified(braking, answer(braking)))
    assert math.isinf(checks["generated events"].difference)
    assert not checks["generated events"].holds
    assert checks["closed events"].holds


@pytest.mark.mutant("events lost by the second integrator")
def test_a_second_integrator_without_the_change_is_seen(
    braking: Case, monkeypatch: pytest.MonkeyPatch
) -> None:
    second = module._second

    def lost(system: System, times: Array, *, stiff: bool) -> tuple[str, Followed]:
        name, other = second(system, times, stiff=stiff)
        return name, replace(other, changes=())

    monkeypatch.setattr(module, "_second", lost)
    check = by_name(certified(braking, answer(braking)))["implicit integrator: events"]
    assert math.isinf(check.difference)
    assert not check.holds


@pytest.mark.mutant("a stop at −1e-6 m/s, not at zero")
def test_a_change_that_comes_late_is_seen(braking: Case) -> None:
    """Where v has fallen to −1e-6 m/s, 0.3 μs late."""
    system = answer(braking)

    def guards(self: System, mode: str) -> Sequence[Guard]:
        return [replace(g, g=lambda t, q, v, g=g: g.g(t, q, v) + 1e-6) for g in system.guards(mode)]

    checks = by_name(certified(braking, mutant(system, guards=guards)))
    for row in ("generated events", "closed events"):
        assert checks[row].difference == pytest.approx(1e-6 / (0.3 * 9.80665), rel=1e-3)
        assert not checks[row].holds


@pytest.mark.mutant("a mode that is never possible")
def test_modes_that_are_not_possible_are_counted(braking: Case) -> None:
    never = mutant(answer(braking), possible=lambda self, mode, t, q, v: "never")
    check = by_name(certified(braking, never))["modes possible"]
    assert check.difference > len(braking.times)  # every step of the march, and each sample is one
    assert not check.holds


@pytest.mark.mutant("floor 1 mm too low in (2.18)")
@pytest.mark.slow
def test_a_residual_that_does_not_vanish_is_seen(tmp_path: Path) -> None:
    """A disk whose floor lies 1 mm too low in (2.18)."""
    case = written_scenes.case(tmp_path, "too steep")
    system = answer(case)
    name = system.start()[0]
    sunk: Any = system.modes[name]
    f = type(sunk).f
    lowered = mutant(sunk, f=lambda self, t, q: f(self, t, q) + 1e-3)
    check = by_name(certified(case, with_mode(system, name, lowered)))["constraint drift"]
    states = follow(system, case.times).y
    assert check.difference == pytest.approx(1e-3 / np.max(np.abs(states[:, :3])), rel=1e-6)
    assert not check.holds
