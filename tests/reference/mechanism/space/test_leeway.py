"""What rows in space leave open of forces, against statics and against the same in the plane."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from textmech.cases.mistake import CaseError
from textmech.reference import determined
from textmech.reference.mechanism.modes import spatial_mode as spatial
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody, solved, unit_sizes
from textmech.reference.solve import solve
from textmech.reference.start.spatial_closure import SpatialClosure

G = 9.80665
ROUNDED = 1e-9  # of forces of 10 to 100 N
HELD = """\
scene:
  space: 3
  points: {{O: [0, 0, 0], Q: [1, 0, 0]}}
  bodies:
    b: {{block: {{mass: 2.0, size: [1.0, 0.2, 0.1]}}, points: {{l: [-0.5, 0, 0], r: [0.5, 0, 0]}}}}
  joints: {{h: {{{joint}: [ground.O, b.l]{axis}}}, k: {{{joint}: [ground.Q, b.r]{axis}}}}}
initial: {{{initial}}}
allow: {{b.z: 1.0e-3{more}}}
rests: true
"""
HINGES = {"joint": "hinge", "axis": ", axis: [1, 0, 0]", "initial": "h: {angle: 0}"}
UPRIGHT = "attitude: {axis: [1, 0, 0], angle: 0}"
BALLS = {"joint": "ball", "axis": "", "initial": f"b: {{{UPRIGHT}}}"}
INFINITE = (-math.inf, math.inf)


def mode(tmp_path: Path, text: str) -> Any:
    """A scene's mode, wherever its start would be refused."""
    scene: Any = scenes.typed(tmp_path, text).scene
    return SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))


def placed(found: Any, poses: dict[str, Any]) -> tuple[Any, Any]:
    """Poses of no rates."""
    return found.where.place({name: (*pose, *[0.0] * 6) for name, pose in poses.items()})


BETWEEN = {"b": (0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)}


def test_between_two_balls_only_what_is_along_their_line_is_open(tmp_path: Path) -> None:
    """Six rows, of which five are independent: each ball carries half of the weight."""
    found = mode(tmp_path, HELD.format(**BALLS, more=""))
    leeway = found.leeway(0.0, *placed(found, BETWEEN))
    assert len(leeway.ways) == 1
    for ball in "hk":
        assert leeway.span(f"{ball}.fx") == INFINITE
        assert leeway.span(f"{ball}.fy") == pytest.approx((0.0, 0.0), abs=ROUNDED)
        assert leeway.span(f"{ball}.fz") == pytest.approx((G, G), abs=ROUNDED)


@pytest.mark.parametrize("seed", [1, 2, 3])
def test_in_any_attitude_rounding_makes_no_rank(tmp_path: Path, seed: int) -> None:
    """What two balls leave open is along their line, wherever it points."""
    e = np.random.default_rng(seed).standard_normal(4)
    found = mode(tmp_path, HELD.format(**BALLS, more=""))
    q, v = placed(found, {"b": (0.0, 0.0, 0.0, *(e / np.linalg.norm(e)))})
    leeway = found.leeway(0.0, q, v)
    (way,) = leeway.ways
    force = np.array([way[f"h.{x}"] - leeway.one[f"h.{x}"] for x in ("fx", "fy", "fz")])
    line = Rotation.from_quat(e, scalar_first=True).as_matrix()[:, 0]
    np.testing.assert_allclose(np.cross(force, line), 0.0, atol=ROUNDED)


def test_of_two_hinges_about_one_line_neither_has_a_share(tmp_path: Path) -> None:
    """Ten rows, of which five are independent; a hinge never turns about its line."""
    found = mode(tmp_path, HELD.format(**HINGES, more=""))
    leeway = found.leeway(0.0, *placed(found, BETWEEN))
    assert len(leeway.ways) == 5
    for hinge in "hk":
        for force in ("fx", "fy", "fz", "my", "mz"):
            assert leeway.span(f"{hinge}.{force}") == INFINITE
        assert leeway.span(f"{hinge}.mx") == (0.0, 0.0)


TABLE = """\
scene:
  space: 3
  bodies:
    b:
      rigid: {mass: 3.0, inertia: [0.1, 0.1, 0.15, 0, 0, 0]}
      points:
        {p0: [-0.4, -0.3, -0.5], p1: [0.5, -0.3, -0.5], p2: [0.5, 0.4, -0.5], p3: [-0.4, 0.4, -0.5]}
  contacts:
    c0: {between: [b.p0, ground.floor], friction: 0.5, ideal: pivot}
    c1: {between: [b.p1, ground.floor], friction: 0.5, ideal: pivot}
    c2: {between: [b.p2, ground.floor], friction: 0.5, ideal: pivot}
    c3: {between: [b.p3, ground.floor], friction: 0.5, ideal: pivot}
initial: {b: {x: 0, y: 0, z: 0.5, attitude: {axis: [1, 0, 0], angle: 0}}}
allow: {b.z: 1.0e-3}
rests: true
"""
FEET = [(-0.4, -0.3), (0.5, -0.3), (0.5, 0.4), (-0.4, 0.4)]


@pytest.mark.parametrize("foot", range(4))
def test_a_table_on_four_feet_has_intervals(tmp_path: Path, foot: int) -> None:
    """A second statics: Σ N = m g and no moment, with N ≥ 0 of each."""
    found = mode(tmp_path, TABLE)
    pose = {"b": (0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0)}
    low, high = found.leeway(0.0, *placed(found, pose)).span(f"c{foot}.normal")
    programme: Any = linprog
    each = [[1.0] * 4, [x for x, _ in FEET], [y for _, y in FEET]]
    known = [
        sense * programme(sense * np.eye(4)[foot], A_eq=each, b_eq=[3.0 * G, 0.0, 0.0]).fun
        for sense in (1.0, -1.0)
    ]
    assert high - low > 1.0
    assert (low, high) == pytest.approx(tuple(known), abs=1e-7)  # as programmes keep their bounds


PLANAR = """\
scene:
  points: {{O: [0, 0], Q: [{x!r}, {y!r}]}}
  bodies: {{{bars}}}
  joints: {{{pins}}}
initial: {{a: {{angle: 0.7}}, c: {{angle: 0.1}}, r: {{angle: -0.9}}}}
allow: {{a.angle: 1.0e-3}}
"""


def test_a_plane_loop_of_hinges_in_space_moves_as_in_the_plane(tmp_path: Path) -> None:
    """Twenty rows, of which seventeen are independent; forces in the plane have one value."""
    bars = {"a": (0.4, 0.7), "c": (0.7, 0.1), "r": (0.5, -0.9)}
    joints = {"j0": "ground.O, a.start", "j1": "a.end, c.start", "j2": "c.end, r.start"}
    joints["j3"] = "r.end, ground.Q"
    at, centres = np.zeros(2), {}
    for name, (length, angle) in bars.items():
        half = length / 2 * np.array([math.cos(angle), math.sin(angle)])
        centres[name], at = at + half, at + 2 * half
    pins = ", ".join(f"{name}: {{pin: [{both}]}}" for name, both in joints.items())
    bodies = ", ".join(
        f"{name}: {{block: {{mass: 1.5, width: {length}, height: 0.1}}, "
        f"points: {{start: [{-length / 2}, 0], end: [{length / 2}, 0]}}}}"
        for name, (length, _) in bars.items()
    )
    x, y = at.tolist()
    flat = scenes.mechanism(
        scenes.typed(tmp_path, PLANAR.format(x=x, y=y, bars=bodies, pins=pins))
    ).base
    poses = {n: (*centres[n], angle, 0.0, 0.0, 0.0) for n, (_, angle) in bars.items()}
    q, v = flat.place(poses)
    known, told = flat.accelerations(0.0, q, v), flat.reactions(0.0, q, v)

    hinges = ", ".join(
        f"{name}: {{hinge: [{both}], axis: [0, 0, 1]}}" for name, both in joints.items()
    )
    solid = ", ".join(
        f"{name}: {{block: {{mass: 1.5, size: [{length}, 0.1, 0.2]}}, "
        f"points: {{start: [{-length / 2}, 0, 0], end: [{length / 2}, 0, 0]}}}}"
        for name, (length, _) in bars.items()
    )
    found = mode(
        tmp_path,
        f"scene:\n  space: 3\n  gravity: [0, -9.80665, 0]\n"
        f"  points: {{O: [0, 0, 0], Q: [{x!r}, {y!r}, 0]}}\n  bodies: {{{solid}}}\n"
        f"  joints: {{{hinges}}}\ninitial: {{j0: {{angle: 0.7}}}}\nallow: {{a.x: 1.0e-3}}\n",
    )
    in_space = {
        n: (*centres[n], 0.0, math.cos(angle / 2), 0.0, 0.0, math.sin(angle / 2))
        for n, (_, angle) in bars.items()
    }
    q, v = placed(found, in_space)
    rows, _, gamma = found.rows(0.0, q, v)
    sizes = unit_sizes(found.where)
    applied = found.applied(0.0, q, v)
    a, _, ways = solved(found.where.M, rows, gamma, applied, sizes)
    assert len(ways) == 3
    np.testing.assert_allclose(a.reshape(3, 6)[:, [0, 1, 5]].ravel(), known, atol=ROUNDED)
    leeway = found.leeway(0.0, q, v)
    for name in joints:
        for force in ("fx", "fy"):
            own = told[f"{name}.{force}"]
            assert leeway.span(f"{name}.{force}") == pytest.approx((own, own), abs=ROUNDED)
        assert leeway.span(f"{name}.fz") == INFINITE


def held_anyhow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets a start pass that holds something twice, and solves its motion by rank."""

    def by_rank(self: Any, t: float, q: Any, v: Any) -> Any:
        rows, _, gamma = self.rows(t, q, v)
        applied = self.applied(t, q, v)
        return solved(self.where.M, rows, gamma, applied, unit_sizes(self.where))[:2]

    monkeypatch.setattr(SpatialClosure, "dependent", lambda *_: None)
    monkeypatch.setattr(SpatialMultibody, "solve", by_rank)


@pytest.mark.slow
@pytest.mark.parametrize(("kinds", "force"), [(HINGES, "h.fz"), (HINGES, "k.my"), (BALLS, "h.fx")])
def test_a_case_that_asks_for_an_open_force_is_refused_as_in_the_plane(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, kinds: dict[str, str], force: str
) -> None:
    """Its start is refused before; without that, the forces are."""
    case = scenes.typed(
        tmp_path, HELD.format(**kinds, more=f", {force}: 1.0"), tail=scenes.tail(0.1, 3)
    )
    with pytest.raises(CaseError, match="the constraints are not independent"):
        solve(case)
    held_anyhow(monkeypatch)
    with pytest.raises(CaseError, match=rf"{force}: anything, in N") as refused:
        solve(case)
    assert [mistake.where for mistake in refused.value.mistakes] == [f"allow.{force}"]


@pytest.mark.slow
@pytest.mark.mutant("rows in space that repeat each other counted as independent")
def test_an_open_force_taken_for_determined_is_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is not told as what it is, and its motion has equations that are singular."""
    held_anyhow(monkeypatch)
    monkeypatch.setattr(spatial, "independent", lambda rows, _: len(rows))
    text = HELD.format(**HINGES, more=", h.fz: 1.0")
    with pytest.raises(CaseError) as refused:
        solve(scenes.typed(tmp_path, text, tail=scenes.tail(0.1, 3)))
    assert "anything" not in str(refused.value)


ONE = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies: {b: {block: {mass: 2.0, size: [1.0, 0.2, 0.1]}, points: {l: [-0.5, 0, 0]}}}
  joints: {h: {hinge: [ground.O, b.l], axis: [0, 1, 0]}}
initial: {h: {angle: 0.3}}
allow: {b.z: 1.0e-3, h.fz: 1.0e-1}
"""


@pytest.mark.slow
def test_forces_that_have_one_value_are_certified(tmp_path: Path) -> None:
    case = scenes.typed(tmp_path, ONE, tail=scenes.tail(0.2, 5))
    (row,) = [check for check in solve(case).checks if check.name == determined.NAME]
    assert row.difference == 0.0
