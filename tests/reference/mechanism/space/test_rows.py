"""Rows in space: rates of their places, blades, and driven freedoms whose axes are skew."""

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import scenes
from scipy.spatial.transform import Rotation

from textmech.reference.formalisms.derivative import along
from textmech.reference.mechanism.constraints import joint_constraints
from textmech.reference.mechanism.constraints.constraint_terms import (
    FIRST,
    SECOND,
    Heading,
    Turn,
)
from textmech.reference.mechanism.kinematics.kinematics import Direction
from textmech.reference.mechanism.modes.spatial_mode import SpatialMultibody
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.start.assembly import assemble
from textmech.reference.system import Array
from textmech.reference.systems import written

T = 0.13  # s: laws in time are neither at zero nor at rest


@pytest.mark.mutant("a row that goes upward is divided by the shadow of its stand-in")
def test_a_height_is_kept_while_the_x_axis_of_its_body_stands_upright() -> None:
    """The blade's long axis is another one, and lies level then."""
    case = scenes.SHIPPED["robot_knife"]
    own = case.scene
    (name, edge), *_ = own.constraints.items()
    scene = replace(own, constraints={name: replace(edge, along=(0.0, 1.0, 0.0))})
    mode = SpatialMultibody(scene, assemble(replace(case, scene=own)))
    q, v = mode.start()
    first = 7 * [*scene.bodies].index(edge.at.body)
    q[first + 3 : first + 7] = np.sqrt([0.5, 0.0, 0.5, 0.0])  # about y, by a right angle
    with np.errstate(all="raise"):
        f_a, _, gamma = mode.rows(T, q, v)
    assert np.isfinite(f_a).all()
    assert np.isfinite(gamma).all()


KNIFE = scenes.SHIPPED["robot_knife"]
OWN = [-2, -1]  # the rows of the blade come last: to the side, and upward


def generated() -> SpatialMultibody:
    """The only mode of the scene's mechanism."""
    scene = KNIFE.scene
    return SpatialMultibody(scene, assemble(KNIFE))


def worst() -> float:
    """(2.15) f_a v̇ = γ is d/dt of f_a v = g, at the start and rates that do not obey f_a v = g."""
    mode = generated()
    q, v = mode.start()
    v = v + np.random.default_rng(1).normal(size=len(v))
    _, _, gamma = mode.rows(0.0, q, v)
    rates = mode.rates(0.0, q, v)
    slopes = along(lambda q: mode.rows(0.0, q, v)[0][OWN] @ v, (q,), (rates,))
    return float(abs(gamma[OWN] + slopes).max() / abs(gamma[OWN]).max())


def reactions() -> float:
    """The blade's forces, against those of the system that is written by hand [N]."""
    system = written("robot_knife", KNIFE.parameters)
    mode = generated()
    own, q, v = system.start()
    held = system.modes[own].reactions(0.0, q, v)
    place = mode.place(system.modes[own].poses(0.0, q, v))
    found = mode.reactions(0.0, *place)
    return max(abs(found[name] - held[name]) for name in ("blade.force", "blade.normal"))


def test_rows_are_differentiated_rightly() -> None:
    assert worst() < 1e-12  # of the largest: algebra, only rounding differs


def test_forces_are_those_of_the_system_written_by_hand() -> None:
    assert reactions() < 1e-11  # N, of 200 N in the joints


left = Heading._left


def backward(self: Any, k: Any, ends: Any) -> Direction:
    """Its rate with the wrong sign."""
    c = left(self, k, ends)
    return Direction(c.u, -c.u_dot)


def carried_along(self: Any, k: Any, ends: Any) -> Direction:
    """u as if it were fixed in the body, so that it tilts with it."""
    c = left(self, k, ends)
    return Direction(c.u, k.frame.cross(ends[self.p].part.spin, c.u))


def to_the_right(self: Any, k: Any, ends: Any) -> Direction:
    """To the right, for to the left."""
    c = left(self, k, ends)
    return Direction(-c.u, -c.u_dot)


@pytest.mark.mutant("direction of a blade in space: {wrong}")
@pytest.mark.parametrize(
    ("wrong", "law"), [(backward, worst), (carried_along, worst), (to_the_right, reactions)]
)
def test_a_planted_mistake_is_seen(
    wrong: Callable[..., Any], law: Callable[[], float], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(Heading, "_left", wrong)
    assert law() > 1e-3


KNOWN = 1e-12  # m and rad after 2 s: a few hundred steps
SKEW = """\
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
    base: {rigid: {mass: 1.3, inertia: [0.2, 0.3, 0.25, 0, 0, 0]}, points: {P: [0.1, 0.2, 0.3]}}
    tip: {rigid: {mass: 0.7, inertia: [0.1, 0.2, 0.15, 0.02, 0, 0]}, points: {P: [0.3, 0, 0.1]}}
  joints:
    stand: {hinge: [ground.O, base.center], axis: [1, 2, 2]}
    j: {freedoms: {FREEDOMS}, of: [base.P, tip.P]}
  drive: {j.RATE: LAW}
initial: {stand: {angle: 0.2, omega: 1.0}, j: {GIVEN}}
allow: {tip.x: 1.0}
"""
TURNS = "a: {hinge: [0, 0, 1]}, b: {hinge: [1, 0, 1]}"
SHIFTS = "s: {slide: [1, 0, 0]}, u: {slide: [1, 0, 1]}"
RATE_LAW = "{polynomial: {coefficients: [0.4, 0.3, -0.5]}}"  # whose integral is below
SKEW_CASES = [(TURNS, "a"), (TURNS, "b"), (SHIFTS, "s"), (SHIFTS, "u")]


def moved(t: Array) -> Array:
    return 0.4 * t + 0.15 * t**2 - 0.5 * t**3 / 3


def coordinates(states: dict[str, Array], freedoms: str) -> tuple[Array, Array]:
    """Both freedoms of each sample, from matrices: by scipy's, and by the joint's own geometry."""
    R = {
        name: Rotation.from_quat(s[:, 3:7], scalar_first=True).as_matrix()
        for name, s in states.items()
    }
    between = np.einsum("nji,njk->nik", R["base"], R["tip"])
    if freedoms == TURNS:  # n₂ turns with a about z, and tip about n₂
        a = np.arctan2(between[:, 1] @ [1, 0, 1], between[:, 0] @ [1, 0, 1])
        rest = Rotation.from_rotvec(-a[:, None] * [0, 0, 1]) * Rotation.from_matrix(between)
        return a, rest.as_rotvec() @ np.array([1, 0, 1]) / np.sqrt(2)
    ends = [
        states[name][:, :3] + R[name] @ np.array(at)
        for name, at in (("base", [0.1, 0.2, 0.3]), ("tip", [0.3, 0, 0.1]))
    ]
    d = np.einsum("nji,nj->ni", R["base"], ends[1] - ends[0])
    u = np.sqrt(2) * d[:, 2]  # d = s (1, 0, 0) + u (1, 0, 1)/√2
    return d[:, 0] - d[:, 2], u


def off(freedoms: str, driven: str) -> float:
    """The largest difference [m or rad] of the driven freedom from the law's integral."""
    names = "ab" if freedoms == TURNS else "su"
    given = ", ".join(
        f"{name}: 0.3" if name == driven else f"{name}: 0.1, {name}_dot: 0.5" for name in names
    )
    text = (
        SKEW.replace("FREEDOMS", freedoms).replace("RATE", f"{driven}_dot").replace("LAW", RATE_LAW)
    )
    case = scenes.parsed(text.replace("GIVEN", given), tail=scenes.tail(1.0, 26))
    mechanism = scenes.mechanism(case)
    motion = Answer(mechanism, follow(mechanism, case.times)).trajectory(case.times)
    read = coordinates(dict(motion.states), freedoms)[names.index(driven)]
    return float(np.max(np.abs(read - 0.3 - moved(case.times))))


@pytest.mark.slow
@pytest.mark.parametrize(("freedoms", "driven"), SKEW_CASES)
def test_a_driven_freedom_goes_as_its_law_beside_a_skew_one(freedoms: str, driven: str) -> None:
    assert off(freedoms, driven) < KNOWN


@pytest.mark.slow
@pytest.mark.mutant("the dual of a driven shift beside a skew one is its own axis")
@pytest.mark.parametrize("driven", ["s", "u"])
def test_a_shift_by_its_own_axis_is_seen(driven: str, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(joint_constraints, "_dual", lambda joint, freedom: freedom.axis)
    assert off(SHIFTS, driven) > 0.01


@pytest.mark.mutant("the axes of two turns taken for right-angled: n₁·n₂ is 0")
@pytest.mark.parametrize("driven", ["a", "b"])
def test_turns_taken_for_right_angled_are_seen(
    driven: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    def apart(joint: Any, freedom: Any) -> Turn:
        axes = [turn.axis for turn in joint.turns]
        weights = (1.0, 0.0) if joint.turns.index(freedom) == 0 else (0.0, 1.0)
        return Turn(FIRST, SECOND, axes[0], axes[-1], weights)

    monkeypatch.setattr(joint_constraints, "turning", apart)
    assert off(TURNS, driven) > 0.01
