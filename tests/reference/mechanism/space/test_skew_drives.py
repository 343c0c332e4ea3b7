"""A driven freedom of a joint whose axes are at no right angles goes as its law says."""

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from given import scenes
from scipy.spatial.transform import Rotation

from textmech.reference.mechanism.constraints import joint_constraints
from textmech.reference.mechanism.constraints.constraint_terms import FIRST, SECOND, Turn
from textmech.reference.motion.bodies import Answer
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array

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
LAW = "{polynomial: {coefficients: [0.4, 0.3, -0.5]}}"  # whose integral is below
CASES = [(TURNS, "a"), (TURNS, "b"), (SHIFTS, "s"), (SHIFTS, "u")]


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


def off(folder: Path, freedoms: str, driven: str) -> float:
    """The largest difference [m or rad] of the driven freedom from the law's integral."""
    names = "ab" if freedoms == TURNS else "su"
    given = ", ".join(
        f"{name}: 0.3" if name == driven else f"{name}: 0.1, {name}_dot: 0.5" for name in names
    )
    text = SKEW.replace("FREEDOMS", freedoms).replace("RATE", f"{driven}_dot").replace("LAW", LAW)
    case = scenes.typed(folder, text.replace("GIVEN", given), tail=scenes.tail(1.0, 26))
    mechanism = scenes.mechanism(case)
    motion = Answer(mechanism, follow(mechanism, case.times)).trajectory(case.times)
    read = coordinates(dict(motion.states), freedoms)[names.index(driven)]
    return float(np.max(np.abs(read - 0.3 - moved(case.times))))


@pytest.mark.slow
@pytest.mark.parametrize(("freedoms", "driven"), CASES)
def test_a_driven_freedom_goes_as_its_law_beside_a_skew_one(
    freedoms: str, driven: str, tmp_path: Path
) -> None:
    assert off(tmp_path, freedoms, driven) < KNOWN


@pytest.mark.slow
@pytest.mark.mutant("the dual of a driven shift beside a skew one is its own axis")
@pytest.mark.parametrize("driven", ["s", "u"])
def test_a_shift_by_its_own_axis_is_seen(
    driven: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(joint_constraints, "_dual", lambda joint, freedom: freedom.axis)
    assert off(tmp_path, SHIFTS, driven) > 0.01


@pytest.mark.mutant("the axes of two turns taken for right-angled: n₁·n₂ is 0")
@pytest.mark.parametrize("driven", ["a", "b"])
def test_turns_taken_for_right_angled_are_seen(
    driven: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def apart(joint: Any, freedom: Any) -> Turn:
        axes = [turn.axis for turn in joint.turns]
        weights = (1.0, 0.0) if joint.turns.index(freedom) == 0 else (0.0, 1.0)
        return Turn(FIRST, SECOND, axes[0], axes[-1], weights)

    monkeypatch.setattr(joint_constraints, "turning", apart)
    assert off(tmp_path, TURNS, driven) > 0.01
