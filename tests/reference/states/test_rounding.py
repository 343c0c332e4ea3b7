"""What is said of how well a chain's torques are known, against the same torques of 50 digits."""

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from mpmath import cos, mp, mpf, sin

from textmech.cases.case import Case
from textmech.cases.load import load
from textmech.cases.scene.observe import observe
from textmech.reference.solve import Solution, solve
from textmech.reference.states import answer

Row = np.ndarray[Any, Any]
"""(3,) or (3, 3) of mpmath's numbers."""

ARMS = (100.0, 70.0, 30.0)  # m: the torque of the last is a part in 1,000 of what is summed up
CHAIN = """\
title: A chain of hinges with long arms
source: {equations: ["2.44"]}
scene:
  space: 3
  points: {O: [0, 0, 0]}
  bodies:
BODIES
  joints:
JOINTS
states: {random: COUNT, seed: SEED, q: [-3, 3], q_dot: [-9, 9], q_ddot: [-9, 9]}
allow: {BOUNDS}
"""
MASSES, TURN = (1.3, 0.7, 2.1), (0.02, 0.03, 0.04)  # kg, kg m² for 1 kg and 1 m
AXES = ((0, 0, 1), (0, 1, 0), (1, 0, 0))


def claim(tmp_path: Path, arms: Sequence[float], seed: int, count: int = 4) -> Case:
    """Each body's centre lies at 0.4 of its arm, along (0.6, 0, 0.8)."""
    bodies, joints = list[str](), list[str]()
    for i, arm in enumerate(arms):
        ends = [[0.6 * arm * part, 0.0, 0.8 * arm * part] for part in (-0.5, 0.5)]
        inertia = [*(MASSES[i] * arm**2 * J for J in TURN), 0, 0, 0]
        bodies.append(
            f"    b{i}: {{rigid: {{mass: {MASSES[i]}, inertia: {inertia}}}, "
            f"points: {{A: {ends[0]}, B: {ends[1]}}}}}"
        )
        at = f"b{i - 1}.B" if i else "ground.O"
        joints.append(f"    q{i}: {{hinge: [{at}, b{i}.A], axis: {list(AXES[i])}}}")
    text = CHAIN.replace("BODIES", "\n".join(bodies)).replace("JOINTS", "\n".join(joints))
    text = text.replace("COUNT", str(count)).replace("SEED", str(seed))
    path = tmp_path / "chain.yaml"
    bounds = ", ".join(f"q{i}.torque: 1.0e+9" for i in range(len(arms)))
    path.write_text(text.replace("BOUNDS", bounds), encoding="utf-8")
    return load(path)[0]


def vector(x: Any) -> Row:
    return np.array([mpf(float(each)) for each in x], dtype=object)


def crossed(a: Row, b: Row) -> Row:
    return np.array([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)], dtype=object)


def about(u: Row, phi: Any) -> Row:
    """(3, 3) I + sin φ ũ + (1 − cos φ) ũ²."""
    eye = [vector(e) for e in np.eye(3)]
    K = np.array([crossed(u, e) for e in eye], dtype=object).T
    found: Row = np.array(eye, dtype=object) + sin(phi) * K + (1 - cos(phi)) * K.dot(K)
    return found


def torques(case: Case, state: int) -> list[Any]:
    """(2.25), (2.27) from the tip to the ground: forces and moments, and of these what turns."""
    assert case.states is not None
    drawn = case.states.drawn(case.scene)
    R, g = np.array([vector(e) for e in np.eye(3)], dtype=object), vector(case.scene.gravity)
    omega, alpha, a, parts = vector([0, 0, 0]), vector([0, 0, 0]), -g, []
    for i, body in enumerate(case.scene.bodies.values()):
        phi, rate, change = vector(drawn[f"q{i}.angle"][state])
        u = R.dot(vector(AXES[i]))
        R = R.dot(about(vector(AXES[i]), phi))
        alpha = alpha + u * change + crossed(omega, u) * rate
        omega = omega + u * rate

        def far(d: Row, a: Row = a, alpha: Row = alpha, omega: Row = omega) -> Row:
            return a + crossed(alpha, d) + crossed(omega, crossed(omega, d))

        base = vector(body.points["A"])
        center, tip = R.dot(-base), R.dot(vector(body.points["B"]) - base)
        J = R.dot(np.array([vector(row) for row in body.tensor], dtype=object)).dot(R.T)
        moment = J.dot(alpha) + crossed(omega, J.dot(omega))
        parts.append((u, center, tip, mpf(body.mass) * far(center), moment))
        a = far(tip)
    force, moment, found = vector([0, 0, 0]), vector([0, 0, 0]), list[Any]()
    for u, center, tip, F, M in reversed(parts):
        moment = M + moment + crossed(tip, force) + crossed(center, F)
        force = force + F
        found.append(u.dot(moment))
    return found[::-1]


def off(case: Case, found: Solution) -> list[float]:
    """For each torque its error, of what the certificate says of it."""
    said = {check.name: check.certified for check in found.checks}
    shares = list[float]()
    with mp.workdps(50):
        exact = np.array([torques(case, state) for state in range(case.samples)]).T
        for i, row in enumerate(exact):
            own = observe(case.scene, found.trajectory, f"q{i}.torque")
            error = max(abs(mpf(float(x)) - y) for x, y in zip(own, row, strict=True))
            certified = said[f"error of q{i}.torque"]
            assert certified
            shares.append(float(error / certified))
    return shares


SCENES = [ARMS, ARMS[::-1], (1e3, 1.0, 1e-2), (0.5, 0.4), (2.0,)]


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("arms", SCENES, ids=str)
def test_torques_are_known_as_well_as_is_said(
    arms: tuple[float, ...], seed: int, tmp_path: Path
) -> None:
    case = claim(tmp_path, arms, seed)
    found = solve(case)
    assert found.holds
    shares = off(case, found)
    assert max(shares) < 1.1  # where d'Alembert's tells the error, it has a tenth of it itself
    assert max(shares) > 1e-3  # nor is it said of anything that it is known to nothing


FAR = """\
title: A bar that hangs where a long frame turns
source: {equations: ["2.12"]}
scene:
  space: 3
  points: {O: [0.2, 0.7, 0]}
  bodies:
    frame:
      rigid: {mass: 3, inertia: [1, 1, 1, 0, 0, 0]}
      points: {p: [1.0e+6, 0, 0]}
    bar: {bar: {mass: 1.3, length: 0.7}}
  joints:
    s: {hinge: [ground.O, frame.p], axis: [0, 0, 1]}
    h: {hinge: [frame.p, bar.start], axis: [0, 0, 1]}
states: {random: 20, seed: 5, q: [-2.5, 2.5], q_dot: [-1, 1], q_ddot: [-1, 1]}
allow: {bar.x: 1.0e-12, bar.ax: 1.0e-11}
"""


@pytest.mark.slow
def test_a_chain_does_not_pass_over_a_far_centre(tmp_path: Path) -> None:
    """bar.x = 0.2 + 0.35 cos(s + h): over the centre, a million metres off, 5e-11 m are lost."""
    (tmp_path / "far.yaml").write_text(FAR, encoding="utf-8")
    (case,) = load(tmp_path / "far.yaml")
    found = solve(case)
    assert found.holds
    assert case.states is not None
    drawn = case.states.drawn(case.scene)
    turned = drawn["s.angle"][:, 0] + drawn["h.angle"][:, 0]
    off = observe(case.scene, found.trajectory, "bar.x") - (0.2 + 0.35 * np.cos(turned))
    assert np.abs(off).max() < 4e-16


@pytest.mark.mutant("how well a torque is known said by its size alone")
def test_what_is_said_by_a_size_alone_would_be_seen(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(answer, "_rounding_answers", lambda case: {})
    case = claim(tmp_path, ARMS, 0)
    assert max(off(case, solve(case))) > 3.0
