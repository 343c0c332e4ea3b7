"""Turns of joints in space: the start has them as it says, and the march counts them.

Known by closed forms, and by the same scene in the plane, where a state holds its turns.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given.laws.certified import broken
from given.scenes import parsed, scene
from scipy.spatial.transform import Rotation

from textmech.cases.case import Case
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Scene
from textmech.cases.scene.joint import Joint
from textmech.cases.scene.motion import Motion
from textmech.cases.scene.observe import observe
from textmech.reference.motion import bodies
from textmech.reference.motion.bodies import Counted
from textmech.reference.motion.follow import Followed
from textmech.reference.solve import Solution, solve
from textmech.reference.system import System
from textmech.reports.compare.events.times import reference_events

Patch = pytest.MonkeyPatch
J = 0.5  # kg m²
PLANE = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: 0.5}}}
  joints: {q: {pin: [ground.O, b.center]}}
"""


def turned(
    duration: float, samples: int, start: float = 0, omega: float = 0, more: str = ""
) -> Case:
    """A body on a hinge, which starts at that angle [deg]."""
    text = f"duration: {duration}\nsamples: {samples}\n{more}"
    return scene("hinged_in_space", text, angle=f"{start} deg", omega=omega)


def held(case: Case) -> Solution:
    found = solve(case)
    assert broken(found) == set()
    assert "turns by their rates" in [check.name for check in found.checks]
    return found


WOUND = """\
  forces:
    w: {torsion: q, stiffness: 2.0, rest_angle: 0.3}
    M: {motor: q, sine: {amplitude: 100, angular_frequency: 10, phase: 90 deg}}
"""
ENERGY = "allow: {q.angle: 1, q.omega: 1, w.torque: 1, energy.total: 1}\n"


@pytest.mark.slow
@pytest.mark.parametrize(("start", "samples"), [(0, 7), (-500, 61)])
def test_a_spring_counts_its_turns_as_in_the_plane(start: int, samples: int) -> None:
    """It winds past half a turn between two samples, or starts beyond it."""
    case = turned(1.8, samples, start, more=f"scene:\n{WOUND}{ENERGY}")
    begin = f"initial: {{b: {{angle: {start} deg, omega: 0}}}}\n"
    end = f"duration: 1.8\nsamples: {samples}\nstep: 1.0e-4\n"
    planar = parsed(f"{PLANE}{WOUND}{begin}{ENERGY}", tail=end)
    found, known = held(case).trajectory, solve(planar).trajectory
    assert known.near == {}  # nothing is counted in the plane
    for name in case.allow:
        expected = observe(planar.scene, known, name)
        np.testing.assert_allclose(observe(case.scene, found, name), expected, atol=3e-10)
    assert np.max(np.abs(observe(case.scene, found, "q.angle"))) > math.pi


MOTOR = "scene: {{forces: {{M: {{motor: {}, polynomial: {{coefficients: [1]}}}}}}}}\n"


@pytest.mark.parametrize("start", [200, -180, pytest.param(800, marks=pytest.mark.slow)])
@pytest.mark.parametrize("named", [False, pytest.param(True, marks=pytest.mark.slow)])
def test_a_start_is_what_it_says(start: int, named: bool) -> None:
    """(2.44) J φ̈ = M: φ = φ₀ + ω₀ t + M t²/2J, by a hinge or a named freedom."""
    more = MOTOR.format("q.angle" if named else "q")
    freedom = "freedoms: {angle: {hinge: [0, 0, 1]}}, of: [ground.O, b.center]"
    if named:
        joint = f"joints: {{q: {{hinge: null, axis: null, {freedom}}}}}"
        more = more.replace("scene: {", f"scene: {{{joint}, ")
    case = turned(3.0, 4, start, 1, more)
    t = case.times
    angle = observe(case.scene, held(case).trajectory, "q.angle")
    np.testing.assert_allclose(angle, math.radians(start) + t + t**2, atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("start", [-200, -800, 200])
def test_an_event_on_an_angle_is_where_the_angle_is(start: int) -> None:
    """It rises to zero where φ₀ + t + t² = 0, and never where it starts above."""
    more = MOTOR.format("q") + "events: {up: {q.angle: rises to zero}}\n"
    case = turned(4.0, 5, start, 1, more)
    record = held(case).trajectory.record
    assert record is not None
    times = reference_events(case.scene, record, case.events["up"]).tolist()
    phi = math.radians(start)
    known = [(-1 + math.sqrt(1 - 4 * phi)) / 2] if phi < 0 else []
    assert times == pytest.approx(known, abs=1e-12)


def swung(samples: int) -> Case:
    sine = "sine: {amplitude: 100, angular_frequency: 6.283185307179586}"
    return turned(3.0, samples, more=f"scene: {{forces: {{M: {{motor: q, {sine}}}}}}}\n")


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 31])
def test_coarse_samples_lose_no_turn(samples: int) -> None:
    """(2.44) J φ̈ = A sin wt: φ = (A/Jw) (t − sin(wt)/w), whose rate is zero at whole seconds."""
    case = swung(samples)
    t, w = case.times, math.tau
    expected = 100 / (J * w) * (t - np.sin(w * t) / w)
    assert expected[-1] == pytest.approx(95.493, abs=1e-3)
    angle = observe(case.scene, held(case).trajectory, "q.angle")
    np.testing.assert_allclose(angle, expected, atol=1e-10)


def thrice(be: float, rates: str, samples: int) -> Case:
    """The body by three turns, of which the middle one starts at that angle [deg]."""
    turns = "al: {hinge: [0, 0, 1]}, be: {hinge: [0, 1, 0]}, ga: {hinge: [1, 0, 0]}"
    text = f"""\
scene:
  joints: {{q: null, f: {{freedoms: {{{turns}}}, of: [ground.O, b.center]}}}}
initial: {{q: null, f: {{al: 0.2, be: {be} deg, ga: -0.1, be_dot: 1.2{rates}}}}}
allow: {{q.angle: null, f.be: 1, f.al: 1}}
samples: {samples}
"""
    return scene("hinged_in_space", text, angle=None, omega=None)


@pytest.mark.slow
@pytest.mark.parametrize(("start", "samples"), [(60, 3), (-100, 11), (300, 3)])
def test_the_middle_one_of_three_turns_goes_on(start: int, samples: int) -> None:
    """Only it moves, evenly, also through gimbal lock at 90 deg."""
    case = replace(thrice(start, "", samples), stays=("f.al",))
    found = held(case).trajectory
    be = math.radians(start) + 1.2 * case.times
    np.testing.assert_allclose(observe(case.scene, found, "f.be"), be, atol=1e-7)
    np.testing.assert_allclose(observe(case.scene, found, "f.al"), 0.2, atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize(("aside", "told"), [(0.1, True), (1e-6, False)])
def test_what_passes_by_gimbal_lock_jumps_or_is_not_told(aside: float, told: bool) -> None:
    """ω stays in space, at an angle of about `aside` to the middle axis: be turns back there."""
    case = thrice(60, f", ga_dot: {aside}", 11)
    found = solve(case)
    assert found.holds == told
    if told:
        assert np.max(observe(case.scene, found.trajectory, "f.be")) < math.pi / 2
        assert np.ptp(observe(case.scene, found.trajectory, "f.al")) == pytest.approx(3.06, abs=0.1)


@pytest.mark.slow
@pytest.mark.mutant("whole turns of a joint in space: {name}")
@pytest.mark.parametrize("name", ["one lost on the way", "guessed at the samples"])
def test_a_lost_turn_is_seen(name: str, monkeypatch: Patch) -> None:
    """By the integral of the rate."""
    case = swung(4)
    counted, sound = bodies.counted, Joint.turned

    def lost(self: Joint, motion: Motion) -> object:
        found = sound(self, motion)
        found.angles[len(found.angles) // 2 :] -= math.tau
        return found

    def guessed(scene: Scene, system: System, followed: Followed) -> Counted:
        rows = zip(case.times.tolist(), followed.phase.tolist(), followed.y, strict=True)
        return counted(scene, system, replace(followed, march=tuple(rows)))

    if name == "one lost on the way":
        monkeypatch.setattr(Joint, "turned", lost)
    else:
        monkeypatch.setattr(bodies, "ROUNDS", 1)
        monkeypatch.setattr(bodies, "counted", guessed)
    assert "turns by their rates" in broken(solve(case))


def spun(axes: Sequence[Any], turns: Sequence[float], w: Sequence[float], n: int) -> Case:
    """A sphere that goes on as it spins, and whose attitude three turns tell."""
    (p, q, r), (first, second, third) = turns, map(list, axes)
    text = f"""\
scene:
  space: 3
  gravity: none
  points: {{O: [0, 0, 0]}}
  bodies: {{b: {{sphere: {{mass: 1.5, radius: 0.3}}}}}}
  joints:
    j: {{freedoms: {{p: {{hinge: {first}}}, q: {{hinge: {second}}}, r: {{hinge: {third}}}}},
        of: [ground.O, b.center]}}
initial: {{j: {{p: {p!r}, q: {q!r}, r: {r!r}}}, b: {{omega: {[*w]}}}}}
duration: 2.4
samples: {n}
allow: {{j.p: 1.0, j.q: 1.0}}
"""
    return parsed(text, tail="")


@pytest.mark.slow
@pytest.mark.mutant("gimbal lock passed beside it where a step falls on the nearest point")
@pytest.mark.parametrize(("beside", "samples"), [(1e-6, 4), (1e-6, 7), (1e-7, 13)])
def test_who_passes_gimbal_lock_beside_it_is_not_certified(beside: float, samples: int) -> None:
    """At 1.2 s, which is a sample of some, the middle turn is as near as that and turns back.

    There the first and the last jump by half a turn; who goes on straight is off by one.
    """
    there = Rotation.from_euler("ZYX", [0.4, math.pi / 2 - beside, -0.3])
    # ω in body axes, of which the part about the middle axis, [0, cos r, −sin r], is 0
    w = np.array([0.9, math.sin(-0.3), math.cos(-0.3)])
    start = there * Rotation.from_rotvec(-1.2 * w)
    turns = start.as_euler("ZYX").tolist()
    assert not solve(spun(np.eye(3)[::-1].tolist(), turns, w.tolist(), samples)).holds


@pytest.mark.slow
def test_who_leaves_what_skew_turns_can_make_is_refused() -> None:
    axes = [[1.9, 0.48, -1.58], [1.73, 0.35, -0.94], [0.91, 0.02, -0.62]]
    case = spun(axes, (-0.475, 1.284, 1.169), (-0.12, -0.27, 1.0), 9)
    with pytest.raises(CaseError, match=r"'p', 'q', 'r' cannot make the attitude at t = 0\.6"):
        solve(case)
