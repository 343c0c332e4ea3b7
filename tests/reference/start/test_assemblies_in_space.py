"""Starts in space: ways to assemble, joints turned over, coordinates that tell nothing."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from given.linkages import LINKAGE
from given.scenes import typed

from textmech.cases.mistake import CaseError
from textmech.cases.scene import GROUND, Anchor
from textmech.cases.scene.rotation import about
from textmech.reference.start.assembly import assemble
from textmech.reference.start.spatial_closure import SpatialClosure, closes

BODY = (
    "{rigid: {mass: 1.0, inertia: [0.02, 0.03, 0.025, 0, 0, 0]}, "
    "points: {p: [0.2, 0, 0], q: [-0.2, 0, 0]}}"
)
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
    return assemble(case)[0]


def test_only_a_loop_closes(tmp_path: Path) -> None:
    """Three bodies in a row, and with the joint that leads back to the first; two islands."""
    loop = typed(tmp_path, FREE_LOOP + "allow: {a.x: 1.0e-3}\n").scene
    row = replace(loop, joints={name: loop.joints[name] for name in ("j1", "j2")})
    held = replace(loop.joints["j3"], b=Anchor(GROUND, "O"))
    apart = replace(loop, joints={"j1": loop.joints["j1"], "held": held})
    assert [closes(scene) for scene in (loop, row, apart)] == [True, False, False]


@pytest.mark.slow
def test_a_linkage_has_its_two_ways_and_none_with_a_hinge_turned_over(tmp_path: Path) -> None:
    text = refused(tmp_path, LINKAGE)
    assert "can be assembled in 2 ways" in text
    assert "near: {bearing: {angle:" in text


@pytest.mark.mutant("a hinge turned over taken for an assembly")
@pytest.mark.slow
def test_a_hinge_turned_over_is_no_assembly(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The rows alone let the rocker stand on its head, too."""
    monkeypatch.setattr(SpatialClosure, "is_assembly", lambda self, q: True)
    assert "can be assembled in 4 ways" in refused(tmp_path, LINKAGE)


@pytest.mark.slow
def test_near_chooses_a_way(tmp_path: Path) -> None:
    found = [
        started(tmp_path, LINKAGE + f"near: {{bearing: {{angle: {angle} deg}}}}\n")
        for angle in (51, 181)
    ]
    assert np.max(np.abs(found[0] - found[1])) > 0.1


@pytest.mark.slow
def test_a_loop_that_hangs_on_nothing_has_several_ways_too(tmp_path: Path) -> None:
    assert "ways" in refused(tmp_path, FREE_LOOP)


def test_coordinates_at_gimbal_lock_are_named(tmp_path: Path) -> None:
    assert "at s.q = 90 deg 'p' and 'r' turn about one axis" in refused(tmp_path, LOCKED)


@pytest.mark.slow
@pytest.mark.parametrize("q", ["89 deg", "0"])
def test_away_from_it_they_start(q: str, tmp_path: Path) -> None:
    started(tmp_path, LOCKED.replace("90 deg", q))


def test_a_disk_that_lies_flat_is_told_so(tmp_path: Path) -> None:
    assert "c: a disk that lies flat has no lowest point" in refused(tmp_path, FLAT)


def test_of_three_turns_none_can_be_driven(tmp_path: Path) -> None:
    assert "leaves three turns, and of these none can be driven" in refused(tmp_path, DRIVEN)


SLIDES = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies: {box: {rigid: {mass: 1, inertia: [0.1, 0.1, 0.1, 0, 0, 0]}}}
  joints: {guide: {slide: [ground.O, box.center], along: [1, 0, 0]}}
initial: {guide: {shift: 0}}
allow: {box.x: 1.0e-3}
"""
# Of those with all its rows closed the first alone is what a slide means.
TURNED = {
    "as it is": ((1, 1, 1), 0.0, True),
    "its axes in a cycle": ((1, 1, 1), 2 * np.pi / 3, False),
    "about its line, half a turn": ((1, 0, 0), np.pi, False),
    "across its line, half a turn": ((0, 1, 0), np.pi, False),
}


def meant(name: str, folder: Path) -> tuple[float, bool]:
    """The largest residual of a box turned about an axis, and whether it is an assembly."""
    case = typed(folder, SLIDES)
    closure = SpatialClosure(case)
    axis, angle, _ = TURNED[name]
    q = np.array([0.0, 0.0, 0.0, *about(axis, angle)])
    return float(np.abs(closure.equations(q)[0]).max()), closure.is_assembly(q)


@pytest.mark.parametrize("name", TURNED)
def test_rows_of_right_angles_hold_of_axes_turned_over(name: str, tmp_path: Path) -> None:
    """Three rows e_i ⊥ e_j hold after half a turn, and after a third of one about (1, 1, 1)."""
    residual, assembled = meant(name, tmp_path)
    assert residual < 1e-15
    assert assembled == TURNED[name][2]


@pytest.mark.mutant("a slide with its axes in a cycle taken for an assembly")
def test_axes_in_a_cycle_are_seen(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Their cosine is 0, between 1 and the −1 of half a turn."""
    monkeypatch.setattr("textmech.reference.start.spatial_closure.ALIKE", -0.5)
    assert meant("its axes in a cycle", tmp_path)[1]
    assert not meant("across its line, half a turn", tmp_path)[1]


HUNG = f"""\
scene:
  space: 3
  points: {{O: [PLACE, 0, 0]}}
  bodies: {{a: {BODY}, b: {BODY}}}
  joints:
    neck: {{ball: [ground.O, a.p]}}
    elbow: {{ball: [a.q, b.p]}}
initial:
  b: {{attitude: {{axis: [0, 1, 0], angle: 30 deg}}}}
  a: {{attitude: {{axis: [1, 0, 1], angle: 200 deg}}}}
"""


@pytest.mark.parametrize("place", ["0", "20", "1.0e+4"])
def test_what_is_turned_hangs_where_its_joint_is(tmp_path: Path, place: str) -> None:
    """However many of its sizes that is from the origin; Newton goes one of them in a step."""
    q = started(tmp_path, HUNG.replace("PLACE", place))
    case = typed(tmp_path, HUNG.replace("PLACE", place) + "allow: {a.x: 1.0e-3}\n")
    closure = SpatialClosure(case)
    assert np.max(np.abs(closure.equations(q)[0])) < 1e-15 * max(float(place), 1.0) / closure.size
    at_origin = started(tmp_path, HUNG.replace("PLACE", "0"))
    moved = closure.where.slots["a"].r, closure.where.slots["b"].r
    at_origin[list(moved)] += float(place)
    np.testing.assert_allclose(q, at_origin, rtol=0.0, atol=1e-15 * max(float(place), 1.0))
