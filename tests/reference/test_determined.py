"""Forces that statics does not decide are told as an interval: a second statics stands here.

It knows points, planes and cones, and nothing of rows of a mechanism: each force's least and
largest value is a linear programme over the components of all contact forces.
"""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from given.laws.refused import refused
from given.laws.statics import spans
from scipy.integrate import solve_ivp

from textmech.cases.case import Case
from textmech.reference import determined
from textmech.reference.mechanism.modes import loose
from textmech.reference.mechanism.modes.modes import Modes
from textmech.reference.solve import solve

G = 9.80665
LADDER = """\
scene:
  planes: {{wall: {{at: [0, 0], normal: [1, 0]}}}}
  bodies: {{rod: {{bar: {{mass: {m!r}, length: {l!r}}}}}}}
  contacts:
    foot: {{between: [rod.end, ground.floor], friction: {mu!r}}}
    top: {{between: [rod.start, ground.wall], friction: {nu!r}}}
initial: {{rod: {{angle: {angle!r}, on: [end, start]}}}}
allow: {{rod.angle: 1.0e-3{more}}}
"""
FORCES = ("foot.normal", "foot.tangent", "top.normal", "top.tangent")


def ladder(
    tmp_path: Path, angle: float, mu: float, nu: float, *, m: float = 5.0, length: float = 3.0,
    more: str = "", rests: bool = False, until: float = 0.4,
) -> Case:  # fmt: skip
    text = LADDER.format(angle=angle, mu=mu, nu=nu, m=m, l=length, more=more)
    return scenes.typed(tmp_path, text + "rests: true\n" * rests, tail=scenes.tail(until, 11))


def leaning(angle: float, mu: float, nu: float, m: float) -> Any:
    """The same of a ladder between the floor and a wall at x = 0."""
    x, y = math.cos(angle), -math.sin(angle)  # of lengths, and forces of weights
    points = [((x, 0.0), (0.0, 1.0)), ((0.0, y), (1.0, 0.0))]
    found = spans(points, (mu, nu), (0.0, -1.0, -x / 2))
    return found and [(low * m * G, high * m * G) for low, high in found]


def slides(angle: float, mu: float, nu: float, length: float, until: float) -> float:
    """The angle at the end, from rest: Newton's and Euler's equations of a ladder that slides."""

    def turn(phi: float, omega: float) -> float:
        c, s, r = math.cos(phi), math.sin(phi), length / 2
        # unknown: φ̈, N, W of unit mass; r_c = r (c, −s), the foot's friction −μ N, the wall's ν W
        A = [
            [-r * s, mu, -1.0],
            [-r * c, -1.0, -nu],
            [length**2 / 12, -r * c - r * s * mu, -r * s + r * c * nu],
        ]
        b = [r * c * omega**2, -G - r * s * omega**2, 0.0]
        return float(np.linalg.solve(A, b)[0])

    found = solve_ivp(
        lambda t, y: [y[1], turn(*y)], (0, until), [angle, 0.0], method="DOP853", rtol=1e-12,
        atol=1e-13,
    )  # fmt: skip
    return float(found.y[0, -1])


@pytest.mark.slow
@pytest.mark.parametrize("angle", [-0.7, -0.81, -0.9, -0.955, -0.96, -0.961, -1.0, -1.2])
@pytest.mark.parametrize(("mu", "nu"), [(0.4, 0.4), (0.2, 0.2), (0.5, 0.1), (0.35, 0.9)])
def test_a_ladder_rests_where_some_forces_hold_it_and_slides_elsewhere(
    tmp_path: Path, angle: float, mu: float, nu: float
) -> None:
    """It may rest if tan φ ≥ (1 − μ²)/(2 μ), of two frictions (1 − μ ν)/(2 μ).

    And it slides with both ends until its top leaves the wall, which takes longer.
    """
    held = leaning(angle, mu, nu, 5.0)
    assert (held is not None) == (math.tan(-angle) >= (1 - mu * nu) / (2 * mu))
    found = solve(ladder(tmp_path, angle, mu, nu, rests=held is not None))
    assert found.holds
    end = float(found.trajectory.states["rod"][-1, 2])
    known = angle if held else slides(angle, mu, nu, 3.0, 0.4)
    assert end == pytest.approx(known, abs=1e-10)


@pytest.mark.slow
@pytest.mark.parametrize("size", [1e-6, 1.0, 1e3])
@pytest.mark.parametrize("name", FORCES)
def test_its_forces_are_refused_with_their_interval(tmp_path: Path, name: str, size: float) -> None:
    """At every scale: a needle of a milligram, and a bridge of tonnes."""
    angle, mu, m, length = -0.96, 0.4, 5.0 * size**2, 3.0 * size
    case = ladder(tmp_path, angle, mu, mu, m=m, length=length, more=f", {name}: 1", rests=True)
    mistake = refused(case)
    assert mistake.where == f"allow.{name}"
    low, high = leaning(angle, mu, mu, m)[FORCES.index(name)]
    assert f"{name}: anything from {low:.4g} to {high:.4g} N" in mistake.what


@pytest.mark.slow
def test_one_value_that_the_cones_leave_is_certified(tmp_path: Path) -> None:
    """At the least angle at which it may rest both frictions are all that there is."""
    mu, nu = 0.4, 0.3
    angle = -math.atan((1 - mu * nu) / (2 * mu)) - 1e-10
    more = ", foot.normal: 1.0e-3, top.tangent: 1.0e-3"
    found = solve(ladder(tmp_path, angle, mu, nu, more=more, rests=True))
    assert found.holds
    N = 5.0 * G / (1 + mu * nu)
    forces = found.trajectory.reactions
    assert forces["foot.normal"][0] == pytest.approx(N, rel=1e-7)
    assert forces["top.tangent"][0] == pytest.approx(-nu * mu * N, rel=1e-7)


CORNER = """\
scene:
  planes: {wall: {at: [0, 0], normal: [1, 0]}}
  bodies: {p: {particle: {mass: 2.0}}}
  contacts:
    floor: {between: [p, ground.floor], friction: 0.4}
    wall: {between: [p, ground.wall], friction: 0.3}
  forces: {hand: {push: p.center, constant: [-12, 0]}}
initial: {p: {x: 0, y: 0}}
rests: true
allow: {p.x: 1.0e-3"""


@pytest.mark.slow
@pytest.mark.parametrize(
    ("k", "name"), [*enumerate(("floor.normal", "floor.tangent", "wall.normal"))]
)
def test_a_particle_between_a_wall_and_a_rough_floor(tmp_path: Path, k: int, name: str) -> None:
    """None of the shares of the force is the one."""
    points = [((0.0, 0.0), (0.0, 1.0)), ((0.0, 0.0), (1.0, 0.0))]
    known = spans(points, (0.4, 0.3), (-12.0, -2.0 * G, 0.0))
    assert known is not None
    low, high = known[k]
    mistake = refused(scenes.typed(tmp_path, f"{CORNER}, {name}: 1.0}}\n"))
    assert f"{name}: anything from {low:.4g} to {high:.4g} N" in mistake.what
    assert solve(scenes.typed(tmp_path, CORNER + "}\n")).holds


THREE = """\
scene:
  bodies: {b: {block: {mass: 2.0, width: 1.5, height: 0.5}, points: {m: [0.1, -0.25]}}}
  contacts:
    l: {between: [b.lower_left, ground.floor], friction: 0.4}
    r: {between: [b.lower_right, ground.floor], friction: 0.4}
    m: {between: [b.m, ground.floor], friction: 0.4}
  forces: {hand: {push: b.center, ramp: [6, 0]}}
initial: {b: {x: 0, y: 0.25, angle: 0}}
allow: {b.x: 1.0e-3"""


@pytest.mark.slow
def test_three_points_on_one_plane_slide_when_their_sum_is_spent(tmp_path: Path) -> None:
    """At 6 t = μ m g, whoever bears how much; x = (t − t₀)³/2 then."""
    found = solve(scenes.typed(tmp_path, THREE + "}\n", tail=scenes.tail(2.0, 41)))
    assert found.holds
    (breaks,) = found.trajectory.switches
    assert breaks == pytest.approx(0.4 * 2.0 * G / 6, abs=1e-10)
    x = found.trajectory.states["b"][-1, 0]
    assert x == pytest.approx((2.0 - breaks) ** 3 / 2, abs=1e-10)
    mistake = refused(scenes.typed(tmp_path, f"{THREE}, m.normal: 1.0}}\n"))
    assert mistake.where == "allow.m.normal"


ON_A_HINGE = """\
scene:
  points: {O: [0, 0]}
  bodies: {b: {bar: {mass: 2.0, length: 1.5}}, p: {bar: {mass: 1.0, length: 0.5}}}
  joints: {h: {pin: [ground.O, b.start]}, k: {pin: [b.center, p.start]}}
  contacts: {tip: {between: [b.end, ground.floor], friction: 0.4}}
initial: {b: {angle: 0}, p: {angle: 20 deg}}
allow: {p.angle: 1.0e-3"""


@pytest.mark.slow
@pytest.mark.mutant("forces that statics leaves open taken for determined")
def test_what_is_open_and_is_taken_for_one_value_fails_by_itself(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The row of the certificate is red, without the refusal before it."""
    monkeypatch.setattr(determined, "POINT", 1e300)
    case = ladder(tmp_path, -0.96, 0.4, 0.4, more=", foot.normal: 0.5", rests=True)
    (row,) = [check for check in solve(case).checks if check.name == determined.NAME]
    assert row.difference > 0.1
    monkeypatch.undo()
    assert refused(case).where == "allow.foot.normal"


@pytest.mark.mutant("rows that depend on each other counted by a pivot's rounding")
def test_a_rank_that_rounding_decides_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """With a bar of 0 all six rows of two bars are independent, or nearly."""
    monkeypatch.setattr(loose, "DEPENDENT", 0.0)
    case = scenes.typed(tmp_path, f"{ON_A_HINGE}, h.fx: 0.1}}\n", tail=scenes.tail(0.3, 13))
    assert "statics does not decide" not in refused(case).what


BESIDE_SMOOTH = """\
scene:
  points: {O: [0, 3]}
  bodies:
    box: {block: {mass: 2, width: 0.4, height: 0.2}}
    cart: {particle: {mass: 1}}
  joints:
    rail:
      slide: [ground.O, cart.center]
      along: [1, 0]
      dry_friction: {static: 1, kinetic: 1, smooth: {band: 0.05, sharpness: 100}}
  contacts:
    left: {between: [box.lower_left, ground.floor], friction: 0.5}
    right: {between: [box.lower_right, ground.floor], friction: 0.5}
  forces: {hand: {push: box.center, sine: {amplitude: [3, 0], angular_frequency: 4}}}
initial: {box: {x: 0, y: 0.1, angle: 0}, cart: {x: 0, vx: 1}}
"""


@pytest.mark.slow
@pytest.mark.mutant("forces left open beside smooth friction taken for determined")
def test_beside_smooth_friction_too_a_shared_friction_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Each corner carries half of the weight, and rubs by any part of μ m g/2."""
    tail = scenes.tail(0.2, 11)
    shared = BESIDE_SMOOTH + "allow: {cart.x: 1, left.tangent: 1}\n"
    most = f"{0.5 * 2 * G / 2:.4g}"
    said = refused(scenes.typed(tmp_path, shared, tail=tail)).what
    assert f"left.tangent: anything from -{most} to {most} N" in said
    normal = BESIDE_SMOOTH + "allow: {cart.x: 1, right.normal: 1}\n"
    assert solve(scenes.typed(tmp_path, normal, tail=tail)).holds
    monkeypatch.setattr(Modes, "leeway", lambda *_: None)
    assert solve(scenes.typed(tmp_path, shared, tail=tail)).holds
