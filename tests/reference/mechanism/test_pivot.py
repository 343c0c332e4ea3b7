"""What pivots on the floor, from the scene alone: spokes, feet, rods."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.scenes import SHIPPED, parsed, tail

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.reference.mechanism.modes import element
from textmech.reference.mechanism.modes import impact_transition as landing
from textmech.reference.mechanism.modes.blow import Blow
from textmech.reference.mechanism.modes.mechanism import BadStart
from textmech.reference.mechanism.modes.mode_selection import Undetermined
from textmech.reference.motion.follow import follow
from textmech.reference.solve import solve
from textmech.reference.system import Array
from textmech.reference.systems.walkers.rimless_wheel import SpokeSteps

L, M, J, GAMMA = 0.3, 2.0, 0.09, 0.1
WHEEL = """\
scene:
  incline: 0.1
  bodies: {{wheel: {{spokes: {{number: 8, length: 0.3, mass: 2, inertia: 0.09}}}}}}
  contacts: {{feet: {{between: [wheel, ground.floor], friction: {mu}, ideal: pivot}}}}
initial: {{wheel: {{x: 0, angle: 0, on: tip1, omega: -{w0}{more}}}}}
events: {{strikes: {{feet.gap: falls to zero}}}}
allow: {{wheel.angle: 1.0e-3, strikes.time: 1.0e-3}}
"""
ROD = """\
scene:
  bodies: {{rod: {{bar: {{mass: 1.5, length: 0.8}}}}}}
  contacts: {{foot: {{between: [rod.start, ground.floor], friction: {mu}, ideal: pivot}}}}
initial: {{rod: {{x: 0, angle: 60 deg, on: start, omega: {w0}}}}}
allow: {{rod.angle: 1.0e-3, foot.normal: 0.1}}
"""
HANGING = """\
scene:
  points: {O: [0, 1.0]}
  bodies: {thigh: {bar: {mass: 1.1, length: 0.7}}, shank: {bar: {mass: 0.8, length: 0.6}}}
  joints: {hip: {pin: [ground.O, thigh.start]}, knee: {pin: [thigh.end, shank.start]}}
  contacts: {foot: {between: [shank.end, ground.floor], friction: MU, ideal: pivot}}
initial: {thigh: {angle: -20 deg, omega: -1.0}, shank: {angle: -120 deg, omega: 1.0}}
events: {strikes: {foot.gap: falls to zero}}
allow: {thigh.angle: 1.0e-3, strikes.time: 1.0e-3}
"""


def strikes(w0: float, until: float = 1.0) -> list[float]:
    case = parsed(WHEEL.format(mu=2.0, w0=w0, more=""))
    found = follow(scenes.mechanism(case), np.linspace(0.0, until, 3))
    return [change.time for change in found.changes]


@pytest.mark.slow
def test_strikes_are_those_of_the_energy() -> None:
    known = SpokeSteps(8, L, J / (M * L**2), GAMMA).strikes(3.3, 1.0)
    assert strikes(3.3) == pytest.approx(known, abs=1e-12)


@pytest.mark.mutant("an impact of spokes in which the old tip stays")
def test_an_impact_in_which_the_old_tip_stays_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Without a tip that lets go, the wheel stands on two after the first strike."""
    sound = landing.impact
    monkeypatch.setattr(
        landing,
        "impact",
        lambda mass, joints, met, v: (
            Blow(0.0 * sound(mass, joints, met, v)[0].v),
            ("sticks",) * len(met),
        ),
    )
    assert len(strikes(3.3)) == 1


@pytest.mark.slow
@pytest.mark.mutant("half of J in the impact of spokes")
def test_another_inertia_in_the_impact_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Half of J keeps another part of the speed."""
    known = SpokeSteps(8, L, J / (M * L**2), GAMMA).strikes(3.3, 1.0)
    assert known is not None
    sound, halved = landing.impact, np.array([1.0, 1.0, 0.5])
    monkeypatch.setattr(
        landing, "impact", lambda mass, joints, met, v: sound(halved * mass, joints, met, v)
    )
    assert abs(np.array(strikes(3.3)) - known).max() > 1e-4


@pytest.mark.slow
def test_a_rod_that_pivots_on_its_end() -> None:
    """½ (m l²/3) ω² + m g (l/2) sin φ stays what it was; F_N by (2.23)."""
    case = parsed(ROD.format(mu=9.0, w0=-0.4), tail=tail(0.3, 16))
    motion = solve(case).trajectory
    s = motion.states["rod"]
    angle, omega, half, g = s[:, 2], s[:, 5], 0.4, 9.80665
    energy = omega**2 * half * 4 / 3 / 2 + g * np.sin(angle)
    assert energy == pytest.approx(energy[0], rel=1e-12)
    turning = -0.75 * g / half * np.cos(angle)
    normal = 1.5 * (g + half * (turning * np.cos(angle) - omega**2 * np.sin(angle)))
    assert observe(case.scene, motion, "foot.normal") == pytest.approx(normal, rel=1e-11)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("scene", "words"),
    [
        (WHEEL.format(mu=0.2, w0=3.3, more=""), "the impact at t = 0.2455 s would slip: "),
        (WHEEL.format(mu=2.0, w0=9, more=""), "the floor would have to pull at t = 0 s: wheel"),
        (WHEEL.format(mu=2.0, w0=3.3, more=", vx: 1.5"), "`on` says that wheel.tip1 does not move"),
        (ROD.format(mu=0.2, w0=0.1), "pivoting is not possible with friction 0.2: at t = 0 s"),
        (ROD.format(mu=0, w0=0.1), "pivoting is not possible with friction 0: at t = 0 s"),
        (ROD.format(mu=0.5, w0=-0.1).replace("on: start", "y: 9"), "rod leaves it"),
        (
            ROD.format(mu=0.5, w0=0).replace("on: start", "y: 0.34641016151377546, vx: 1"),
            "starts with a slip of",
        ),
    ],
)
def test_what_cannot_pivot_is_said(scene: str, words: str) -> None:
    assert words in refused(parsed(scene)).what


@pytest.mark.slow
def test_friction_that_an_impact_needs_is_enough() -> None:
    """The number in the message, rounded up, and not 1 % less."""
    mistake = refused(parsed(WHEEL.format(mu=0.2, w0=3.3, more="")))
    needed = float(mistake.what.partition("it needs friction ")[2].split()[0])
    mechanism = scenes.mechanism(parsed(WHEEL.format(mu=1.01 * needed, w0=3.3, more="")))
    assert len(follow(mechanism, np.linspace(0.0, 0.3, 3)).changes) == 1
    with pytest.raises(CaseError, match="the impact"):
        solve(parsed(WHEEL.format(mu=0.99 * needed, w0=3.3, more="")))


def needed_where_it_hangs(q: Array, v: Array) -> float:
    """|T|/N of the blow that stops thigh and shank: the hip holds too, and has no moment.

    About the hip foot and momenta balance for both bodies, about the knee for the shank alone:
    x N − y T = −L, with the foot's x, y and the angular momentum L from there.
    """
    lengths, masses = (0.7, 0.6), (1.1, 0.8)
    place, rate = q.reshape(2, 3), v.reshape(2, 3)
    half = [
        l / 2 * np.array([math.cos(p[2]), math.sin(p[2])])
        for l, p in zip(lengths, place, strict=True)
    ]
    knee, foot = place[1, :2] - half[1], place[1, :2] + half[1]
    rows, right = [], []
    for pivot, bodies in ((np.array([0.0, 1.0]), (0, 1)), (knee, (1,))):
        x, y = foot - pivot
        rows.append([-y, x])
        momenta = [
            masses[k] * (np.linalg.det([place[k, :2] - pivot, rate[k, :2]]))
            + masses[k] * lengths[k] ** 2 / 12 * rate[k, 2]
            for k in bodies
        ]
        right.append(-sum(momenta))
    T, N = np.linalg.solve(rows, right)
    return float(abs(T) / N)


def hanging(mu: float) -> Case:
    return parsed(HANGING.replace("MU", str(mu)), tail=tail(0.4, 5))


def test_a_second_joint_to_the_ground_takes_its_share_of_a_blow() -> None:
    (strikes,) = follow(scenes.mechanism(hanging(9.0)), np.linspace(0.0, 0.4, 3)).events
    needed = needed_where_it_hangs(*np.split(strikes.before, 2))
    mistake = refused(hanging(0.01))
    assert mistake.what.partition("needs friction ")[2].split()[0] == f"{needed:.3g}"


@pytest.mark.mutant("the friction that a blow needs, of all that changes the momentum")
def test_a_share_of_the_joints_counted_as_friction_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    sound = landing.impact

    def of_all(M: Array, joints: Any, met: Any, v: Array) -> Any:
        taken, states = sound(M, joints, met, v)
        impulse = (M * (taken.v - v)).reshape(2, 3).sum(axis=0)
        return replace(taken, grip=abs(impulse[0] / impulse[1])), states

    monkeypatch.setattr(landing, "impact", of_all)
    with pytest.raises(AssertionError):
        test_a_second_joint_to_the_ground_takes_its_share_of_a_blow()


@pytest.mark.mutant("friction cone of a pivot left out")
def test_margins_of_a_pivot_are_asked_of_its_samples(monkeypatch: pytest.MonkeyPatch) -> None:
    """A friction cone that is lost lets a rod stand that would slip."""
    scene = ROD.format(mu=0.2, w0=0.1)
    case = parsed(scene)
    mechanism = scenes.mechanism(case)
    mode, q, v = mechanism.start()
    assert mechanism.possible(mode, 0.0, q, v) == "foot would have to slip"
    monkeypatch.setattr(element.Touching, "margins", lambda self, forces: (1.0, 1.0))
    assert mechanism.possible(mode, 0.0, q, v) is None


CASE = SHIPPED["compass_walker"]


@pytest.mark.mutant("a swinging foot that strikes midway")
def test_a_foot_that_does_not_pass_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """Midway it would strike the floor, with the standing one beside it."""
    monkeypatch.setattr(element.Element, "behind", lambda self, t, q, size: 0.0)
    try:
        changes = follow(scenes.mechanism(CASE), CASE.times).changes
    except (Undetermined, BadStart):
        return
    assert [round(change.time, 2) for change in changes] != [0.89, 1.79]


@pytest.mark.slow
def test_both_feet_in_the_air_are_no_walk() -> None:
    """The standing leg so fast that it leaves the floor at once."""
    left = CASE.initial["left"]
    fast = replace(left, given={**left.given, "omega": -6.0})
    flying = replace(CASE, system=None, initial={**CASE.initial, "left": fast}, duration=0.02)
    with pytest.raises(CaseError, match="the floor would have to pull at t = 0 s: left leaves it"):
        solve(flying)


@pytest.mark.slow
def test_a_walker_slips_where_friction_is_little() -> None:
    contacts = CASE.scene.contacts.items()
    feet = {name: replace(foot, static=0.01, kinetic=0.01) for name, foot in contacts}
    with pytest.raises(CaseError, match="would slip"):
        solve(replace(CASE, system=None, scene=replace(CASE.scene, contacts=feet)))


TOP = """\
scene:
  space: 3
  bodies:
    top:
      rigid: {mass: 0.5, inertia: [3.5e-4, 3.5e-4, 6e-4, 0, 0, 0]}
      points: {tip: [0, 0, -0.05]}
  contacts:
    touch: {between: [top.tip, ground.floor], friction: %s, ideal: pivot}
initial: {top: {tip: [0, 0, 0], attitude: {axis: [1, 0, 0], angle: 25 deg}, omega: %s}}
allow: {top.attitude: 1.0e-2, touch.normal: 1.0}
"""


@pytest.mark.parametrize(
    ("friction", "omega", "said"),
    [
        (0.05, "[0, 0.9, 150]", "pivoting is not possible with friction 0.05: at t = "),
        (9.0, "[20, 0, 150]", "the floor would have to pull at t = 0 s: top leaves it"),
    ],
)
def test_what_the_floor_cannot_hold_in_space(friction: float, omega: str, said: str) -> None:
    case = parsed(TOP % (friction, omega), tail=tail(0.1, 3))  # type: ignore[arg-type]
    mistake = refused(case)
    assert mistake.where == "scene.contacts.touch.ideal"
    assert mistake.what.startswith(said)
