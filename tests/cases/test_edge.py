"""What can be observed of an edge, by typed numbers, and how its body starts."""

from pathlib import Path

import numpy as np
import pytest
from given import edges, scenes

from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Edge, Scene
from textmech.cases.scene.observe import observe
from textmech.cases.scene.shape import rigid
from textmech.cases.trajectory import Trajectory
from textmech.reference.start.assembly import start_poses


def test_slip_is_to_the_left_and_speed_along() -> None:
    """At 90° the body's x is the ground's y: P stands at (−0.2, 0.5) from the centre."""
    sled = rigid(name="sled", mass=1.0, inertia=1.0, points={"P": (0.5, 0.2)})
    blade = Edge("blade", Anchor("sled", "P"), (0.6, 0.8))
    scene = Scene((0.0, 0.0), {}, {"sled": sled}, {}, {}, {}, {"blade": blade})
    state = np.array([[1.0, 2.0, np.pi / 2, 0.3, 0.4, 2.0]])
    motion = Trajectory(np.zeros(1), {"sled": state}, {})
    # v_P = (0.3, 0.4) + 2 (−0.5, −0.2) = (−0.7, 0); along is (−0.8, 0.6), left is (−0.6, −0.8)
    assert observe(scene, motion, "blade.speed") == pytest.approx([0.56], abs=1e-15)
    assert observe(scene, motion, "blade.slip") == pytest.approx([0.42], abs=1e-15)


def test_rates_follow_from_the_speed(tmp_path: Path) -> None:
    """u = 0.7 along 40° + atan 3/4, and (2.6) from P to the centre."""
    case = scenes.typed(tmp_path, edges.FREE)
    x, y, angle, vx, vy, omega = start_poses(case)["sleigh"]
    along, turn = np.exp(1j * (angle + np.arctan2(0.6, 0.8))), np.exp(1j * angle)
    lever = -(-0.35 + 0.1j) * turn  # from P to the centre
    assert complex(x, y) == pytest.approx(0.2 - 0.1j + lever, abs=1e-15)
    assert complex(vx, vy) == pytest.approx(0.7 * along + 1.1j * lever, abs=1e-15)
    assert omega == 1.1


def test_rates_that_slip_are_a_mistake(tmp_path: Path) -> None:
    slipping = edges.FREE.replace("omega: 1.1}", "omega: 1.1, vx: 3, vy: 0}")
    with pytest.raises(CaseError, match="the rates violate blade"):
        start_poses(scenes.typed(tmp_path, slipping))


def test_without_a_speed_more_is_needed(tmp_path: Path) -> None:
    open_ended = edges.FREE.replace(", blade: {speed: 0.7}", "")
    with pytest.raises(CaseError, match=r"sleigh\.vx, sleigh\.vy are not determined"):
        start_poses(scenes.typed(tmp_path, open_ended))


def test_an_edge_that_repeats_another_is_a_mistake(tmp_path: Path) -> None:
    twice = edges.FREE.replace("0.6]}}", "0.6]}, again: {edge: sleigh.P, along: [0.8, 0.6]}}")
    with pytest.raises(CaseError, match=r"scene\.constraints\.again: .* not independent"):
        start_poses(scenes.typed(tmp_path, twice))
