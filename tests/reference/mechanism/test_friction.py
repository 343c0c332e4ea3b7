"""Friction of slides and pins against closed forms, and joints that turn back at a dead centre."""

import cmath
import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.scenes import rubbing
from given.scenes.rubbing import HUNG
from scipy.integrate import quad
from scipy.optimize import brentq

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.reference.formalisms import lagrange
from textmech.reference.mechanism.constraints import contact
from textmech.reference.mechanism.constraints.constraint import Constraint
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Turning
from textmech.reference.mechanism.constraints.factorization import Full
from textmech.reference.mechanism.modes import element, mode
from textmech.reference.mechanism.modes.modes import Modes
from textmech.reference.mechanism.modes.smooth import SmoothMultibody
from textmech.reference.motion.follow import Followed, follow
from textmech.reference.solve import solve


def guided(law: str, speed: float) -> Any:
    """A point mass on an oblique rail whose friction differs forward and backward."""
    friction = "static: {forward: 3, backward: 4}, kinetic: {forward: 2, backward: 2.5}"
    rail = f"{{along: [0.6, 0.8], dry_friction: {{{friction}{law}}}}}"
    changes = f"scene: {{joints: {{rail: {rail}}}}}"
    return scenes.mechanism(scenes.scene("block_on_rail", changes, m=1.3, speed=speed))


@pytest.mark.parametrize("way", [1.0, -1.0])
def test_a_slide_brakes_by_its_own_bound(way: float) -> None:
    """(2.89) v₀ m / F₊ forward, v₀ m / F₋ backward; then it rests, by no force."""
    system = guided("", way)
    followed = follow(system, np.linspace(0.0, 1.0, 11))
    (stop,) = followed.changes
    assert stop.time == pytest.approx(1.3 / (2.0 if way > 0 else 2.5), abs=1e-12)
    assert stop.mode_after == "rail sticks"
    forces = system.modes["rail sticks"].reactions(0.0, *np.split(followed.y[-1], 2))
    assert forces["rail.friction"] == pytest.approx(0.0, abs=1e-12)


def test_smooth_friction_of_a_slide_by_the_formalisms() -> None:
    """(2.95) outside the band is −F₊; the residual by superposition is the sum of the forces."""
    system = guided(", smooth: {band: 0.05, sharpness: 100}", 0.0)
    mode, q, _ = system.start()
    mechanism = system.modes[mode]
    assert isinstance(mechanism, SmoothMultibody)
    for speed in (-1.0, -0.05, 0.0, 0.02, 0.05, 1.0):
        v = speed * np.array([0.6, 0.8])
        a = mechanism.accelerations(0.0, q, v)
        assert lagrange.multipliers(mechanism, 0.0, q, v)[0] == pytest.approx(a, abs=1e-12)
    v = np.array([0.6, 0.8])
    assert mechanism.accelerations(0.0, q, v) == pytest.approx(-2.0 / 1.3 * v, abs=1e-12)


@pytest.mark.slow
@pytest.mark.mutant("what slips at the last instant, followed behind the end")
def test_a_slip_that_begins_at_the_last_sample_is_none() -> None:
    """c u t = F_s, 2 · 0.3 · 10 N: all samples find it at rest."""
    changes = f"""
scene:
  points: {{hook: {{at: [5, 0], velocity: [0.3, 0]}}}}
  joints: {{rail: {{dry_friction: {{static: 6.0, kinetic: 5.1, stribeck: {{speed: 0.55}}}}}}}}
  forces: {{scale: {{spring: [block.center, ground.hook], stiffness: 2.0, rest_length: 5}}}}
rests: true
allow: {{rail.friction: 1.0e-2}}
{scenes.tail(10.0, 101)}"""
    motion = solve(scenes.scene("block_on_rail", changes, m=0.8))
    assert motion.holds
    assert np.all(motion.trajectory.states["block"][:, 0] == 0.0)


STACKED = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {low: {rigid: {mass: 3.21, inertia: 1}}, top: {rigid: {mass: 3.27, inertia: 1}}}
  joints:
    r1: {slide: [ground.O, low.center], along: [1, 0], dry_friction: {kinetic: 4.8}}
    r2: {slide: [low.center, top.center], along: [1, 0], dry_friction: {kinetic: 3.98}}
  forces: {pull: {push: top.center, ramp: [10.0, 0]}}
initial: {r1: {shift: 0, speed: 0}, r2: {shift: 0, speed: 0}}
stays: [low.x]
allow: {low.x: 1.0e-3, r2.shift: 1.0e-3}
"""


@pytest.mark.slow
def test_what_two_slides_hold_at_zero_rests() -> None:
    """Nothing but friction acts on the lower one; the upper slips from t₀ = 0.398 s on.

    x = 10 N/s (t − t₀)³/6 m.
    """
    motion = solve(scenes.parsed(STACKED, tail=scenes.tail(1.0, 41)))
    assert motion.holds
    slips = np.maximum(motion.trajectory.times - 0.398, 0.0)
    x = motion.trajectory.states["top"][:, 0]
    assert x == pytest.approx(10.0 * slips**3 / 6 / 3.27, abs=1e-14)


@pytest.mark.slow
@pytest.mark.mutant("what forces leave of no more than their rounding, beside applied ones alone")
def test_rounding_that_moves_what_is_held_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Full, "acceleration_sizes", lambda self, multipliers: 0.0)
    with pytest.raises(CaseError, match="the steps shrink to nothing"):
        solve(scenes.parsed(STACKED, tail=scenes.tail(1.0, 41)))


def rested(*a: float) -> list[float]:
    """What is left of accelerations beside forces that would give 10 m/s² each."""
    held = Full(np.zeros((0, len(a))), np.zeros(0), np.zeros((0, len(a))), False, ())
    return mode._at_rest(held, np.array(a), np.full(len(a), 10.0), np.zeros(0)).tolist()


def test_only_what_is_rounding_rests() -> None:
    """One of 1e-16 m/s² is what two of 10 leave of each other, and one of 1e-13 is not."""
    assert rested(5.0, 1e-16, -1e-16, 1e-13, 0.0) == [5.0, 0.0, 0.0, 1e-13, 0.0]
    assert rested(5.0, 1e-13) == [5.0, 1e-13]


@pytest.mark.mutant("rounding beside what moves is looked at where nothing moves alone")
def test_rounding_beside_what_moves_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mode, "min", max, raising=False)
    assert rested(5.0, 1e-16) == [5.0, 1e-16]
    assert rested(1e-16, 1e-16) == [0.0, 0.0]


SWINGS = scenes.tail(3.0, 31)
# rad: the half swings typed in the test are nudged off their turning points by 1e-6 s.
NEAR = 1e-9


def followed(text: str) -> tuple[Case, Followed]:
    case = scenes.parsed(text, tail=SWINGS)
    return case, follow(scenes.mechanism(case), case.times)


@pytest.mark.slow
def test_a_bar_swings_to_rest() -> None:
    case, found = followed(rubbing.swinging(HUNG, 1.0, 1.4))
    exact = rubbing.swung(case.times, 1.0, 1.4)
    assert np.max(np.abs(found.y[:, 2] - exact)) < NEAR
    assert found.modes[-1] == "hinge sticks"
    assert abs(np.ptp(exact)) > 1.0


@pytest.mark.parametrize("parts", ["a.center, b.center", "b.center, a.center"])
def test_a_clutch_couples(parts: str) -> None:
    case, found = followed(rubbing.CLUTCH.replace("PARTS", parts))
    for column, angle in zip((2, 5), rubbing.coupled(case.times), strict=True):
        np.testing.assert_allclose(found.y[:, column], angle, rtol=0, atol=1e-12)
    assert found.modes[0] != found.modes[-1] == "clutch sticks"


@pytest.mark.mutant("a pin that brakes the sum of both turns")
def test_mutant_pin_that_brakes_the_sum_of_both_turns(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = contact.at_rest

    def wrong(joint, where) -> Constraint:  # type: ignore[no-untyped-def]
        return replace(sound(joint, where), rows=((Turning(SECOND), Turning(FIRST, 1.0)),))

    monkeypatch.setattr(element, "at_rest", wrong)
    case, found = followed(rubbing.CLUTCH.replace("PARTS", "a.center, b.center"))
    assert np.max(np.abs(found.y[:, 5] - rubbing.coupled(case.times)[1])) > 0.1


@pytest.mark.slow
@pytest.mark.mutant("dry friction of a pin, forward and backward exchanged")
def test_mutant_friction_of_the_other_way() -> None:
    case, found = followed(rubbing.swinging(HUNG, 1.4, 1.0))
    assert np.max(np.abs(found.y[:, 2] - rubbing.swung(case.times, 1.0, 1.4))) > 1e-2


A, B, C, D = 0.15, 0.5, 0.4, 0.5  # m: crank, coupler or rod, rocker, base
OMEGA, DRY = 10.0, 0.1
FOUR_BAR = f"""\
scene:
  gravity: none
  points: {{P: [0, 0], Q: [{D}, 0]}}
  bodies:
    crank: {{bar: {{mass: 1.0, length: {A}}}}}
    coupler: {{bar: {{mass: 0.5, length: {B}}}}}
    rocker: {{bar: {{mass: 0.5, length: {C}}}}}
  joints:
    A: {{pin: [ground.P, crank.start]}}
    B: {{pin: [crank.end, coupler.start]}}
    C: {{pin: [coupler.end, rocker.end]}}
    D: {{pin: [ground.Q, rocker.start], dry_friction: {{kinetic: {DRY}}}}}
initial: {{crank: {{angle: 60 deg, omega: {OMEGA}}}}}
near: {{coupler: {{angle: 20 deg}}, rocker: {{angle: 80 deg}}}}
allow: {{crank.angle: 2.0e-2, rocker.angle: 2.0e-2}}
"""
END = scenes.tail(0.4, 26)


BEGIN = math.radians(60)


def pose(theta: float) -> tuple[float, complex, float]:
    """The rocker's angle, where the coupler's centre is, and its angle."""
    end = A * cmath.exp(1j * theta)
    r = abs(end - D)
    rocker = math.pi + cmath.phase(D - end) - math.acos((C * C + r * r - B * B) / (2 * C * r))
    joint = D + C * cmath.exp(1j * rocker)
    return rocker, (end + joint) / 2, cmath.phase(joint - end)


def slope(theta: float, i: int) -> complex:
    """Part i of the pose by θ, a difference of fourth order."""
    h = 1e-3
    one, two = (pose(theta + k * h)[i] - pose(theta - k * h)[i] for k in (1, 2))
    return (8 * one - two) / (12 * h)


TURN = brentq(lambda theta: slope(theta, 0).real, 3.6, 4.4)
"""Where the crank is [rad] when the rocker turns back."""


def inertia(theta: float) -> float:
    """2 T/θ̇² of all three bars."""
    rocker, centre, turns = (abs(slope(theta, i)) for i in range(3))
    return A**2 / 3 + 0.5 * (C**2 / 3 * rocker**2 + centre**2 + B**2 / 12 * turns**2)


def spent(theta: float) -> float:
    """2 times the work of friction, on the way to and fro."""
    there = pose(min(theta, TURN))[0] - pose(BEGIN)[0]
    back = pose(max(theta, TURN))[0] - pose(TURN)[0]
    return 2 * DRY * (abs(there) + abs(back))


def until(theta: float, begun: float) -> float:
    """∫ dθ/θ̇ [s], with the crank's rate by its energy."""
    energy = inertia(BEGIN) * begun**2

    def pace(at: float) -> float:
        return math.sqrt(inertia(at) / (energy - spent(at)))

    parts = ((BEGIN, min(theta, TURN)), (TURN, max(theta, TURN)))
    return sum(quad(pace, a, b, epsabs=1e-11, epsrel=1e-11)[0] for a, b in parts)


@pytest.mark.slow
@pytest.mark.parametrize("slow", [9.0, 0.01])
def test_a_rocker_turns_back_and_its_crank_goes_on_however_slowly(slow: float) -> None:
    """Begun so fast that friction leaves the crank so many rad/s where the rocker turns back.

    Its time is known the worse the slower it passes: ours by 1e-12 of the energy that is spent.
    """
    begun = math.sqrt((inertia(TURN) * slow**2 + spent(TURN)) / inertia(BEGIN))
    passes = until(TURN, begun)
    end = round(passes + 0.05, 4)
    text = FOUR_BAR.replace(f"omega: {OMEGA}", f"omega: {begun!r}")
    found = solve(scenes.parsed(text, tail=scenes.tail(end, 26)))
    assert found.holds
    assert found.trajectory.switches.tolist() == pytest.approx([passes], abs=1e-12 / slow**2)
    last = float(found.trajectory.states["crank"][-1, 2])
    assert last > TURN
    assert until(last, begun) == pytest.approx(end, abs=1e-10 + 1e-12 / slow**2)
    assert set(np.round(found.trajectory.reactions["D.friction"], 14)) == {-DRY, DRY}


@pytest.mark.slow
def test_what_a_stop_holds_too_rests_and_leaves_open_who_holds_it() -> None:
    """Of m g cos 30° l/2 the dry pin has 0.5 N m, or as much against it."""
    held = """
scene:
  joints: {hinge: {dry_friction: {kinetic: 0.5}}}
  forces: {ends: {stops: hinge, low: -30 deg}}
rests: true
allow: {ends.torque: ASKED}
"""
    case = scenes.scene("bar_on_pin", held.replace("ASKED", "null"), l=0.4, angle=-math.pi / 6)
    assert solve(case).holds
    asked = scenes.scene("bar_on_pin", held.replace("ASKED", "0.01"), l=0.4, angle=-math.pi / 6)
    mistake = refused(asked)
    m = 9.80665 * math.cos(math.radians(30)) * 0.2
    assert f"ends.torque: anything from {m - 0.5:.4g} to {m + 0.5:.4g} N m" in mistake.what


@pytest.mark.mutant("a joint that sticks where the others turn it")
def test_a_rocker_that_sticks_at_its_dead_centre_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Modes, "contradicts", lambda *_: False)
    mistake = refused(scenes.parsed(FOUR_BAR, tail=END))
    assert mistake.where == "duration"  # it is held where the others move it
