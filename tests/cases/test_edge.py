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
from textmech.reference.start import closure
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


UPRIGHT = """\
scene:
  gravity: none
  bodies: {stranger: {particle: {mass: 1}}, b: {rigid: {mass: 1.4, inertia: 0.06}}}
  constraints: {blade: {edge: b.center, along: [1, 0]}}
initial: {stranger: {x: 0, y: 5, vx: 1e9, vy: 0}, b: {x: 0, y: 0, angle: ANGLE deg, RATES}}
allow: {b.angle: 1.0e-2}
"""
"""A blade with all its rates, beside what is a billion times as fast."""


def upright(tmp_path: Path, angle: float, rates: str) -> None:
    text = UPRIGHT.replace("ANGLE", f"{angle:g}").replace("RATES", rates)
    start_poses(scenes.typed(tmp_path, text))


@pytest.mark.mutant("rates are compared with products that are rounding themselves")
@pytest.mark.parametrize(
    ("angle", "rates"),
    [
        (90, "vx: 0, vy: 1, omega: 1.3"),
        (180, "vx: -2.3e-6, vy: 0, omega: 0"),
        (270, "vx: 0, vy: -7e4, omega: 0"),
        (360, "vx: 1, vy: 0, omega: -1"),
        (3600, "vx: 1, vy: 0, omega: 0"),
    ],
)
def test_a_blade_at_right_angles_may_have_all_its_rates(
    tmp_path: Path, angle: float, rates: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The row is (-1, 6e-17), the velocity (0, 1): both products are rounding."""
    upright(tmp_path, angle, rates)
    monkeypatch.setattr(closure, "product_size", lambda rows, v: np.max(abs(rows * v), initial=0.0))
    with pytest.raises(CaseError, match="the rates violate blade"):
        upright(tmp_path, angle, rates)


@pytest.mark.mutant("rates are compared with those of strangers")
def test_what_slips_by_a_millionth_is_refused_beside_any_stranger(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    rates = "vx: 1e-6, vy: 1, omega: 0"
    with pytest.raises(CaseError, match="the rates violate blade"):
        upright(tmp_path, 90, rates)
    monkeypatch.setattr(closure, "product_size", lambda rows, v: np.linalg.norm(v))
    upright(tmp_path, 90, rates)


def test_a_slot_at_right_angles_may_have_all_its_rates(tmp_path: Path) -> None:
    text = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {rigid: {mass: 1.4, inertia: 0.06}}, c: {particle: {mass: 1}}}
  joints: {p: {pin: [ground.O, b.center]}, s: {slot: [b.center, c.center], along: [1, 0]}}
initial: {b: {x: 0, y: 0, angle: 90 deg, vx: 0, vy: 0, omega: 0}, c: {x: 0, y: 1, vx: 0, vy: 0.4}}
allow: {c.y: 1.0e-2}
"""
    start_poses(scenes.typed(tmp_path, text))
