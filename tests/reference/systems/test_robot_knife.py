"""The robot's knife: multipliers against an elimination, the edge's own point, planted mistakes."""

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest
from given import free_cut, robot_laws
from given.laws import LIMIT, difference
from given.mutants import mutant
from given.robots import robot, states

from textmech.reference.formalisms import lagrange
from textmech.reference.system import Mode
from textmech.reference.systems.robots import robot_knife
from textmech.reference.systems.robots.arm import places

BELOW = 0.9800170106  # rad, of q2: with the angles there P is straight below the second hinge
P = np.array([0.13, 0.014, -0.045])  # of the hand, from its centre


def point(mode: Mode, t: float, q: Any, v: Any) -> tuple[Any, Any, Any]:
    """P, its velocity, and the hand's long axis, in ground axes, from the hand's pose alone."""
    pose = mode.poses(t, q, v)["hand"]
    E = free_cut.matrix(pose)
    return np.array(pose[:3]) + E @ P, np.array(pose[7:10]) + E @ np.cross(pose[10:], P), E[:, 0]


def slips(mode: Mode) -> float:
    """The edge's point rises or slips sideways: its velocity against the projected long axis."""
    worst = 0.0
    for t, q, v in states(mode):
        _, velocity, axis = point(mode, t, q, v)
        side = np.array([-axis[1], axis[0], 0.0]) / np.hypot(*axis[:2])
        worst = max(worst, abs(velocity[2]), abs(side @ velocity))
    return worst / 3.0  # rad/s of the states, beside lengths of one


def eliminated(mode: Mode) -> float:
    """(2.62) without λ: E_{a1} + α^{a2}_{a1} E_{a2} = 0 for q̇₁, q̇₂ as the dependent rates.

    E_a = M_ab q̈ᵇ − Q_a … from T and U; q̈^{a2} = α q̈^{a1} + what the edge's rows change by.
    """
    worst = 0.0
    for t, q, v in states(mode):
        rows = np.asarray(mode.f_a(t, q), dtype=float)
        alpha = -np.linalg.solve(rows[:, :2], rows[:, 2:])
        N = np.vstack([alpha, np.eye(3)])
        drift = lagrange.constraint_acceleration(mode, t, q, v)
        rest = np.concatenate([np.linalg.solve(rows[:, :2], drift), np.zeros(3)])
        M, Q = lagrange.mass_matrix(mode, t, q), lagrange.forces(mode, t, q, v)
        q_ddot = N @ np.linalg.solve(N.T @ M @ N, N.T @ (Q - M @ rest)) + rest
        worst = max(worst, difference(mode.accelerations(t, q, v), q_ddot))
    return worst


KNIFE = (slips, eliminated)


@pytest.mark.parametrize("law", KNIFE, ids=lambda law: law.__name__)
def test_knife_obeys(law: Any) -> None:
    assert law(robot("robot_knife")) < LIMIT


def test_height_is_that_of_the_rows() -> None:
    mode = robot("robot_knife")
    q0, v0 = mode.start()
    for t, q, _ in states(mode):
        slopes = lagrange.gradient(lambda q, t=t: mode.f(t, q)[0], q)
        assert difference(slopes, mode.f_a(t, q)[0]) < LIMIT
        height = point(mode, t, q, v0)[0][2] - point(mode, t, q0, v0)[0][2]
        assert abs(mode.f(t, q)[0] - height) < LIMIT


@pytest.mark.parametrize(
    ("angles", "why"),
    [
        ({"q2": math.pi / 2, "q3": 0.0, "q4": 0.0}, "no heading"),
        ({"q5": math.pi / 2, "q4": 2.0, "q3": 0.3, "q2": BELOW}, "does not determine"),
    ],
)
def test_a_start_that_the_edge_leaves_open_is_refused(angles: dict[str, float], why: str) -> None:
    with pytest.raises(ValueError, match=why):
        robot("robot_knife", **angles)


def another_axis(where: Any) -> Any:
    """The heading of the hand's second axis for that of its first."""
    E1, E2, E3 = where[-1].E
    return heading([*where[:-1], replace(where[-1], E=(E2, E3, E1))])


def turned_back(where: Any, omega: Any) -> Any:
    return -turn(where, omega)


def of_the_centre(self: Any, where: Any) -> Any:
    """Slip of the hand's centre for that of its edge."""
    return rows(self, [*where[:-1], replace(where[-1], end=where[-1].c)])


heading, turn, rows = robot_knife.heading, robot_knife._turn, robot_knife.RobotKnife.rows
IN_THE_KNIFE = {
    "heading of another axis": ("heading", another_axis, slips),
    "the heading's turn with the wrong sign": ("_turn", turned_back, robot_laws.equations),
    "the heading's turn with the wrong sign, eliminated": ("_turn", turned_back, eliminated),
}


@pytest.mark.mutant("robot's knife: {mistake}")
@pytest.mark.parametrize("mistake", IN_THE_KNIFE)
def test_a_mistake_in_the_knife_is_seen(mistake: str, monkeypatch: pytest.MonkeyPatch) -> None:
    name, wrong, law = IN_THE_KNIFE[mistake]
    monkeypatch.setattr(robot_knife, name, wrong)
    assert law(robot("robot_knife")) > 1e3 * LIMIT


@pytest.mark.mutant("robot's knife: slip of the hand's centre for that of its edge")
def test_slip_of_the_centre_is_seen() -> None:
    assert slips(mutant(robot("robot_knife"), rows=of_the_centre)) > 1e3 * LIMIT


@pytest.mark.mutant("robot's knife: the edge's force at the hand's centre")
def test_a_force_at_the_centre_is_seen() -> None:
    def cuts(self: Any, t: float, q: Any) -> Any:
        *hinges, edge = robot_knife.RobotKnife.cuts(self, t, q)
        return [*hinges, replace(edge, at=places(q)[-1].c)]

    assert robot_laws.cut_free(mutant(robot("robot_knife"), cuts=cuts)) > 1e3 * LIMIT
