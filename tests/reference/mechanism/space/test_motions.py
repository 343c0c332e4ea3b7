"""Mechanisms in space from their files alone, against closed forms and systems by hand."""

import math

import numpy as np
import pytest
from given import scenes
from given.refused import refused

from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.observe import observe
from textmech.cases.trajectory import Array
from textmech.reference.motion.follow import follow
from textmech.reference.system import MOVING
from textmech.reference.systems import written

G = 9.80665  # m/s²

pytestmark = pytest.mark.slow  # they take the certified motions


def seen(name: str, *quantities: str) -> list[Array]:
    """Quantities along the certified motion of a case, after its times."""
    found = scenes.solved(name).trajectory
    return [found.times, *(observe(scenes.SHIPPED[name].scene, found, q) for q in quantities)]


def test_a_sphere_rolls_along_a_parabola() -> None:
    """(2.23), (2.27) ẍ = 5/7 g sin α, ẏ stays; the floor holds it back with 2/7 m g sin α."""
    p = scenes.SHIPPED["rolling_sphere"].parameters
    t, x, y, fx = seen("rolling_sphere", "ball.x", "ball.y", "touch.fx")
    slope = G * math.sin(p["alpha"])
    assert np.max(np.abs(x - 5 / 14 * slope * t**2)) < 1e-12  # m, of 1.2
    assert np.max(np.abs(y - p["u"] * p["R"] * t)) < 1e-12
    assert np.max(np.abs(fx + 2 / 7 * p["m"] * slope)) < 1e-12  # N, of 0.8


def test_a_universal_joint_turns_unevenly() -> None:
    """ω₂/ω₁ = cos β/(1 − sin²β sin²φ), φ from where the first arm stands across both shafts."""
    names = ("bearing.angle", "bearing.omega", "driven.omega_1", "energy.total")
    _, angle, one, two, energy = seen("universal_shaft", *names)
    ratio = math.cos(math.pi / 6) / (1 - 0.25 * np.sin(angle) ** 2)
    assert np.max(np.abs(two / one - ratio)) < 1e-12
    assert np.ptp(two / one) > 0.2  # it is uneven
    assert np.max(np.abs(energy - energy[0])) < 1e-12  # J, of 0.3


def test_two_bodies_turn_without_angular_momentum() -> None:
    """After a cycle of the waist the chest stands otherwise; nothing ever turns as a whole."""
    names = [f"momentum.angular_{axis}" for axis in "xyz"]
    t, *momenta, bow, lean = seen("cat_turn", *names, "waist.bow", "waist.lean")
    assert np.max(np.abs(momenta)) < 1e-13  # kg m²/s, of 0.6 in one body
    assert np.max(np.abs(bow - 0.8 * np.sin(5 * t))) < 1e-12
    assert np.max(np.abs(lean - 0.8 * (1 - np.cos(5 * t)))) < 1e-12
    last = scenes.solved("cat_turn").trajectory.states["chest"][-1]
    assert 2 * math.acos(abs(last[3])) > 0.1  # rad


TOP = scenes.SHIPPED["top_on_floor"]
SCENE = """\
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


@pytest.mark.slow
def test_the_top_is_the_one_on_a_ball_joint() -> None:
    """(2.33) Its tip stays at the origin, and the floor's force is that of the joint."""
    parameters = {key: value for key, value in TOP.parameters.items() if key != "mu"}
    system = written("heavy_top", {**parameters, "w1": 0.6, "w2": 2.0})
    known, motion = follow(system, TOP.times), scenes.solved("top_on_floor").trajectory
    mode = system.modes[MOVING]
    rows = [(t, *mode.parted(y)) for t, y in zip(TOP.times.tolist(), known.y, strict=True)]
    poses = np.array([mode.poses(*row)["top"] for row in rows])
    found = motion.states["top"]
    same = np.sum(poses[:, SPACE.attitude] * found[:, SPACE.attitude], axis=1, keepdims=True)
    poses[:, SPACE.attitude] *= np.sign(same)
    assert np.max(np.abs(found - poses)) < 1e-10  # of 100 rad/s
    for axis, quantity in (("fx", "fx"), ("fy", "fy"), ("fz", "normal")):
        held = np.array([mode.reactions(*row)[f"pivot.{axis}"] for row in rows])
        assert np.max(np.abs(motion.reactions[f"touch.{quantity}"] - held)) < 1e-10  # N, of 5
    assert np.max(np.abs(observe(TOP.scene, motion, "touch.slip"))) < 1e-11
    assert np.max(np.abs(observe(TOP.scene, motion, "touch.gap"))) < 1e-12


@pytest.mark.parametrize(
    ("friction", "omega", "said"),
    [
        (0.05, "[0, 0.9, 150]", "pivoting is not possible with friction 0.05: at t = "),
        (9.0, "[20, 0, 150]", "the floor would have to pull at t = 0 s: top leaves it"),
    ],
)
def test_what_the_floor_cannot_hold(friction: float, omega: str, said: str) -> None:
    case = scenes.parsed(SCENE % (friction, omega), tail=scenes.tail(0.1, 3))  # type: ignore[arg-type]
    mistake = refused(case)
    assert mistake.where == "scene.contacts.touch.ideal"
    assert mistake.what.startswith(said)
