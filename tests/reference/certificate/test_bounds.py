"""How small a mistake each bound of the certificate still sees: bounds are not only there."""

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.certified import certified
from given.mutants import mutant, with_mode

from textmech.cases.case import Case
from textmech.reference.certificate import certify as module
from textmech.reference.certificate import reaction_check as at_states
from textmech.reference.certificate.agreement import Check
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.motion.follow import TOLERANCE
from textmech.reference.solve import solve
from textmech.reference.system import Array, Only
from textmech.reference.systems import written
from textmech.reference.systems.particles.spring_mass_damper import SpringMassDamper
from textmech.reference.systems.pendula.bar_pendulum import BarPendulum

Patch = pytest.MonkeyPatch

PENDULUM = replace(scenes.SHIPPED["bar_pendulum"], duration=0.8, samples=6)
SPRING = replace(scenes.SHIPPED["spring_mass_damper.underdamped"], duration=0.8, samples=6)
SMOOTH = replace(scenes.SHIPPED["dynamometer_smooth"], duration=2.0, samples=6)


def broken(case: Case, system: Any) -> set[str]:
    return {check.name for check in certified(case, system) if not check.holds}


def pushed(share: float) -> Any:
    """The pendulum with reactions so much too large."""

    def reactions(self: Any, t: float, q: Array, v: Array) -> dict[str, float]:
        sound = BarPendulum.reactions(self, t, q, v)
        return {name: (1 + share) * force for name, force in sound.items()}

    return mutant(Only(BarPendulum(**PENDULUM.parameters)).mode, reactions=reactions)


def test_reactions_are_compared_to_rounding() -> None:
    """AGREE is 1e-12 where the mechanism's equations are well conditioned."""
    seen = "generated reactions"
    assert seen not in broken(PENDULUM, Only(pushed(0.0)))
    assert seen in broken(PENDULUM, Only(pushed(3e-12)))


@pytest.mark.mutant("bound of the generated reactions ten thousandfold")
def test_a_loose_bound_of_reactions_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(at_states, "AGREE", 1e-8)
    assert "generated reactions" not in broken(PENDULUM, Only(pushed(3e-12)))


FLAT = (
    0.36504424778761063  # s: both legs press along the slot that guides the trunk, but for 2e-5 N
)
TRUNK = replace(scenes.SHIPPED["trunk_on_legs.bound"], duration=FLAT * 56 / 55, samples=57)


def reactions_of(case: Case) -> Check:
    (found,) = [check for check in solve(case).checks if check.name == "generated reactions"]
    return found


@pytest.mark.slow
def test_a_reaction_that_goes_through_zero_is_a_sum_of_what_is_large() -> None:
    """Of legs with 300 N, sideways 0.001 N, its rounding is 5e-16 N: 3e-11 of what is left."""
    found = reactions_of(TRUNK)
    assert found.bound == at_states.AGREE
    assert found.holds


@pytest.mark.slow
@pytest.mark.mutant("a reaction's rounding as a share of what is left of it where it is zero")
def test_the_size_of_what_is_left_alone_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(at_states, "_borne", lambda *_: 0.0)
    monkeypatch.setattr(at_states, "_steep", lambda *_: 0.0)
    assert not reactions_of(TRUNK).holds


@pytest.mark.slow
@pytest.mark.parametrize("share", [0.0, 1e-9])
def test_a_reaction_beside_large_forces_is_compared_to_them(share: float) -> None:
    """The slot bears a hundredth of what the legs exert along what it holds."""
    assert TRUNK.system is not None
    sound = written(TRUNK.system, TRUNK.parameters)
    assert sound is not None
    stance = sound.modes["stance"]

    def reactions(self: Any, t: float, q: Array, v: Array) -> dict[str, float]:
        return {name: (1 + share) * F for name, F in stance.reactions(t, q, v).items()}

    larger = with_mode(sound, "stance", mutant(stance, reactions=reactions))
    assert ("generated reactions" in broken(TRUNK, larger)) == (share > 0.0)


THRESHOLD = replace(SMOOTH, duration=3.0, samples=31)  # at 1.5 s the spring pulls with 6 N: F_s


@pytest.mark.slow
def test_on_the_threshold_of_smooth_friction_the_laws_slope_multiplies_rounding() -> None:
    """Of 6 N half an ulp, times A = 1e5 and a band of 3 N: 1e-10 of the accelerations."""
    found = {check.name: check for check in solve(THRESHOLD).checks}["generated accelerations"]
    assert found.holds
    assert found.bound == at_states.AGREE


@pytest.mark.slow
@pytest.mark.mutant("rounding on the threshold of smooth friction not multiplied by its slope")
def test_without_the_laws_slope_the_threshold_is_refused(monkeypatch: Patch) -> None:
    monkeypatch.setattr(at_states, "_steep", lambda *_: 0.0)
    assert "generated accelerations" in {c.name for c in solve(THRESHOLD).checks if not c.holds}


def off(share: float) -> Any:
    """The spring with a closed form so much too large."""

    def closed_form(self: Any, t: float) -> Any:
        q, v = SpringMassDamper.closed_form(self, t)
        return (1 + share) * q, (1 + share) * v

    return mutant(SpringMassDamper(**SPRING.parameters), closed_form=closed_form)


def test_closed_forms_are_compared_to_what_a_motion_is_known_to() -> None:
    assert broken(SPRING, Only(off(0.0))) == set()
    assert "closed form" in broken(SPRING, Only(off(2e-12)))


def slower(share: float) -> Any:
    """The spring whose explicit accelerations are so much too small, and nothing to tell it by."""
    sound = SpringMassDamper(**SPRING.parameters)
    scaled = lambda self, t, q, v: (1 - share) * sound.accelerations(t, q, v)  # noqa: E731
    return mutant(sound, accelerations=scaled, closed_form=lambda self, t: None)


def test_a_generated_motion_is_compared_to_1e_9() -> None:
    assert "generated motion" in broken(SPRING, Only(slower(1e-8)))
    assert "generated motion" not in broken(SPRING, Only(slower(0.0)))


@pytest.mark.mutant("a motion taken for a million times as sensitive as it is")
def test_a_bound_that_grows_with_rounding_is_seen(monkeypatch: Patch) -> None:
    monkeypatch.setattr(module, "LOOSER", 100 * 1e6)
    assert "closed form" not in broken(SPRING, Only(off(2e-12)))
    assert "generated motion" not in broken(SPRING, Only(slower(1e-8)))


def tolerances(patch: Patch) -> set[float]:
    """Those by which the second answer to a stiff motion is followed."""
    used, either = set(), module.either

    def noted(*given: Any, tolerance: float = TOLERANCE) -> Any:
        used.add(tolerance)
        return either(*given, tolerance=tolerance)

    patch.setattr(module, "either", noted)
    assert all(check.holds for check in certified(SMOOTH))
    return used


@pytest.mark.slow
def test_a_stiff_motion_has_a_second_answer_by_another_tolerance(monkeypatch: Patch) -> None:
    """There is one stiff integrator: by its own tolerance it would agree with itself."""
    (used,) = tolerances(monkeypatch)
    assert used > 5 * TOLERANCE


@pytest.mark.slow
@pytest.mark.mutant("a stiff motion compared with itself")
def test_the_error_of_a_stiff_motion_is_that_of_its_tolerance(monkeypatch: Patch) -> None:
    """A thousand times coarser it is known a hundred times less well, or worse.

    By tolerances whose errors are far above rounding: at the usual one they are not (2e-16 m).
    """

    def known(tolerance: float) -> float:
        monkeypatch.setattr(module, "COARSER", tolerance)
        found = {c.name: c for c in certified(SMOOTH)}
        certified_to = found["error of block.x"].certified
        assert certified_to is not None
        return certified_to

    known_to = known(1e-9)
    assert 1e-14 < known_to < 1e-10
    assert known(1e-6) > 100 * known_to
    monkeypatch.setattr(module, "_other", lambda mode, f, n: module.either(mode, f, n))
    assert known(1e-9) < known_to / 1000  # nothing is left but rounding


HANGS = """\
rests: true
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    bell:
      rigid: {mass: 2000, inertia: [300, 400, 350, 0, 0, 0]}
      points: {eye: [0, 0, 1.0]}
  joints: {pin: {hinge: [ground.O, bell.eye], axis: [0, 1, 0]}}
initial: {pin: {angle: 0, omega: 0}}
allow: {bell.x: 1.0e-3}
"""


def failing(folder: Path) -> list[Check]:
    case = scenes.typed(folder, HANGS, tail=scenes.tail(1.0, 11))
    return [check for check in solve(case).checks if not check.holds]


@pytest.mark.slow
@pytest.mark.mutant("a heavy body that hangs at rest in space pulled by 1e-9 of its weight")
def test_what_hangs_at_rest_in_space_is_balanced(tmp_path: Path, monkeypatch: Patch) -> None:
    """Nothing moves, so that only the equations at its states can say so."""
    assert failing(tmp_path) == []
    U = SpatialMultibody.U
    pull = 1e-9 * 2000 * 9.80665
    monkeypatch.setattr(SpatialMultibody, "U", lambda self, t, q: U(self, t, q) + pull * np.sum(q))
    names = {check.name for check in failing(tmp_path)}
    assert any(name.startswith("accelerations by Lagrange") for name in names)
