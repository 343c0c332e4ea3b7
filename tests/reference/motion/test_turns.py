"""Turns of joints in space: the start has them as it says, and the march counts them.

Known by closed forms, and by the same scene in the plane, where a state holds its turns.
"""

import math
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
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

J = 0.5  # kg m²
SPACE = """\
title: A body on a hinge in space
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: [0.5, 0.5, 0.5, 0, 0, 0]}}}
"""
HINGE = "  joints: {q: {hinge: [ground.O, b.center], axis: [0, 0, 1]}}\n"
NAMED = "  joints: {q: {freedoms: {angle: {hinge: [0, 0, 1]}}, of: [ground.O, b.center]}}\n"
PLANE = """\
title: The same in the plane
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {rigid: {mass: 1, inertia: 0.5}}}
  joints: {q: {pin: [ground.O, b.center]}}
"""
STARTS = [200, 190, 350, 400, 800, -200, 180, -180]  # deg


def typed(tmp_path: Path, text: str, duration: float, samples: int, allow: str) -> Case:
    tail = f"duration: {duration}\nsamples: {samples}\nstep: 1.0e-4\nallow: {{{allow}}}\n"
    path = tmp_path / "case.yaml"
    path.write_text(text + tail)
    (case,) = scenes.load(path)
    return case


def held(case: Case) -> Solution:
    found = solve(case)
    assert [check for check in found.checks if not check.holds] == []
    assert "turns by their rates" in [check.name for check in found.checks]
    return found


def angle(case: Case, quantity: str = "q.angle") -> np.ndarray:
    return observe(case.scene, held(case).trajectory, quantity)


WOUND = """\
  forces:
    w: {torsion: q, stiffness: 2.0, rest_angle: 0.3}
    M: {motor: q, sine: {amplitude: 100, angular_frequency: 10, phase: 90 deg}}
initial: {PART: {angle: 0, omega: 0}}
"""


@pytest.mark.slow
@pytest.mark.parametrize("samples", [7, 61])
@pytest.mark.parametrize("start", [0, 200, -500])
def test_a_spring_counts_its_turns_as_in_the_plane(
    start: int, samples: int, tmp_path: Path
) -> None:
    """It winds past half a turn between two samples, or starts beyond it."""
    wound = WOUND.replace("angle: 0,", f"angle: {start} deg,")
    allow = "q.angle: 1, q.omega: 1, w.torque: 1, energy.total: 1"
    case = typed(tmp_path, SPACE + HINGE + wound.replace("PART", "q"), 1.8, samples, allow)
    planar = typed(tmp_path, PLANE + wound.replace("PART", "b"), 1.8, samples, allow)
    found, known = held(case).trajectory, solve(planar).trajectory
    for name in case.allow:
        expected = observe(planar.scene, known, name)
        np.testing.assert_allclose(observe(case.scene, found, name), expected, atol=3e-10)
    assert np.max(np.abs(observe(case.scene, found, "q.angle"))) > math.pi


@pytest.mark.parametrize(("joint", "about"), [(HINGE, "q"), (NAMED, "q.angle")])
@pytest.mark.parametrize(
    "start", [200, -180, *(pytest.param(s, marks=pytest.mark.slow) for s in STARTS[1:-1])]
)
def test_a_start_is_what_it_says(start: int, joint: str, about: str, tmp_path: Path) -> None:
    """(2.44) J φ̈ = M: φ = φ₀ + ω₀ t + M t²/2J."""
    rest = f"""\
  forces: {{M: {{motor: {about}, polynomial: {{coefficients: [1]}}}}}}
initial: {{q: {{angle: {start} deg, omega: 1}}}}
"""
    case = typed(tmp_path, SPACE + joint + rest, 3.0, 4, "q.angle: 1")
    t = case.times
    np.testing.assert_allclose(angle(case), math.radians(start) + t + t**2, atol=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("start", [-200, -100, -800])
def test_an_event_on_an_angle_is_where_the_angle_is(start: int, tmp_path: Path) -> None:
    """It rises to zero where φ₀ + t + t² = 0, and never where it starts above."""
    rest = f"""\
  forces: {{M: {{motor: q, polynomial: {{coefficients: [1]}}}}}}
initial: {{q: {{angle: {start} deg, omega: 1}}}}
events: {{up: {{q.angle: rises to zero}}}}
"""
    case = typed(tmp_path, SPACE + HINGE + rest, 4.0, 5, "q.angle: 1, up.time: 0.1")
    record = held(case).trajectory.record
    assert record is not None
    times = reference_events(case.scene, record, case.events["up"])
    phi = math.radians(start)
    assert times == pytest.approx([(-1 + math.sqrt(1 - 4 * phi)) / 2], abs=1e-12)
    above = typed(
        tmp_path, SPACE + HINGE + rest.replace(f"{start} deg", "200 deg"), 4.0, 5, "q.angle: 1"
    )
    record = held(above).trajectory.record
    assert record is not None
    assert len(reference_events(above.scene, record, above.events["up"])) == 0


SWING = """\
  forces: {M: {motor: q, sine: {amplitude: 100, angular_frequency: 6.283185307179586}}}
initial: {q: {angle: 0, omega: 0}}
"""


@pytest.mark.slow
@pytest.mark.parametrize("samples", [4, 6, 31])
def test_coarse_samples_lose_no_turn(samples: int, tmp_path: Path) -> None:
    """(2.44) J φ̈ = A sin wt: φ = (A/Jw) (t − sin(wt)/w), whose rate is zero at whole seconds."""
    case = typed(tmp_path, SPACE + HINGE + SWING, 3.0, samples, "q.angle: 1")
    t, w = case.times, math.tau
    expected = 100 / (J * w) * (t - np.sin(w * t) / w)
    assert expected[-1] == pytest.approx(95.493, abs=1e-3)
    np.testing.assert_allclose(angle(case), expected, atol=1e-10)


THREE = (
    "  joints: {f: {freedoms: {al: {hinge: [0, 0, 1]}, be: {hinge: [0, 1, 0]}, "
    "ga: {hinge: [1, 0, 0]}}, of: [ground.O, b.center]}}\n"
)


@pytest.mark.slow
@pytest.mark.parametrize("start", [60, 120, -100, 300])
@pytest.mark.parametrize("samples", [3, 11])
def test_the_middle_one_of_three_turns_goes_on(start: int, samples: int, tmp_path: Path) -> None:
    """Only it moves, evenly, also through gimbal lock at 90 deg."""
    rest = f"initial: {{f: {{al: 0.2, be: {start} deg, ga: -0.1, be_dot: 1.2}}}}\nstays: [f.al]\n"
    case = typed(tmp_path, SPACE + THREE + rest, 1.0, samples, "f.be: 1, f.al: 1")
    found = held(case).trajectory
    be = math.radians(start) + 1.2 * case.times
    np.testing.assert_allclose(observe(case.scene, found, "f.be"), be, atol=1e-7)
    np.testing.assert_allclose(observe(case.scene, found, "f.al"), 0.2, atol=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize(("aside", "told"), [(0.1, True), (1e-6, False)])
def test_what_passes_by_gimbal_lock_jumps_or_is_not_told(
    aside: float, told: bool, tmp_path: Path
) -> None:
    """ω stays in space, at an angle of about `aside` to the middle axis: be turns back there."""
    rest = f"initial: {{f: {{al: 0, be: 60 deg, ga: 0, be_dot: 1.2, ga_dot: {aside}}}}}\n"
    case = typed(tmp_path, SPACE + THREE + rest, 1.0, 11, "f.be: 1, f.al: 1")
    found = solve(case)
    assert found.holds == told
    if told:
        be = observe(case.scene, found.trajectory, "f.be")
        assert np.max(be) < math.pi / 2
        assert np.ptp(observe(case.scene, found.trajectory, "f.al")) == pytest.approx(3.06, abs=0.1)


@pytest.mark.slow
@pytest.mark.mutant("whole turns of a joint in space: {name}")
@pytest.mark.parametrize("name", ["one lost on the way", "guessed at the samples"])
def test_a_lost_turn_is_seen(name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """By the integral of the rate."""
    case = typed(tmp_path, SPACE + HINGE + SWING, 3.0, 4, "q.angle: 1")
    if name == "one lost on the way":
        turned = Joint.turned

        def lost(self: Joint, motion: Motion) -> object:
            found = turned(self, motion)
            found.angles[len(found.angles) // 2 :] -= math.tau
            return found

        monkeypatch.setattr(Joint, "turned", lost)
    else:
        counted = bodies.counted

        def guessed(scene: Scene, system: System, followed: Followed) -> Counted:
            rows = zip(case.times.tolist(), followed.phase.tolist(), followed.y, strict=True)
            return counted(scene, system, replace(followed, march=tuple(rows)))

        monkeypatch.setattr(bodies, "ROUNDS", 1)
        monkeypatch.setattr(bodies, "counted", guessed)
    failed = [check.name for check in solve(case).checks if not check.holds]
    assert "turns by their rates" in failed


@pytest.mark.slow
def test_nothing_is_counted_in_the_plane(tmp_path: Path) -> None:
    case = typed(tmp_path, PLANE + WOUND.replace("PART", "b"), 1.8, 7, "q.angle: 1")
    assert solve(case).trajectory.near == {}
    assert Counted().unrolled() == 0.0


PASSING = """\
scene:
  space: 3
  gravity: none
  points: {O: [0, 0, 0]}
  bodies: {b: {sphere: {mass: 1.5, radius: 0.3}}}
  joints:
    j: {freedoms: {p: {hinge: FIRST}, q: {hinge: SECOND}, r: {hinge: THIRD}},
        of: [ground.O, b.center]}
initial: {j: {p: PLACES}, b: {omega: RATES}}
duration: 2.4
samples: SAMPLES
allow: {j.p: 1.0, j.q: 1.0}
"""


def spun(
    folder: Path, axes: Sequence[Any], turns: Sequence[float], w: Sequence[float], n: int
) -> Case:
    """A sphere that goes on as it spins, and whose attitude three turns tell."""
    text = PASSING.replace("SAMPLES", str(n)).replace("RATES", str(list(w)))
    p, q, r = turns
    text = text.replace("PLACES", f"{p!r}, q: {q!r}, r: {r!r}")
    for word, axis in zip(("FIRST", "SECOND", "THIRD"), axes, strict=True):
        text = text.replace(word, str(list(axis)))
    return scenes.typed(folder, text, tail="")


@pytest.mark.slow
@pytest.mark.mutant("gimbal lock passed beside it where a step falls on the nearest point")
@pytest.mark.parametrize("samples", [4, 7, 13, 25])
@pytest.mark.parametrize("beside", [1e-6, 1e-7])
def test_who_passes_gimbal_lock_beside_it_is_not_certified(
    beside: float, samples: int, tmp_path: Path
) -> None:
    """At 1.2 s, which is a sample of some, the middle turn is as near as that and turns back.

    There the first and the last jump by half a turn; who goes on straight is off by one.
    """
    there = Rotation.from_euler("ZYX", [0.4, math.pi / 2 - beside, -0.3])
    # ω in body axes, of which the part about the middle axis, [0, cos r, −sin r], is 0
    w = np.array([0.9, math.sin(-0.3), math.cos(-0.3)])
    start = there * Rotation.from_rotvec(-1.2 * w)
    p, q, r = start.as_euler("ZYX").tolist()
    case = spun(tmp_path, np.eye(3)[::-1].tolist(), (p, q, r), w.tolist(), samples)
    assert not solve(case).holds


@pytest.mark.slow
@pytest.mark.parametrize("samples", [3, 9, 25])
def test_who_leaves_what_skew_turns_can_make_is_refused(samples: int, tmp_path: Path) -> None:
    axes = [[1.9, 0.48, -1.58], [1.73, 0.35, -0.94], [0.91, 0.02, -0.62]]
    case = spun(tmp_path, axes, (-0.475, 1.284, 1.169), (-0.12, -0.27, 1.0), samples)
    with pytest.raises(CaseError, match=r"'p', 'q', 'r' cannot make the attitude at t = 0\.6"):
        solve(case)
