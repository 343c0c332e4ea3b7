"""The equations in space: digits, calls, and what they leave open of forces."""

import math
import sys
from types import FrameType
from typing import Any, cast

import numpy as np
import pytest
from given import scenes
from given.machines.skew_chain import chain
from scipy.optimize import linprog
from scipy.spatial.transform import Rotation

from textmech.cases.mistake import CaseError
from textmech.reference import determined
from textmech.reference.mechanism.constraints.equation_table import Table
from textmech.reference.mechanism.modes import spatial_mode as equations
from textmech.reference.mechanism.modes import spatial_mode as spatial
from textmech.reference.mechanism.modes.spatial_mode import (
    Equations,
    SpatialMultibody,
    solved,
    unit_sizes,
)
from textmech.reference.solve import solve
from textmech.reference.start.spatial_closure import SpatialClosure

N, R = 12, 7
EVEN, SLENDER = np.diag([0.02, 0.03, 0.04]), np.diag([0.02, 0.02, 1e-13])


def lost(**given: Any) -> float:
    """The largest error of v̇ or λ, relative to them, of four sets of rows."""
    return max(lost_of(np.random.default_rng(seed), **given) for seed in range(4))


def lost_of(
    random: np.random.Generator, *, J: Any = EVEN, mass: float = 1.0, apart: float = 1.0
) -> float:
    """The last two rows may be nearly one."""
    M = np.zeros((N, N))
    for at, block in ((0, mass * np.eye(3)), (3, J), (6, np.eye(3)), (9, EVEN)):
        M[at : at + 3, at : at + 3] = block
    rows, Q, gamma = random.normal(size=(R, N)), random.normal(size=N), random.normal(size=R)
    rows[-1], gamma[-1] = rows[-2] + apart * rows[-1], gamma[-2] + apart * gamma[-1]
    found = Equations(M, np.array([J, EVEN]), R).solve(rows, gamma, Q)
    known = np.split(refined(np.block([[M, -rows.T], [rows, np.zeros((R, R))]]), Q, gamma), [N])
    return max(
        float(np.max(np.abs(x - y)) / np.max(np.abs(y))) for x, y in zip(found, known, strict=True)
    )


def refined(matrix: Any, *right: Any) -> Any:
    """Refined by residuals of 80 bits."""
    long, wanted = matrix.astype(np.longdouble), np.concatenate(right).astype(np.longdouble)
    x = np.zeros_like(wanted)
    for _ in range(10):
        x = x + np.linalg.solve(matrix, (wanted - long @ x).astype(float))
    return x


CASES: list[tuple[dict[str, Any], float]] = [
    ({}, 2e-15),
    ({"J": SLENDER}, 2e-15),
    ({"J": np.diag([0.02, 0.02, 0.0])}, 2e-15),  # a neighbour keeps it from turning about itself
    ({"J": 1e-10 * EVEN}, 2e-15),
    ({"mass": 1e-10}, 2e-15),
    ({"mass": 1e10}, 2e-15),
    # ε / apart is 2e-10: up to ten of it on six processors; who trusts its pivots loses 2e-5.
    ({"apart": 1e-6}, 1e-8),
]


@pytest.mark.parametrize(("given", "bound"), CASES)
def test_no_more_is_lost_than_must_be(given: dict[str, Any], bound: float) -> None:
    assert lost(**given) < bound


def test_a_free_body_has_no_multipliers() -> None:
    free = Equations(np.diag([2.0] * 3), np.zeros((0, 3, 3)), 0)
    a, multipliers = free.solve(np.zeros((0, 3)), np.zeros(0), np.ones(3))
    np.testing.assert_array_equal(a, 0.5)
    assert multipliers.shape == (0,)


@pytest.mark.mutant("pivots of the equations in space trusted however narrow")
@pytest.mark.parametrize("case", [1, 3, 4, 6])
def test_narrow_pivots_are_not_trusted(case: int, monkeypatch: pytest.MonkeyPatch) -> None:
    given, bound = CASES[case]
    monkeypatch.setattr(equations, "NARROW", 0.0)
    assert lost(**given) > 10 * bound


@pytest.mark.mutant("equations in space without refinement")
def test_without_refinement_digits_are_lost(monkeypatch: pytest.MonkeyPatch) -> None:
    kept = lost(mass=1e-3)
    monkeypatch.setattr(equations, "TURNS", 0)
    assert lost(mass=1e-3) > 3 * kept


MOST = 37  # it is 31, and 43 where the table is filled for each who asks


def calls() -> int:
    """Of functions, in one right side of five bodies."""
    mode = SpatialMultibody(chain(), (np.zeros(0), np.zeros(0)))
    q, v = np.zeros(len(mode.coordinates)), np.linspace(-1.0, 1.0, mode.where.size)
    for at in mode.where.slots.values():
        assert at.attitude is not None
        q[at.attitude] = 1.0
    mode.accelerations(0.0, q, v)  # what is kept from the first on is not counted
    counted: list[str] = []

    def note(frame: FrameType, event: str, _: object) -> None:
        noting = frame.f_code.co_name == "noted"  # which equations run
        if event in ("call", "c_call") and not noting:
            counted.append(event)

    before = sys.getprofile()
    sys.setprofile(note)
    try:
        mode.accelerations(0.0, q, v)
    finally:
        sys.setprofile(before)
    return len(counted)


def test_five_bodies_cost_little() -> None:
    assert calls() < MOST


def test_a_table_that_is_filled_for_each_who_asks_would_be_seen(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    once = Table.numbers

    def again(self: Table, *given: object) -> object:
        self._at = None  # what was found at this state is forgotten
        return once(self, *given)

    monkeypatch.setattr(Table, "numbers", again)
    assert calls() > MOST


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


def mode(text: str) -> Any:
    """A scene's mode, wherever its start would be refused."""
    scene: Any = scenes.parsed(text).scene
    return SpatialMultibody(scene, (np.zeros(0), np.zeros(0)))


def placed(found: Any, poses: dict[str, Any]) -> tuple[Any, Any]:
    """Poses of no rates."""
    return found.where.place({name: (*pose, *[0.0] * 6) for name, pose in poses.items()})


BETWEEN = {"b": (0.5, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0)}


def test_between_two_balls_only_what_is_along_their_line_is_open() -> None:
    """Six rows, of which five are independent: each ball carries half of the weight."""
    found = mode(HELD.format(**BALLS, more=""))
    leeway = found.leeway(0.0, *placed(found, BETWEEN))
    assert len(leeway.ways) == 1
    for ball in "hk":
        assert leeway.span(f"{ball}.fx") == INFINITE
        assert leeway.span(f"{ball}.fy") == pytest.approx((0.0, 0.0), abs=ROUNDED)
        assert leeway.span(f"{ball}.fz") == pytest.approx((G, G), abs=ROUNDED)


def test_in_any_attitude_rounding_makes_no_rank() -> None:
    """What two balls leave open is along their line, wherever it points."""
    e = np.random.default_rng(1).standard_normal(4)
    found = mode(HELD.format(**BALLS, more=""))
    q, v = placed(found, {"b": (0.0, 0.0, 0.0, *(e / np.linalg.norm(e)))})
    leeway = found.leeway(0.0, q, v)
    (way,) = leeway.ways
    force = np.array([way[f"h.{x}"] - leeway.forces[f"h.{x}"] for x in ("fx", "fy", "fz")])
    line = Rotation.from_quat(e, scalar_first=True).as_matrix()[:, 0]
    np.testing.assert_allclose(np.cross(force, line), 0.0, atol=ROUNDED)


def test_of_two_hinges_about_one_line_neither_has_a_share() -> None:
    """Ten rows, of which five are independent; a hinge never turns about its line."""
    found = mode(HELD.format(**HINGES, more=""))
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


def test_a_table_on_four_feet_has_intervals() -> None:
    """A second statics: Σ N = m g and no moment, with N ≥ 0 of each."""
    found = mode(TABLE)
    pose = {"b": (0.0, 0.0, 0.5, 1.0, 0.0, 0.0, 0.0)}
    leeway, programme = found.leeway(0.0, *placed(found, pose)), cast(Any, linprog)
    each = [[1.0] * 4, [x for x, _ in FEET], [y for _, y in FEET]]
    for foot, alone in enumerate(np.eye(4)):
        low, high = leeway.span(f"c{foot}.normal")
        known = [
            sense * programme(sense * alone, A_eq=each, b_eq=[3.0 * G, 0.0, 0.0]).fun
            for sense in (1.0, -1.0)
        ]
        assert high - low > 1.0
        assert (low, high) == pytest.approx(tuple(known), abs=1e-7)  # as programmes keep bounds


def held_anyhow(monkeypatch: pytest.MonkeyPatch) -> None:
    """Lets a start pass that holds something twice, and solves its motion by rank."""

    def by_rank(self: Any, t: float, q: Any, v: Any) -> Any:
        rows, _, gamma = self.rows(t, q, v)
        applied = self.applied(t, q, v)
        return solved(self.where.M, rows, gamma, applied, unit_sizes(self.where))[:2]

    monkeypatch.setattr(SpatialClosure, "dependent", lambda *_: None)
    monkeypatch.setattr(SpatialMultibody, "solve", by_rank)


@pytest.mark.slow
@pytest.mark.parametrize(("kinds", "force"), [(HINGES, "k.my"), (BALLS, "h.fx")])
def test_a_case_that_asks_for_an_open_force_is_refused_as_in_the_plane(
    monkeypatch: pytest.MonkeyPatch, kinds: dict[str, str], force: str
) -> None:
    """Its start is refused before; without that, the forces are."""
    case = scenes.parsed(HELD.format(**kinds, more=f", {force}: 1.0"), tail=scenes.tail(0.1, 3))
    with pytest.raises(CaseError, match="the constraints are not independent"):
        solve(case)
    held_anyhow(monkeypatch)
    with pytest.raises(CaseError, match=rf"{force}: anything, in N") as refused:
        solve(case)
    assert [mistake.where for mistake in refused.value.mistakes] == [f"allow.{force}"]


@pytest.mark.slow
@pytest.mark.mutant("rows in space that repeat each other counted as independent")
def test_an_open_force_taken_for_determined_is_seen(monkeypatch: pytest.MonkeyPatch) -> None:
    """It is not told as what it is, and its motion has equations that are singular."""
    held_anyhow(monkeypatch)
    monkeypatch.setattr(spatial, "independent", lambda rows, _: len(rows))
    text = HELD.format(**HINGES, more=", h.fz: 1.0")
    with pytest.raises(CaseError) as refused:
        solve(scenes.parsed(text, tail=scenes.tail(0.1, 3)))
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
def test_forces_that_have_one_value_are_certified() -> None:
    case = scenes.parsed(ONE, tail=scenes.tail(0.2, 5))
    (row,) = [check for check in solve(case).checks if check.name == determined.NAME]
    assert row.difference == 0.0
