"""How small a mistake each bound still sees, and what is only a part of a check, each by itself."""

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.certified import broken, certified
from given.mutants import mutant, with_mode
from given.scenes.claims import CHAIN, claimed

from textmech.cases.case import Case
from textmech.cases.scene.joint import Joint
from textmech.reference.certificate import agreement, certify, errors, reaction_check
from textmech.reference.certificate.agreement import Check
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.motion.follow import TOLERANCE
from textmech.reference.solve import solve
from textmech.reference.states import answer
from textmech.reference.system import Array, Only
from textmech.reference.systems import written
from textmech.reference.systems.bodies.spring_mass_damper import SpringMassDamper
from textmech.reference.systems.pendula.bar_pendulum import BarPendulum

Patch = pytest.MonkeyPatch
PENDULUM = replace(scenes.SHIPPED["bar_pendulum"], duration=0.8, samples=6)
SPRING = replace(scenes.SHIPPED["spring_mass_damper.underdamped"], duration=0.8, samples=6)
SMOOTH = replace(scenes.SHIPPED["dynamometer_smooth"], duration=2.0, samples=6)


def pushed(share: float) -> Any:
    """The pendulum with reactions so much too large."""

    def reactions(self: Any, t: float, q: Array, v: Array) -> dict[str, float]:
        sound = BarPendulum.reactions(self, t, q, v)
        return {name: (1 + share) * force for name, force in sound.items()}

    return Only(mutant(BarPendulum(**PENDULUM.parameters), reactions=reactions))


@pytest.mark.mutant("bound of the generated reactions ten thousandfold")
def test_reactions_are_compared_to_rounding(monkeypatch: Patch) -> None:
    """AGREE is 1e-12 where the mechanism's equations are well conditioned."""
    assert "generated reactions" not in broken(certified(PENDULUM, pushed(0.0)))
    assert "generated reactions" in broken(certified(PENDULUM, pushed(3e-12)))
    monkeypatch.setattr(reaction_check, "AGREE", 1e-8)
    assert "generated reactions" not in broken(certified(PENDULUM, pushed(3e-12)))


FLAT = 0.36504424778761063  # s: both legs press along the slot that guides the trunk, to 2e-5 N
TRUNK = replace(scenes.SHIPPED["trunk_on_legs.bound"], duration=FLAT * 56 / 55, samples=57)


def row(case: Case, name: str) -> Check:
    (check,) = [check for check in solve(case).checks if check.name == name]
    return check


@pytest.mark.slow
@pytest.mark.mutant("a reaction's rounding as a share of what is left of it where it is zero")
def test_a_reaction_that_goes_through_zero_is_a_sum_of_what_is_large(monkeypatch: Patch) -> None:
    """Of legs with 300 N, sideways 0.001 N, its rounding is 5e-16 N: 3e-11 of what is left."""
    check = row(TRUNK, "generated reactions")
    assert (check.bound, check.holds) == (reaction_check.AGREE, True)
    monkeypatch.setattr(reaction_check, "_borne", lambda *_: 0.0)
    monkeypatch.setattr(reaction_check, "_sensitivity", lambda *_: 0.0)
    assert not row(TRUNK, "generated reactions").holds


@pytest.mark.slow
def test_a_reaction_beside_large_forces_is_compared_to_them() -> None:
    """The slot bears a hundredth of what the legs exert along what it holds."""
    sound = written(TRUNK.system or "", TRUNK.parameters)
    stance = sound.modes["stance"]

    def reactions(self: Any, t: float, q: Array, v: Array) -> dict[str, float]:
        return {name: (1 + 1e-9) * F for name, F in stance.reactions(t, q, v).items()}

    larger = with_mode(sound, "stance", mutant(stance, reactions=reactions))
    assert "generated reactions" in broken(certified(TRUNK, larger))


@pytest.mark.slow
@pytest.mark.mutant("rounding on the threshold of smooth friction not multiplied by its slope")
def test_on_the_threshold_of_smooth_friction_the_laws_slope_multiplies_rounding(
    monkeypatch: Patch,
) -> None:
    """Of 6 N half an ulp, times A = 1e5 and a band of 3 N: 1e-10 of the accelerations."""
    case = replace(SMOOTH, duration=3.0, samples=31)  # at 1.5 s the spring pulls with 6 N: F_s
    check = row(case, "generated accelerations")
    assert (check.bound, check.holds) == (reaction_check.AGREE, True)
    monkeypatch.setattr(reaction_check, "_sensitivity", lambda *_: 0.0)
    assert not row(case, "generated accelerations").holds


def off(share: float) -> Any:
    """The spring with a closed form so much too large."""

    def closed_form(self: Any, t: float) -> Any:
        q, v = SpringMassDamper.closed_form(self, t)
        return (1 + share) * q, (1 + share) * v

    return Only(mutant(SpringMassDamper(**SPRING.parameters), closed_form=closed_form))


def slower(share: float) -> Any:
    """The spring whose explicit accelerations are so much too small, and nothing to tell it by."""
    sound = SpringMassDamper(**SPRING.parameters)
    scaled = lambda self, t, q, v: (1 - share) * sound.accelerations(t, q, v)  # noqa: E731
    return Only(mutant(sound, accelerations=scaled, closed_form=lambda self, t: None))


@pytest.mark.mutant("a motion taken for a million times as sensitive as it is")
def test_motions_are_compared_to_what_they_are_known_to(monkeypatch: Patch) -> None:
    assert broken(certified(SPRING, off(0.0))) == set()
    assert "closed form" in broken(certified(SPRING, off(2e-12)))
    assert "generated motion" in broken(certified(SPRING, slower(1e-8)))
    assert "generated motion" not in broken(certified(SPRING, slower(0.0)))
    monkeypatch.setattr(certify, "LOOSER", 100 * 1e6)
    assert "closed form" not in broken(certified(SPRING, off(2e-12)))
    assert "generated motion" not in broken(certified(SPRING, slower(1e-8)))


@pytest.mark.slow
@pytest.mark.mutant("a stiff motion compared with itself")
def test_the_error_of_a_stiff_motion_is_that_of_another_tolerance(monkeypatch: Patch) -> None:
    """There is one stiff integrator: by its own tolerance it would agree with itself.

    A thousand times coarser it is known a hundred times less well, or worse; by tolerances whose
    errors are far above rounding: at the usual one they are not (2e-16 m).
    """
    used, either = list[float](), certify.either

    def noted(*given: Any, tolerance: float = TOLERANCE) -> Any:
        used.append(tolerance)
        return either(*given, tolerance=tolerance)

    def known(tolerance: float) -> float:
        monkeypatch.setattr(certify, "COARSER", tolerance)
        rows = {c.name: c for c in certified(SMOOTH)}
        certified_to = rows["error of block.x"].certified
        assert certified_to is not None
        return certified_to

    monkeypatch.setattr(certify, "either", noted)
    assert all(check.holds for check in certified(SMOOTH))
    assert min(used) > 5 * TOLERANCE
    known_to = known(1e-9)
    assert 1e-14 < known_to < 1e-10
    assert known(1e-6) > 100 * known_to
    monkeypatch.setattr(certify, "_other_method", lambda mode, f, n: either(mode, f, n))
    assert known(1e-9) < known_to / 1000  # nothing is left but rounding


@pytest.mark.slow
@pytest.mark.mutant("a heavy body that hangs at rest in space pulled by 1e-9 of its weight")
def test_what_hangs_at_rest_in_space_is_balanced(monkeypatch: Patch) -> None:
    """Nothing moves, so that only the equations at its states can say so."""
    text = """\
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
    case = scenes.parsed(text, tail=scenes.tail(1.0, 11))
    assert solve(case).holds
    U, pull = SpatialMultibody.U, 1e-9 * 2000 * 9.80665
    monkeypatch.setattr(SpatialMultibody, "U", lambda self, t, q: U(self, t, q) + pull * np.sum(q))
    names = broken(solve(case))
    assert any(name.startswith("accelerations by Lagrange") for name in names)


# Parts of checks.


@pytest.mark.mutant("inner states of muscles not compared")
def test_inner_states_are_compared() -> None:
    """Of a muscle's motion and itself, with its inner state so much longer."""
    case, motion = scenes.SHIPPED["muscle_load"], scenes.solved("muscle_load").trajectory
    (name,) = case.scene.inner()

    def apart(share: float, inner: Any) -> float:
        lengths = {**motion.reactions, name: (1 + share) * motion.reactions[name]}
        return agreement.difference(motion, replace(motion, reactions=lengths), inner)

    assert apart(0.0, case.scene.inner()) == 0.0
    assert apart(1e-6, case.scene.inner()) == pytest.approx(1e-6, rel=1e-6)
    assert apart(1e-6, ()) == 0.0


@pytest.mark.mutant("the share of a late event in the error of a state left out")
def test_a_state_at_an_event_is_known_as_well_as_its_time(monkeypatch: Patch) -> None:
    """Beside what it is off by itself, the fastest change times what the event is late."""
    case = scenes.SHIPPED["spring_mass_jump.best"]
    motion = scenes.solved(case.name).trajectory

    def known(late: float) -> float:
        """Of a jumper's speed as it takes off, if that is known so well [s]."""
        rows = errors.errors(case, motion, {}, late)
        to = next(c for c in rows if c.name == "error of takes_off.jumper.vy").certified
        assert to is not None
        return to

    vy = motion.states["jumper"][:, 4]
    fastest = np.max(np.abs(np.diff(vy) / np.diff(motion.times)))
    assert known(1e-3) - known(0.0) == pytest.approx(1e-3 * fastest, rel=1e-9)
    flat = SimpleNamespace(**(vars(np) | {"diff": lambda x: 0.0 * np.diff(x)}))
    monkeypatch.setattr(errors, "np", flat)
    assert known(1e-3) == known(0.0)


MOVING, COORDINATES, PLACE = answer.moving, Joint.coordinates, SpatialMultibody.place


def hurried(*given: Any) -> Any:
    return {name: 1.001 * x for name, x in MOVING(*given).items()}


def read(place: float, rate: float) -> Callable[..., Any]:
    """Coordinates of joints, read so much too large."""

    def coordinates(self: Any, *given: Any) -> Any:
        places, rates = COORDINATES(self, *given)
        return place * places, rate * rates

    return coordinates


def placed(part: int) -> Callable[..., Any]:
    """States with one part off by a thousandth: places (0), or velocities (1)."""

    def place(self: Any, poses: Any) -> Any:
        at = [*PLACE(self, poses)]
        at[part] = at[part] + 1e-3
        return tuple(at)

    return place


STATES: dict[str, tuple[str, Any, str, Callable[..., Any]]] = {
    "accelerations of a chain": ("joints hold", answer, "moving", hurried),
    "velocities of a chain": ("joints hold", SpatialMultibody, "place", placed(1)),
    "places of a chain": ("joints hold", SpatialMultibody, "place", placed(0)),
    "rates of joints": ("coordinates read back", Joint, "coordinates", read(1, 0.999)),
    "places of joints": ("coordinates read back", Joint, "coordinates", read(0.999, 1)),
}


@pytest.mark.slow
@pytest.mark.mutant("{what} a thousandth off, in a claim about states")
@pytest.mark.parametrize("what", STATES)
def test_a_check_of_states_fails_by_itself(what: str, tmp_path: Path, monkeypatch: Patch) -> None:
    seen, owner, name, planted = STATES[what]
    case = claimed(tmp_path, CHAIN)
    assert all(check.holds for check in answer.answered(case)[1])
    monkeypatch.setattr(owner, name, planted)
    _, checks = answer.answered(case)
    assert seen in {name.partition(" (")[0] for name in broken(checks)}
