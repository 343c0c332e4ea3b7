"""A dry joint that turns back at a dead centre: it cannot stick where the others turn it."""

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
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
SLIDER = f"""\
scene:
  gravity: none
  points: {{O: [0, 0]}}
  bodies:
    crank: {{bar: {{mass: 1.0, length: {A}}}}}
    rod: {{bar: {{mass: 0.5, length: {B}}}}}
    piston: {{rigid: {{mass: 0.7, inertia: 0.01}}}}
  joints:
    A: {{pin: [ground.O, crank.start]}}
    B: {{pin: [crank.end, rod.start]}}
    C: {{pin: [rod.end, piston.center]}}
    D: {{slide: [ground.O, piston.center], along: [1, 0], dry_friction: {{kinetic: 1.0}}}}
initial: {{crank: {{angle: 130 deg, omega: {OMEGA}}}}}
near: {{rod: {{angle: -10 deg}}}}
allow: {{crank.angle: 2.0e-2, piston.x: 2.0e-2}}
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


def four_bar(theta: float) -> tuple[float, complex, float]:
    """The rocker's angle, where the coupler's centre is, and its angle."""
    end = A * cmath.exp(1j * theta)
    r = abs(end - D)
    rocker = math.pi + cmath.phase(D - end) - math.acos((C * C + r * r - B * B) / (2 * C * r))
    joint = D + C * cmath.exp(1j * rocker)
    return rocker, (end + joint) / 2, cmath.phase(joint - end)


def slider(theta: float) -> tuple[float, complex, float]:
    """The piston's place, where the rod's centre is, and its angle."""
    end = A * cmath.exp(1j * theta)
    joint = end.real + math.sqrt(B * B - end.imag**2)
    return joint, (end + joint) / 2, cmath.phase(joint - end)


@dataclass(frozen=True)
class Linkage:
    """A crank, a bar, and what rubs: how both follow the crank, and what 2 T is over its rate²."""

    text: str
    pose: Callable[[float], tuple[float, complex, float]]
    last: float  # kg m² or kg
    friction: float  # N m or N
    begin: float  # rad
    dead: tuple[float, float]  # rad: it turns back between

    def slope(self, theta: float, i: int) -> complex:
        """By θ, a difference of fourth order."""
        h = 1e-3
        one, two = (self.pose(theta + k * h)[i] - self.pose(theta - k * h)[i] for k in (1, 2))
        return (8 * one - two) / (12 * h)

    @property
    def turn(self) -> float:
        """Where the crank is when it turns back."""
        return brentq(lambda theta: self.slope(theta, 0).real, *self.dead)

    def inertia(self, theta: float) -> float:
        """2 T/θ̇² of all three."""
        last, centre, turns = (abs(self.slope(theta, i)) for i in range(3))
        return 1.0 * A**2 / 3 + self.last * last**2 + 0.5 * centre**2 + 0.5 * B**2 / 12 * turns**2

    def spent(self, theta: float, turn: float) -> float:
        """2 times the work of friction, on the way to and fro."""
        there = self.pose(min(theta, turn))[0] - self.pose(self.begin)[0]
        back = self.pose(max(theta, turn))[0] - self.pose(turn)[0]
        return 2 * self.friction * (abs(there) + abs(back))

    def until(self, theta: float, begun: float) -> float:
        """∫ dθ/θ̇ [s], with the crank's rate by its energy."""
        turn, energy = self.turn, self.inertia(self.begin) * begun**2

        def pace(at: float) -> float:
            return math.sqrt(self.inertia(at) / (energy - self.spent(at, turn)))

        taken = partial(quad, pace, epsabs=1e-11, epsrel=1e-11)
        parts = ((self.begin, min(theta, turn)), (turn, max(theta, turn)))
        return sum(taken(a, b)[0] for a, b in parts)


LINKAGES = {
    "rocker": Linkage(FOUR_BAR, four_bar, 0.5 * C**2 / 3, DRY, math.radians(60), (3.6, 4.4)),
    "piston": Linkage(SLIDER, slider, 0.7, 1.0, math.radians(130), (3.0, 3.3)),
}


@pytest.mark.slow
def test_a_rocker_turns_back_and_its_crank_goes_on(tmp_path: Path) -> None:
    found, known = solve(scenes.typed(tmp_path, FOUR_BAR, tail=END)), LINKAGES["rocker"]
    assert found.holds
    passes = known.until(known.turn, OMEGA)
    assert found.trajectory.switches.tolist() == pytest.approx([passes], abs=1e-10)
    end = float(found.trajectory.states["crank"][-1, 2])
    assert known.until(end, OMEGA) == pytest.approx(0.4, abs=1e-10)
    friction = found.trajectory.reactions["D.friction"]
    assert set(np.round(friction, 14)) == {-DRY, DRY}


@pytest.mark.slow
@pytest.mark.parametrize("slow", [1.0, 0.1, 0.01])
@pytest.mark.parametrize("name", LINKAGES)
def test_however_slowly_it_passes(name: str, slow: float, tmp_path: Path) -> None:
    """Begun so fast that friction leaves the crank so many rad/s where what rubs turns back.

    Its time is known the worse the slower it passes: ours by 1e-12 of the energy that is spent.
    """
    known = LINKAGES[name]
    turn = known.turn
    left = known.inertia(turn) * slow**2 + known.spent(turn, turn)
    begun = math.sqrt(left / known.inertia(known.begin))
    passes = known.until(turn, begun)
    end = round(passes + 0.05, 4)
    text = known.text.replace(f"omega: {OMEGA}", f"omega: {begun!r}")
    found = solve(scenes.typed(tmp_path, text, tail=scenes.tail(end, 26)))
    assert found.holds
    assert found.trajectory.switches.tolist() == pytest.approx([passes], abs=1e-12 / slow**2)
    last = float(found.trajectory.states["crank"][-1, 2])
    assert last > turn
    assert known.until(last, begun) == pytest.approx(end, abs=1e-10 + 1e-12 / slow**2)


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
