"""A homogeneous disk looks alike however it is turned: an angle that is not given is 0."""

from pathlib import Path

import pytest
from given.otherwise import otherwise

from textmech.cases.language import resolve
from textmech.cases.load import load

BALL = """\
title: A ball thrown off a table
scene:
  points: {{O: [0, 0]}}
  bodies: {{ball: {shape}}}
{more}
initial: {{ball: {start}}}
duration: 0.4
samples: 11
allow: {{ball.x: 1.0e-3}}
"""
DISK = "{disk: {mass: 1.0, radius: 0.1}, points: {P: [0.05, 0]}}"
RING = "{rigid: {mass: 1.0, inertia: 0.01, radius: 0.1}}"
AXLE = "  joints: {axle: {pin: [ground.O, ball.center]}}"
THROWN = "{x: 0, y: 1, vx: 2, vy: 0}"


def begun(folder: Path, shape: str = DISK, more: str = "", start: str = THROWN) -> dict[str, float]:
    file = folder / "ball.yaml"
    more = more.replace("ALONG", "along: [1, 0], across: 2")
    file.write_text(BALL.format(shape=shape, more=more, start=start), encoding="utf-8")
    (case,) = load(file)
    return dict(case.initial["ball"].given)


@pytest.mark.parametrize(
    "more",
    [
        "",
        "  contacts: {touch: {between: [ball, ground.floor], friction: 0.3}}",
        "  forces: {hand: {push: ball.center, constant: [1, 0]}}",
        "  joints: {rod: {distance: [ground.O, ball.center]}}",
        "  joints: {axle: {pin: [ground.O, ball.center], dry_friction: {kinetic: 1}}}",
        f"{AXLE}\nevents: {{stops: {{axle.omega: falls to zero}}}}",
    ],
)
def test_it_starts_at_0_where_nothing_depends_on_it(tmp_path: Path, more: str) -> None:
    assert begun(tmp_path, more=more)["angle"] == 0.0


@pytest.mark.parametrize(
    ("shape", "more"),
    [
        (RING, ""),
        (DISK, "  forces: {hand: {push: ball.P, constant: [1, 0]}}"),
        (DISK, "  joints: {pin: {pin: [ground.O, ball.P]}}"),
        (DISK, "  joints: {rod: {distance: [ground.O, ball.P]}}"),
        (DISK, "  joints: {guide: {slide: [ground.O, ball.center], along: [1, 0]}}"),
        (DISK, "  joints: {guide: {slot: [ball.center, ground.O], along: [1, 0]}}"),
        (DISK, f"{AXLE}\n  forces: {{wire: {{torsion: axle, stiffness: 1, rest_angle: 0}}}}"),
        (DISK, f"{AXLE}\n  forces: {{ends: {{stops: axle, low: -1}}}}"),
        (DISK, f"{AXLE}\n  drive: {{axle.omega: {{constant: 1}}}}"),
        (DISK, f"{AXLE}\nevents: {{turned: {{axle.angle: {{rises to: 1}}}}}}"),
        (DISK, "events: {turned: {ball.angle: {rises to: 1}}}"),
        (DISK, "events: {level: {ball.P.vy: falls to zero}}"),
        (DISK, "  constraints: {blade: {edge: ball.center, along: [1, 0]}}"),
        (DISK, "  forces: {d: {drag: ball.center, coefficient: 1, exponent: 1, ALONG}}"),
    ],
)  # fmt: skip
def test_it_is_asked_for_where_something_does(tmp_path: Path, shape: str, more: str) -> None:
    assert "angle" not in begun(tmp_path, shape, more)


def test_what_is_given_stays(tmp_path: Path) -> None:
    assert begun(tmp_path, start="{x: 0, y: 1, angle: 30 deg}")["angle"] == pytest.approx(
        0.5236, 1e-4
    )


@pytest.mark.mutant("a disk's angle starts at 0 where a joint holds it")
def test_a_joint_decides(tmp_path: Path) -> None:
    blind = otherwise(resolve, "        *scene.joints.values(),\n", "")
    begun(tmp_path, more="  joints: {pin: {pin: [ground.O, ball.P]}}")
    (case,) = load(tmp_path / "ball.yaml")
    assert "angle" not in case.initial["ball"].given
    assert "angle" in blind._turned(dict(case.initial), case.scene, {})["ball"].given


@pytest.mark.mutant("a disk's angle starts at 0 where a spring winds by it")
def test_what_winds_decides(tmp_path: Path) -> None:
    blind = otherwise(resolve, "not (said or winds or driven)", "not (said or driven)")
    begun(
        tmp_path, more=f"{AXLE}\n  forces: {{wire: {{torsion: axle, stiffness: 1, rest_angle: 0}}}}"
    )
    (case,) = load(tmp_path / "ball.yaml")
    assert "angle" not in case.initial["ball"].given
    assert "angle" in blind._turned(dict(case.initial), case.scene, {})["ball"].given


SPHERE = """\
title: A ball on a spring
scene:
  space: 3
  points: {{O: [0, 0, 1]}}
  bodies: {{ball: {{sphere: {{mass: 1.0, radius: 0.1}}, points: {{P: [0.1, 0, 0]}}}}}}
  {held}
initial: {{ball: {{x: 0.3, y: 0, z: 0.5}}}}
duration: 0.4
samples: 11
allow: {{ball.x: 1.0e-3}}
"""


@pytest.mark.parametrize(
    ("held", "asked"),
    [
        ("forces: {s: {spring: [ground.O, ball.center], stiffness: 9, rest_length: 0}}", False),
        ("forces: {s: {spring: [ground.O, ball.P], stiffness: 9, rest_length: 0}}", True),
        ("joints: {j: {ball: [ground.O, ball.center]}}", False),
        ("joints: {j: {ball: [ground.O, ball.P]}}", True),
        ("joints: {j: {hinge: [ground.O, ball.center], axis: [1, 0, 0]}}", True),
    ],
)
def test_so_does_a_sphere(tmp_path: Path, held: str, *, asked: bool) -> None:
    file = tmp_path / "sphere.yaml"
    file.write_text(SPHERE.format(held=held), encoding="utf-8")
    (case,) = load(file)
    assert (case.initial["ball"].attitude is None) == asked
