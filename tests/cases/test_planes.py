"""Planes of the ground: what a file makes of them, and what it can get wrong about them."""

import math
from pathlib import Path

import numpy as np
import pytest

from textmech.cases.load import load
from textmech.cases.mistake import CaseError
from textmech.cases.scene.observe import observe
from textmech.cases.scene.plane import LEVEL, Plane
from textmech.cases.trajectory import Trajectory

TEXT = """\
title: A disk in a corner
scene:
  planes: {wall: {at: [2, 0], normal: [-3, 0]}, slope: {at: [0, 1], normal: [-0.6, 0.8]}}
  bodies: {wheel: {disk: {mass: 1.0, radius: 0.5}}}
  contacts:
    low: {between: [wheel, ground.floor], friction: 0.1}
    side: {between: [wheel, ground.wall], friction: 0.1}
    ramp: {between: [wheel, ground.slope], friction: 0.1}
initial: {wheel: {x: 1.5, y: 0.5, vx: -1.0}}
duration: 1.0
samples: 26
allow: {wheel.x: 1.0e-3}
"""


def said(tmp_path: Path, text: str) -> list[tuple[str, str]]:
    path = tmp_path / "corner.yaml"
    path.write_text(text)
    with pytest.raises(CaseError) as caught:
        load(path)
    return [(m.where, m.what) for m in caught.value.mistakes]


def test_loads(tmp_path: Path) -> None:
    path = tmp_path / "corner.yaml"
    path.write_text(TEXT)
    scene = load(path)[0].scene
    assert [contact.plane for contact in scene.contacts.values()] == [
        LEVEL,
        Plane("wall", (2.0, 0.0), (-1.0, 0.0)),
        Plane("slope", (0.0, 1.0), (-0.6, 0.8)),
    ]


def test_is_observed(tmp_path: Path) -> None:
    """n·(r − r₀) − R, u·v + R ω and its integral, with numbers worked out by hand."""
    path = tmp_path / "corner.yaml"
    path.write_text(TEXT)
    scene = load(path)[0].scene
    rows = np.array([[0.0, 3.0, 0.0, 0.0, 0.0, 0.0], [1.0, 3.5, 0.2, 2.0, -1.0, 4.0]])
    motion = Trajectory(np.array([0.0, 1.0]), {"wheel": rows}, {})
    assert observe(scene, motion, "side.gap") == pytest.approx([1.5, 0.5])
    assert observe(scene, motion, "side.slip") == pytest.approx([0.0, -1.0 + 2.0])
    assert observe(scene, motion, "side.drift") == pytest.approx([0.0, 0.5 + 0.1])
    assert observe(scene, motion, "ramp.gap") == pytest.approx([1.1, -0.6 + 2.0 - 0.5])
    assert observe(scene, motion, "ramp.slip") == pytest.approx([0.0, 1.6 - 0.6 + 2.0])
    assert observe(scene, motion, "ramp.drift") == pytest.approx([0.0, 0.8 + 0.3 + 0.1])


def test_an_unknown_plane(tmp_path: Path) -> None:
    hint = "is 'ground.wal'; did you mean 'ground.wall'?"
    assert said(tmp_path, TEXT.replace("ground.wall]", "ground.wal]")) == [
        ("scene.contacts.side.between.1", f"should be a plane of the ground, {hint}")
    ]


def test_a_mistaken_plane_drags_nothing_along(tmp_path: Path) -> None:
    assert said(tmp_path, TEXT.replace("normal: [-3, 0]", "normal: up")) == [
        ("scene.planes.wall.normal", "should be a list, is text 'up'")
    ]


def test_twice_on_one_plane(tmp_path: Path) -> None:
    assert said(tmp_path, TEXT.replace("ground.slope]", "ground.wall]")) == [
        ("scene.contacts.ramp.between.0", "'wheel' already touches in 'side'")
    ]


def test_the_tangent_has_the_normal_to_its_left() -> None:
    for angle in np.linspace(0.0, math.tau, 7):
        plane = Plane("p", normal=(math.cos(angle), math.sin(angle)))
        (ux, uy), (nx, ny) = plane.along, plane.normal
        assert (-uy, ux) == pytest.approx((nx, ny))
