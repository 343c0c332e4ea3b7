"""What becomes of the words of a case in space."""

from math import cos, pi, radians, sin
from pathlib import Path

import numpy as np
import pytest
from given.spatial_case import SOUND
from given.spatial_motions import turn

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.scene import (
    STANDARD_GRAVITY,
    Anchor,
    GroundPoint,
    Push,
    Scene,
    Signal,
    Torque,
    solid,
)
from textmech.cases.scene.contact import spatial_contact
from textmech.cases.scene.frame import SPACE
from textmech.cases.scene.joint import Freedom, Joint
from textmech.cases.scene.quantity import table
from textmech.cases.scene.rotation import matrix

X, Y, Z = (1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)


def case_of(tmp_path: Path, text: str) -> Case:
    path = tmp_path / "own.yaml"
    path.write_text(text, encoding="utf-8")
    (case,) = load(path)
    return case


def scene_of(tmp_path: Path, text: str = SOUND) -> Scene:
    return case_of(tmp_path, text).scene


@pytest.mark.parametrize(
    ("words", "gravity"),
    [
        ("incline: phi0", (STANDARD_GRAVITY * sin(pi / 6), 0, -STANDARD_GRAVITY * cos(pi / 6))),
        ("gravity: none", (0, 0, 0)),
        ("gravity: 1.62 m/s^2", (0, 0, -1.62)),
        ("gravity: 1.62\n  incline: phi0", (1.62 * sin(pi / 6), 0, -1.62 * cos(pi / 6))),
        ("gravity: [0.1, -0.2, -1.62 m/s^2]", (0.1, -0.2, -1.62)),
    ],
)
def test_gravity(tmp_path: Path, words: str, gravity: tuple[float, float, float]) -> None:
    scene = scene_of(tmp_path, SOUND.replace("incline: phi0", words))
    assert scene.gravity == pytest.approx(gravity, rel=1e-15)


def test_points_and_bodies(tmp_path: Path) -> None:
    scene = scene_of(tmp_path)
    assert scene.points == {
        "O": GroundPoint((0.0, 0.0, 0.0), (0.0, 0.0, 0.0)),  # type: ignore[arg-type]
        "hook": GroundPoint((0.0, 0.0, 1.0), (0.0, 0.1, 0.0)),  # type: ignore[arg-type]
    }
    assert dict(scene.bodies) == {
        "bar": solid.bar(name="bar", mass=1.2, length=0.8, points={"P": (0.1, 0.0, 0.0)}),
        "wheel": solid.disk(name="wheel", mass=2.0, radius=0.25, axle=Y, points={}),
        "globe": solid.sphere(name="globe", mass=2.0, radius=0.25, points={}),
        "box": solid.block(name="box", mass=2.0, size=(0.1, 0.2, 0.3), points={}),
        "top": solid.rigid(
            name="top",
            mass=2.0,
            inertia=(0.05, 0.05, 0.04, 0.0, 0.0, 0.01),
            points={"P": (0.0, 0.0, -0.2)},
        ),
        "bob": solid.particle(name="bob", mass=0.5),
    }


def test_joints(tmp_path: Path) -> None:
    freedoms = {
        "q1": ("hinge", "ground.O", "bar.start", (Freedom.turn(Z, "angle"),)),
        "neck": ("ball", "ground.hook", "top.P", (Freedom("ball"),)),
        "cross": ("universal", "bar.end", "box.center", (Freedom.turn(Y), Freedom.turn(Z))),
        "rail": (
            "slide", "ground.O", "bob.center", (Freedom.shift((0.0, 0.6, 0.8), "shift"),),
        ),
        "upright": (
            "freedoms", "ground.O", "wheel.center",
            (Freedom.shift(X, "x"), Freedom.shift(Y, "y"), Freedom.turn(Z, "theta")),
        ),
    }  # fmt: skip
    begins = {"q1": {"angle": radians(30)}}  # of what `initial` and `near` say
    assert dict(scene_of(tmp_path).joints) == {
        name: Joint(
            name,
            kind,
            Anchor(*a.split(".")),
            Anchor(*b.split(".")),
            left,
            begins=begins.get(name, {}),
            frame=SPACE,
        )
        for name, (kind, a, b, left) in freedoms.items()
    }


def test_a_weld_leaves_nothing(tmp_path: Path) -> None:
    text = SOUND.replace("  neck: {omega: [0, 0, 20]}\n", "")
    scene = scene_of(tmp_path, text.replace("neck: {ball", "neck: {weld"))
    assert scene.joints["neck"].freedoms == ()


def test_contacts_forces_and_drives(tmp_path: Path) -> None:
    scene = scene_of(tmp_path)
    at = Anchor("globe", "center")
    assert scene.contacts == {"touch": spatial_contact("touch", at, 0.5, rim=False)}
    on_rim = scene_of(tmp_path, SOUND.replace("[globe, ground", "[wheel, ground"))
    assert on_rim.contacts["touch"].rim
    assert scene.forces["hand"] == Push("hand", Anchor("wheel", "center"), Signal("constant", X))
    spin = Signal("sine", (0.0, 0.0, 1.0), pytest.approx(2 * pi / 3))  # type: ignore[arg-type]
    assert scene.forces["motor"] == Torque("motor", "top", spin)
    assert scene.drives == {
        "upright.theta_dot": Signal("constant", (2.0,)),
        "q1.omega": Signal("sine", (2.0,), 2.0, radians(30)),
    }
    assert scene.driven() == {
        "upright": {"theta_torque": ("N m", "force")},
        "q1": {"torque": ("N m", "force")},
    }
    shifted = scene_of(tmp_path, SOUND.replace("upright.theta_dot: w", "rail.shift_dot: {ramp: 3}"))
    assert shifted.drives["rail.shift_dot"] == Signal("ramp", (3.0,))
    assert table(shifted)["rail.shift_force"].unit == "N"
    assert "upright.theta_torque" not in table(shifted)


def test_start(tmp_path: Path) -> None:
    case = case_of(tmp_path, SOUND)
    start = case.initial
    assert start["q1"].given == {"angle": radians(30), "omega": 1.0}
    assert start["neck"].given == {"omega_1": 0.0, "omega_2": 0.0, "omega_3": 20.0}
    assert start["top"].points == {"P": (0.0, 0.0, 1.0)}
    rates = {"vx": 0.1, "omega_1": 0.0, "omega_2": 0.0, "omega_3": 1.0}
    assert start["globe"].given == {"x": 1.0, "y": 0.0, "z": 0.25, **rates}
    assert start["globe"].attitude == (1.0, 0.0, 0.0, 0.0)
    assert case.near["upright"].given == {"x": 0.2}
    assert case.near["bob"].given == {"y": 0.1}


def test_each_turn_of_an_attitude_is_about_the_axes_that_those_before_it_leave(
    tmp_path: Path,
) -> None:
    """About the ground's z, and then about the x that has turned with it."""
    found = case_of(tmp_path, SOUND).initial["top"].attitude
    assert found is not None
    about_x = turn([cos(0.1), sin(0.1), 0.0], radians(30))
    expected = about_x @ turn(Z, 0.1)
    np.testing.assert_allclose(matrix(np.array(found)), expected, atol=1e-15)
