"""A dry joint that turns back at a dead centre: it cannot stick where the others turn it."""

import cmath
import math
from functools import partial
from pathlib import Path

import numpy as np
import pytest
from given import scenes
from given.refused import refused
from scipy.integrate import quad
from scipy.optimize import brentq

from textmech.reference.mechanism.modes.modes import Modes
from textmech.reference.solve import solve

A, B, C, D = 0.15, 0.5, 0.4, 0.5  # m: crank, coupler, rocker, base
OMEGA, DRY = 10.0, 0.1
BEGIN = math.radians(60)
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
ON_A_STOP = """\
scene:
  points: {O: [0, 0]}
  bodies: {arm: {bar: {mass: 1, length: 0.4}}}
  joints: {elbow: {pin: [ground.O, arm.start], dry_friction: {kinetic: 0.5}}}
  forces: {ends: {stops: elbow, low: -30 deg}}
initial: {elbow: {angle: -30 deg}}
allow: {arm.angle: 1.0e-2}
"""
END = scenes.tail(0.4, 26)


def pose(theta: float) -> tuple[float, complex, float]:
    """The rocker's angle, where the coupler's centre is, and its angle."""
    end = A * cmath.exp(1j * theta)
    r = abs(end - D)
    rocker = math.pi + cmath.phase(D - end) - math.acos((C * C + r * r - B * B) / (2 * C * r))
    joint = D + C * cmath.exp(1j * rocker)
    return rocker, (end + joint) / 2, cmath.phase(joint - end)


def slope(theta: float, i: int) -> complex:
    """By θ, a difference of fourth order."""
    h = 1e-3
    one, two = (pose(theta + k * h)[i] - pose(theta - k * h)[i] for k in (1, 2))
    return (8 * one - two) / (12 * h)


def inertia(theta: float) -> float:
    """2 T/θ̇² of the three bars."""
    rocker, coupler, turns = (abs(slope(theta, i)) for i in range(3))
    of_crank, of_rocker = 1.0 * A**2 / 3, 0.5 * C**2 / 3
    return of_crank + of_rocker * rocker**2 + 0.5 * coupler**2 + 0.5 * B**2 / 12 * turns**2


def speed(theta: float, turn: float) -> float:
    """By its energy, less the moment times what the rocker has turned, to and fro."""
    there = pose(min(theta, turn))[0] - pose(BEGIN)[0]
    back = pose(max(theta, turn))[0] - pose(turn)[0]
    left = inertia(BEGIN) * OMEGA**2 - 2 * DRY * (abs(there) + abs(back))
    return math.sqrt(left / inertia(theta))


def until(theta: float, turn: float) -> float:
    """∫ dθ/θ̇ [s]."""
    taken = partial(quad, lambda at: 1 / speed(at, turn), epsabs=1e-11, epsrel=1e-11)
    return sum(taken(a, b)[0] for a, b in ((BEGIN, min(theta, turn)), (turn, max(theta, turn))))


@pytest.mark.slow
def test_a_rocker_turns_back_and_its_crank_goes_on(tmp_path: Path) -> None:
    found = solve(scenes.typed(tmp_path, FOUR_BAR, tail=END))
    assert found.holds
    turn = brentq(lambda theta: slope(theta, 0).real, 3.6, 4.4)
    assert found.trajectory.switches.tolist() == pytest.approx([until(turn, turn)], abs=1e-10)
    end = float(found.trajectory.states["crank"][-1, 2])
    assert until(end, turn) == pytest.approx(0.4, abs=1e-10)
    friction = found.trajectory.reactions["D.friction"]
    assert set(np.round(friction, 14)) == {-DRY, DRY}


@pytest.mark.slow
@pytest.mark.parametrize("slow", [1.0, 0.1, 0.01])
def test_however_slowly_it_passes(
    slow: float, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Begun so fast that friction leaves the crank so many rad/s at the rocker's dead centre.

    Its time is known the worse the slower it passes: ours by 1e-12 of the energy that is spent.
    """
    turn = brentq(lambda theta: slope(theta, 0).real, 3.6, 4.4)
    spent = 2 * DRY * abs(pose(turn)[0] - pose(BEGIN)[0])
    begun = math.sqrt((inertia(turn) * slow**2 + spent) / inertia(BEGIN))
    monkeypatch.setitem(globals(), "OMEGA", begun)
    passes = until(turn, turn)
    text = FOUR_BAR.replace("omega: 10.0", f"omega: {begun!r}")
    found = solve(scenes.typed(tmp_path, text, tail=scenes.tail(round(passes + 0.05, 4), 26)))
    assert found.holds
    assert found.trajectory.switches.tolist() == pytest.approx([passes], abs=1e-12 / slow**2)
    assert found.trajectory.states["crank"][-1, 2] > turn


@pytest.mark.slow
def test_what_a_stop_holds_too_rests_and_leaves_open_who_holds_it(tmp_path: Path) -> None:
    """Of m g cos 30° l/2 the dry pin has 0.5 N m, or as much against it."""
    rests = f"{ON_A_STOP}rests: true\n"
    assert solve(scenes.typed(tmp_path, rests, tail=END)).holds
    asked = rests.replace("1.0e-2}", "1.0e-2, ends.torque: 1.0e-2}")
    mistake = refused(scenes.typed(tmp_path, asked, tail=END))
    m = 9.80665 * math.cos(math.radians(30)) * 0.2
    assert f"ends.torque: anything from {m - 0.5:.4g} to {m + 0.5:.4g} N m" in mistake.what


@pytest.mark.mutant("a joint that sticks where the others turn it")
def test_a_rocker_that_sticks_at_its_dead_centre_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Modes, "contradicts", lambda *_: False)
    mistake = refused(scenes.typed(tmp_path, FOUR_BAR, tail=END))
    assert mistake.where == "duration"  # it is held where the others move it
