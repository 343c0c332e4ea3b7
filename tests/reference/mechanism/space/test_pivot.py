"""A point that stands on the floor: the top on its tip, beside the one that is written by hand."""

import numpy as np
import pytest
from given import scenes
from given.refused import refused

from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.observe import observe
from textmech.reference.motion.follow import follow
from textmech.reference.system import MOVING
from textmech.reference.systems import written

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
def test_what_the_floor_cannot_hold(
    friction: float, omega: str, said: str, tmp_path: object
) -> None:
    case = scenes.typed(tmp_path, SCENE % (friction, omega), tail=scenes.tail(0.1, 3))  # type: ignore[arg-type]
    mistake = refused(case)
    assert mistake.where == "scene.contacts.touch.ideal"
    assert mistake.what.startswith(said)
