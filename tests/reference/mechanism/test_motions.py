"""Scenes that switch: the generated answer against the written one and against closed forms."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given import scenes, written_scenes
from given.records import boundaries

from textmech.cases.case import Event
from textmech.reference.motion.follow import follow
from textmech.reference.solve import Solution, solve
from textmech.reference.system import Only
from textmech.reference.systems.friction.smooth_friction import SmoothGrowingForce

G = 9.80665
WITHOUT_CHANGES = ("too steep", "example 2.3 smooth", "example 2.4 smooth")
SLIP = {"slips": Event("guide.slip", "leaves zero")}  # a record is kept where there are events


def generated(tmp_path: Path, name: str) -> Solution:
    """The same scene answered by the generated mechanism alone."""
    case = written_scenes.generated(tmp_path, name)
    return solve(replace(case, events=case.events or SLIP))


@pytest.mark.slow
@pytest.mark.parametrize("name", written_scenes.WRITTEN)
def test_hand_written_and_generated_answers_agree(tmp_path: Path, name: str) -> None:
    solution = solve(written_scenes.case(tmp_path, name))
    assert [check for check in solution.checks if not check.holds] == []
    names = {check.name for check in solution.checks}
    assert "generated motion" in names
    assert ("generated events" in names) == (name not in WITHOUT_CHANGES)


LIFTED = """\
scene:
  bodies: {block: {particle: {mass: 1}}}
  contacts: {floor: {between: [block, ground.floor], friction: 0.3}}
  forces: {rope: {push: block.center, ramp: [0, 20]}}
initial: {block: {x: 0, y: 0, vx: 0}}
allow: {block.y: 1.0e-3}
"""


def test_what_is_lifted_opens_its_contact(tmp_path: Path) -> None:
    """(2.87) The floor no longer pushes at 20 t = m g."""
    case = scenes.typed(tmp_path, LIFTED, tail=scenes.tail(0.6, 3))
    (opens,) = follow(scenes.mechanism(case), case.times).changes
    assert opens.name == "floor opens"
    assert opens.time == pytest.approx(G / 20, abs=1e-12)


@pytest.mark.slow
def test_braking_by_its_closed_form(tmp_path: Path) -> None:
    """(2.87) v₀/(μ g) and v₀²/(2 μ g); stiction above friction changes nothing."""
    solution = generated(tmp_path, "braking")
    assert boundaries(solution.trajectory) == pytest.approx([3 / (0.3 * G)], abs=1e-12)
    x = solution.trajectory.states["block"][-1, 0]
    assert x == pytest.approx(9 / (2 * 0.3 * G), abs=1e-12)
    assert abs(solution.trajectory.states["block"][-1, 3]) < 1e-15


@pytest.mark.slow
def test_backspin_by_its_closed_form(tmp_path: Path) -> None:
    """Slip v₀ + R ω₀ falls by 3 μ g: rolling starts with v = (2 v₀ − R ω₀)/3."""
    solution = generated(tmp_path, "backspin")
    v, omega = 3.0, 40.0  # counter-clockwise: it comes back
    assert boundaries(solution.trajectory) == pytest.approx(
        [(v + 0.25 * omega) / (3 * 0.4 * G)], abs=1e-12
    )
    assert solution.trajectory.states["wheel"][-1, 3] == pytest.approx((2 * v - 10) / 3, abs=1e-12)


@pytest.mark.slow
def test_published_times_of_example_2_4(tmp_path: Path) -> None:
    """Six digits: slip, stick, slip, stick."""
    times = boundaries(generated(tmp_path, "example 2.4").trajectory)
    assert times == pytest.approx([1.5, 4.790544, 6.290544, 9.581087], abs=1e-6)


@pytest.mark.slow
def test_events_stand_twice_in_the_record(tmp_path: Path) -> None:
    solution = generated(tmp_path, "elastic")
    record = solution.trajectory.record
    assert record is not None
    assert record.phase is not None
    i = int(np.flatnonzero(np.diff(record.phase))[0])
    assert record.times[i] == record.times[i + 1] == pytest.approx(math.sqrt(2 / G), abs=1e-12)
    before, after = record.states["wheel"][i : i + 2]
    assert after[4] == pytest.approx(-before[4])
    assert before[:3] == pytest.approx(after[:3])


BESIDE = """\
scene:
  points: {O: [0, 0]}
  bodies: {wheel: {disk: {mass: 1.3, radius: 0.25}}, block: {particle: {mass: 1}}}
  joints: {guide: {slide: [ground.O, block.center], along: [1, 0], dry_friction: FRICTION}}
  contacts: {touch: {between: [wheel, ground.floor], friction: 0.4}}
  forces: {pull: {push: block.center, ramp: [-20.0, 0]}}
initial: {wheel: {x: 0, y: 0.25, angle: 0, vx: -3, omega: -20}, block: {x: 0}}
events: {rolls: {touch.slip: stays zero}}
allow: {wheel.x: 1.0e-3, block.x: 1.0e-3}
"""
SMOOTH = "{static: 6, kinetic: 3, smooth: {band: 5.0e-4, sharpness: 1.0e5}}"


@pytest.mark.slow
def test_smooth_friction_may_stand_beside_a_contact(tmp_path: Path) -> None:
    """Two bodies that know nothing of each other move as each would alone.

    The disk by its closed form: slip v₀ + R ω₀ = −8 m/s ends after 8/(3 μ g), at −1/3 m/s.
    """
    text = BESIDE.replace("FRICTION", SMOOTH)
    solution = solve(scenes.typed(tmp_path, text, tail=scenes.tail(1.0, 26)))
    assert [check for check in solution.checks if not check.holds] == []
    assert boundaries(solution.trajectory) == pytest.approx([8 / (3 * 0.4 * G)], abs=1e-10)
    v = (2 * -3 + 0.25 * 20) / 3
    assert solution.trajectory.states["wheel"][-1, 3] == pytest.approx(v, abs=1e-9)
    alone = SmoothGrowingForce(1.0, 20.0, 3.0, 3.0, 6.0, 6.0, 5e-4, 1e5)
    exact = follow(Only(alone), solution.trajectory.times).y
    assert solution.trajectory.states["block"][:, 0] == pytest.approx(exact[:, 0], abs=1e-9)
