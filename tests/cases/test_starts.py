"""Starts of a blade, by a distance and a direction, and of a disk without an angle."""

import math

import numpy as np
import pytest
from given import scenes
from given.otherwise import otherwise
from given.scenes import cases_of, edges

from textmech.cases.case import Case
from textmech.cases.language import resolve
from textmech.cases.mistake import CaseError
from textmech.cases.scene import Anchor, Edge, Scene
from textmech.cases.scene.observe import observe
from textmech.cases.scene.point import GroundPoint
from textmech.cases.scene.shape import rigid
from textmech.cases.trajectory import Trajectory
from textmech.reference.solve import solve
from textmech.reference.start import closure
from textmech.reference.start.assembly import start_poses

# What can be observed of an edge, by typed numbers, and how its body starts.


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


def test_rates_follow_from_the_speed() -> None:
    """u = 0.7 along 40° + atan 3/4, and (2.6) from P to the centre."""
    case = scenes.parsed(edges.FREE)
    x, y, angle, vx, vy, omega = start_poses(case)["sleigh"]
    along, turn = np.exp(1j * (angle + np.arctan2(0.6, 0.8))), np.exp(1j * angle)
    lever = -(-0.35 + 0.1j) * turn  # from P to the centre
    assert complex(x, y) == pytest.approx(0.2 - 0.1j + lever, abs=1e-15)
    assert complex(vx, vy) == pytest.approx(0.7 * along + 1.1j * lever, abs=1e-15)
    assert omega == 1.1


def test_rates_that_slip_are_a_mistake() -> None:
    slipping = edges.FREE.replace("omega: 1.1}", "omega: 1.1, vx: 3, vy: 0}")
    with pytest.raises(CaseError, match="the rates violate blade"):
        start_poses(scenes.parsed(slipping))


def test_without_a_speed_more_is_needed() -> None:
    open_ended = edges.FREE.replace(", blade: {speed: 0.7}", "")
    with pytest.raises(CaseError, match=r"sleigh\.vx, sleigh\.vy are not determined"):
        start_poses(scenes.parsed(open_ended))


def test_an_edge_that_repeats_another_is_a_mistake() -> None:
    twice = edges.FREE.replace("0.6]}}", "0.6]}, again: {edge: sleigh.P, along: [0.8, 0.6]}}")
    with pytest.raises(CaseError, match=r"scene\.constraints\.again: .* not independent"):
        start_poses(scenes.parsed(twice))


UPRIGHT = """\
scene:
  gravity: none
  bodies: {stranger: {particle: {mass: 1}}, b: {rigid: {mass: 1.4, inertia: 0.06}}}
  constraints: {blade: {edge: b.center, along: [1, 0]}}
initial: {stranger: {x: 0, y: 5, vx: 1e9, vy: 0}, b: {x: 0, y: 0, angle: ANGLE deg, RATES}}
allow: {b.angle: 1.0e-2}
"""
"""A blade with all its rates, beside what is a billion times as fast."""


def upright(angle: float, rates: str) -> None:
    text = UPRIGHT.replace("ANGLE", f"{angle:g}").replace("RATES", rates)
    start_poses(scenes.parsed(text))


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
    angle: float, rates: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The row is (-1, 6e-17), the velocity (0, 1): both products are rounding."""
    upright(angle, rates)
    monkeypatch.setattr(closure, "product_size", lambda rows, v: np.max(abs(rows * v), initial=0.0))
    with pytest.raises(CaseError, match="the rates violate blade"):
        upright(angle, rates)


@pytest.mark.mutant("rates are compared with those of strangers")
def test_what_slips_by_a_millionth_is_refused_beside_any_stranger(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rates = "vx: 1e-6, vy: 1, omega: 0"
    with pytest.raises(CaseError, match="the rates violate blade"):
        upright(90, rates)
    monkeypatch.setattr(closure, "product_size", lambda rows, v: np.linalg.norm(v))
    upright(90, rates)


def test_a_slot_at_right_angles_may_have_all_its_rates() -> None:
    text = """\
scene:
  gravity: none
  points: {O: [0, 0]}
  bodies: {b: {rigid: {mass: 1.4, inertia: 0.06}}, c: {particle: {mass: 1}}}
  joints: {p: {pin: [ground.O, b.center]}, s: {slot: [b.center, c.center], along: [1, 0]}}
initial: {b: {x: 0, y: 0, angle: 90 deg, vx: 0, vy: 0, omega: 0}, c: {x: 0, y: 1, vx: 0, vy: 0.4}}
allow: {c.y: 1.0e-2}
"""
    start_poses(scenes.parsed(text))


# Starts by a distance and a direction from a point of the ground.

HELD = """\
scene:
  gravity: none
  points:
    O: [0.3, -0.2]
    Q: {at: [1, 2], velocity: [0.5, 0]}
    S: {at: [1, 2], moves: {sine: {amplitude: [0.2, -0.4], angular_frequency: 4, phase: 30 deg}}}
    R: {at: [1, 2], moves: {ramp: [0.2, 0.3]}}
    C: {at: [1, 2], moves: {polynomial: {along: [0.6, 0.8], coefficients: [0.5, 0.1]}}}
  bodies: {rod: {bar: {mass: 1.5, length: 0.6}}}
initial: {rod: {from: ground.POINT, length: 50 cm, direction: 210 deg, angle: 1.0, vx: 1, vy: 0}}
allow: {rod.x: 1.0e-3}
"""


STARTS = {
    "O": (0.3, -0.2), "Q": (1.0, 2.0), "S": (1.1, 1.8), "R": (1.0, 2.0), "C": (1.3, 2.4),
}  # fmt: skip


def off(case: Case, at: tuple[float, float]) -> float:
    """How far [m] the start is from where it should be, for a point that starts there."""
    given, way = case.initial["rod"].given, math.radians(210)
    return math.hypot(
        given["x"] - at[0] - 0.5 * math.cos(way), given["y"] - at[1] - 0.5 * math.sin(way)
    )


@pytest.mark.parametrize(("point", "at"), STARTS.items())
def test_the_centre_is_so_far_in_that_direction(point: str, at: tuple[float, float]) -> None:
    """Of a driven point, from where it starts: that of a sine with a phase is not `at`."""
    case = scenes.parsed(HELD.replace("POINT", point))
    given = case.initial["rod"].given
    assert off(case, at) < 1e-15
    assert {key: given[key] for key in ("angle", "vx", "vy")} == {"angle": 1.0, "vx": 1.0, "vy": 0}
    assert not {"from", "length", "direction"} & given.keys()


@pytest.mark.mutant("a polar start counted from `at` of a point that moves")
@pytest.mark.parametrize("point", ["S", "C"])
def test_a_start_from_at_is_seen(point: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(GroundPoint, "state", lambda self, t: (*self.at, *self.velocity))
    assert off(scenes.parsed(HELD.replace("POINT", point)), STARTS[point]) > 0.1


def test_it_starts_there() -> None:
    x, y, angle, *_ = solve(scenes.parsed(HELD.replace("POINT", "O"))).trajectory.states["rod"][0]
    assert (x - 0.3, y + 0.2) == pytest.approx((-0.25 * math.sqrt(3), -0.25), abs=1e-15)
    assert angle == 1.0


# A homogeneous disk looks alike however it is turned: an angle that is not given is 0.

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


def begun(shape: str = DISK, more: str = "", start: str = THROWN) -> dict[str, float]:
    return dict(thrown(shape, more, start).initial["ball"].given)


def thrown(shape: str = DISK, more: str = "", start: str = THROWN) -> Case:
    more = more.replace("ALONG", "along: [1, 0], across: 2")
    return cases_of(BALL.format(shape=shape, more=more, start=start))[0]


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
def test_it_starts_at_0_where_nothing_depends_on_it(more: str) -> None:
    assert begun(more=more)["angle"] == 0.0


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
def test_it_is_asked_for_where_something_does(shape: str, more: str) -> None:
    assert "angle" not in begun(shape, more)


def test_what_is_given_stays() -> None:
    assert begun(start="{x: 0, y: 1, angle: 30 deg}")["angle"] == pytest.approx(0.5236, 1e-4)


@pytest.mark.mutant("a disk's angle starts at 0 where a joint holds it")
def test_a_joint_decides() -> None:
    blind = otherwise(resolve, "        *scene.joints.values(),\n", "")
    case = thrown(more="  joints: {pin: {pin: [ground.O, ball.P]}}")
    assert "angle" not in case.initial["ball"].given
    assert "angle" in blind._with_free_attitudes(dict(case.initial), case.scene, {})["ball"].given


@pytest.mark.mutant("a disk's angle starts at 0 where a spring winds by it")
def test_what_winds_decides() -> None:
    blind = otherwise(resolve, "not (has_start or winds or driven)", "not (has_start or driven)")
    case = thrown(
        more=f"{AXLE}\n  forces: {{wire: {{torsion: axle, stiffness: 1, rest_angle: 0}}}}"
    )
    assert "angle" not in case.initial["ball"].given
    assert "angle" in blind._with_free_attitudes(dict(case.initial), case.scene, {})["ball"].given


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
def test_so_does_a_sphere(held: str, *, asked: bool) -> None:
    (case,) = cases_of(SPHERE.format(held=held))
    assert (case.initial["ball"].attitude is None) == asked
