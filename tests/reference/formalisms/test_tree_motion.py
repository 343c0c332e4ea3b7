"""The motion of a tree by its own equations against closed forms."""

import numpy as np
import pytest

from textmech.cases.model_case import Steps
from textmech.cases.trajectory import Array
from textmech.cases.tree import Link, Motor, Tree, TreeJoint
from textmech.reference.formalisms import tree_motion as tree_motions
from textmech.reference.formalisms.tree_motion import tree_motion

FREE = (-np.inf, np.inf)
ONE, NONE = np.array([1.0, 0.0, 0.0, 0.0]), np.zeros(3)
TIMES = np.linspace(0.0, 0.5, 6)
JUMP = 0.13


class Pushed:
    """A control that jumps from 1 to −2."""

    law = Steps((0.0, JUMP), (1.0, -2.0))
    corners = law.corners

    def at(self, time: float) -> Array:
        return self.law.at(np.array([time]))[0]


def tree(kind: str, J: Array, **more: object) -> Tree:
    joint = TreeJoint("joint", kind, 0, 0, NONE, np.array([1.0, 0.0, 0.0]))  # type: ignore[arg-type]
    body = Link("body", -1, NONE, ONE, 2.0, NONE, J, [joint])
    n = {"slide": 1, "ball": 3, "free": 6}[kind]
    gravity = np.array([0.0, 0.0, -9.81])
    return Tree([body], n, gravity, np.zeros(n), np.zeros(n), **more)  # type: ignore[arg-type]


def test_a_control_that_jumps_pushes_a_mass() -> None:
    """2 ẍ = u: t²/4 until the jump, and from there at a rate that falls."""
    push = Motor("push", np.ones(1), 0, np.array([1.0, 0, 0]), np.zeros(3), FREE, FREE)
    start = np.zeros(1)
    motion = tree_motion(
        tree("slide", np.eye(3), motors=[push]), start, start, TIMES, Pushed(), 999
    )
    late = np.maximum(TIMES - JUMP, 0.0)
    assert np.abs(motion.q[:, 0] - (TIMES**2 / 4 - 0.75 * late**2)).max() < 1e-15
    assert motion.errors[-1] < 1e-14


@pytest.mark.mutant("answers that take the same steps, and state no error")
def test_two_answers_of_one_method_may_err_alike(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(tree_motions, "ROUGH", (5, 1e-11))
    monkeypatch.setattr(tree_motions, "FINE", (5, 1e-13))
    body = tree("ball", np.eye(3))
    motion = tree_motion(body, ONE, np.array([1.0, -2.0, 2.0]), TIMES, Pushed(), 9999)
    assert motion.errors[-1] == 0.0


@pytest.mark.parametrize("kind", ["ball", "free"])
def test_a_symmetric_body_turns_at_its_rate(kind: str) -> None:
    """About any axis of its own: half the angle stands in its quaternion; its centre falls."""
    omega = np.array([1.0, -2.0, 2.0])
    q, v = (ONE, omega) if kind == "ball" else (np.r_[NONE, ONE], np.r_[1.0, 0.0, 0.0, omega])
    motion = tree_motion(tree(kind, np.eye(3)), q, v, TIMES, Pushed(), 9999)
    half = 1.5 * TIMES[:, None]
    wanted = np.hstack([np.cos(half), np.sin(half) * omega / 3])
    off = np.abs(motion.q[:, -4:] - wanted).max(axis=1)
    assert 0.0 < off.max() < 2e-11
    assert (off <= motion.errors + 1e-15).all()
    if kind == "free":
        assert np.abs(motion.q[:, 2] + 9.81 / 2 * TIMES**2).max() < 1e-13


def test_it_ends_where_its_work_does() -> None:
    """A top about its middle axis; what is not reached is not there."""
    top, v = tree("ball", np.diag([1.0, 2.0, 3.0])), np.array([0.1, 3.0, 0.1])
    whole = tree_motion(top, ONE, v, TIMES, Pushed(), 9999)
    part = tree_motion(top, ONE, v, TIMES, Pushed(), 150)
    assert 1 < len(part.times) < len(whole.times) == len(TIMES)
    assert np.array_equal(part.q, whole.q[: len(part.q)])
    assert len(tree_motion(top, ONE, v, TIMES, Pushed(), 0).times) == 1
