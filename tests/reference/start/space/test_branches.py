"""Starts in space: ways to assemble, joints turned over, coordinates that tell nothing."""

from pathlib import Path

import numpy as np
import pytest
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.cases.space.scene import SpatialScene
from textmech.reference.start.space import positions
from textmech.reference.start.space.assembly import assemble_in_space

BODY = (
    "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}, "
    "points: {p: [0.2, 0, 0], q: [-0.2, 0, 0]}}"
)
LINKAGE = """\
scene:
  space: 3
  points: {O: [0, 0, 0], Q: [0.6, 0.1, 0]}
  bodies:
    crank:
      rigid: {mass: 0.5, inertia: [1.0e-3, 2.0e-3, 2.2e-3, 0, 0, 0]}
      points: {foot: [-0.07, 0, 0], pin: [0.07, 0, 0]}
    coupler:
      rigid: {mass: 0.5, inertia: [1.5e-3, 3.0e-2, 2.9e-2, 0, 0, 0]}
      points: {a: [-0.3, 0, 0], b: [0.3, 0, 0]}
    rocker:
      rigid: {mass: 0.8, inertia: [1.2e-2, 1.0e-2, 1.5e-2, 0, 0, 0]}
      points: {foot: [-0.1, -0.2, 0], pin: [0.1, 0.2, 0]}
  joints:
    motor: {hinge: [ground.O, crank.foot], axis: [0, 0, 1]}
    near:
      freedoms: {yaw: {hinge: [0, 0, 1]}, pitch: {hinge: [0, 1, 0]}, roll: {hinge: [1, 0, 0]}}
      of: [crank.pin, coupler.a]
    far: {ball: [coupler.b, rocker.pin]}
    bearing: {hinge: [ground.Q, rocker.foot], axis: [0.6, 0, 0.8]}
initial: {motor: {angle: 30 deg}, near: {roll: 0}}
"""
FREE_LOOP = f"""\
scene:
  space: 3
  gravity: none
  bodies: {{a: {BODY}, b: {BODY}, c: {BODY}}}
  joints:
    j1: {{hinge: [a.p, b.q], axis: [0, 0, 1]}}
    j2: {{universal: [b.p, c.q], axes: [[0, 0, 1], [0, 1, 0]]}}
    j3: {{ball: [c.p, a.q]}}
initial:
  a: {{x: 0, y: 0, z: 0, attitude: {{axis: [0, 0, 1], angle: 0}}}}
"""
LOCKED = f"""\
scene:
  space: 3
  points: {{O: [0, 0, 0]}}
  bodies: {{a: {BODY}}}
  joints:
    s:
      freedoms: {{p: {{hinge: [0, 0, 1]}}, q: {{hinge: [0, 1, 0]}}, r: {{hinge: [1, 0, 0]}}}}
      of: [ground.O, a.p]
initial: {{s: {{p: 0.1, q: 90 deg, r: 0.2}}}}
"""
FLAT = """\
scene:
  space: 3
  bodies: {a: {disk: {mass: 1.0, radius: 0.2, axle: [0, 0, 1]}}}
  contacts: {c: {between: [a, ground.floor], friction: 1.0, ideal: rolling}}
initial: {a: {x: 0, y: 0, attitude: {axis: [1, 0, 0], angle: 0}, omega: [1, 2, 3]}}
"""
DRIVEN = LOCKED.replace("90 deg", "0.3").replace("initial:", "  drive: {s.q_dot: 1.0}\ninitial:")


def refused(folder: Path, scene: str) -> str:
    with pytest.raises(CaseError) as caught:
        started(folder, scene)
    return str(caught.value)


def started(folder: Path, scene: str) -> np.ndarray:
    body = "crank" if "crank" in scene else "a"
    case = typed(folder, scene + f"allow: {{{body}.x: 1.0e-3}}\n")
    assert isinstance(case.scene, SpatialScene)
    return assemble_in_space(case, case.scene)[0]


@pytest.mark.whole
def test_a_linkage_has_its_two_ways_and_none_with_a_hinge_turned_over(tmp_path: Path) -> None:
    text = refused(tmp_path, LINKAGE)
    assert "can be assembled in 2 ways" in text
    assert "near: {bearing: {angle:" in text


@pytest.mark.mutant("a hinge turned over taken for an assembly")
@pytest.mark.whole
def test_a_hinge_turned_over_is_no_assembly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The rows alone let the rocker stand on its head, too."""
    monkeypatch.setattr(positions, "faithful", lambda closure, q: True)
    assert "can be assembled in 4 ways" in refused(tmp_path, LINKAGE)


def test_near_chooses_a_way(tmp_path: Path) -> None:
    found = [
        started(tmp_path, LINKAGE + f"near: {{bearing: {{angle: {angle} deg}}}}\n")
        for angle in (51, 181)
    ]
    assert np.max(np.abs(found[0] - found[1])) > 0.1


def test_a_loop_that_hangs_on_nothing_has_several_ways_too(tmp_path: Path) -> None:
    assert "ways" in refused(tmp_path, FREE_LOOP)


def test_coordinates_at_gimbal_lock_are_named(tmp_path: Path) -> None:
    assert "at s.q = 90 deg 'p' and 'r' turn about one axis" in refused(tmp_path, LOCKED)


@pytest.mark.parametrize("q", ["89 deg", "0"])
def test_away_from_it_they_start(q: str, tmp_path: Path) -> None:
    started(tmp_path, LOCKED.replace("90 deg", q))


def test_a_disk_that_lies_flat_is_told_so(tmp_path: Path) -> None:
    assert "c: a disk that lies flat has no lowest point" in refused(tmp_path, FLAT)


def test_of_three_turns_none_can_be_driven(tmp_path: Path) -> None:
    assert "leaves three turns, and of these none can be driven" in refused(tmp_path, DRIVEN)
