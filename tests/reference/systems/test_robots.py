"""The five-axis robot: second derivations, special motions, its knife, and planted mistakes."""

import math
from collections.abc import Callable
from dataclasses import replace
from typing import Any
from unittest import mock

import numpy as np
import pytest
from given.laws import LIMIT, cut_bodies, difference, robot_laws
from given.machines.robots import PARAMETERS, robot, states
from given.mutants import in_ground_axes, mutant, sound, too_fast, transposed

from textmech.reference.formalisms import lagrange
from textmech.reference.formalisms.derivative import along
from textmech.reference.motion.follow import follow
from textmech.reference.system import Mode, Only
from textmech.reference.systems.robots import (
    arm,
    driven_robot,
    five_axis_robot,
    robot_knife,
    serial_arm,
)
from textmech.reference.systems.robots.arm import places
from textmech.reference.systems.robots.triples import NIL

# The five-axis robot, falling and driven: second derivations and special motions.

NAMES = pytest.mark.parametrize("name", PARAMETERS)
G = 9.80665


@NAMES
@pytest.mark.parametrize("law", robot_laws.LAWS, ids=lambda law: law.__name__)
def test_robot_obeys(name: str, law: Any) -> None:
    assert law(robot(name)) < LIMIT


def test_angular_velocities_are_those_of_the_frames() -> None:
    """(2.3), (2.4) ω = (Ė₂·E₃, Ė₃·E₁, Ė₁·E₂): what Exercise 2.1 asks of all five bodies."""
    mode = robot("five_axis_robot")
    for t, q, v in states(mode):
        E_dot = along(lambda q: np.array([place.E for place in places(q)]), (q,), (v,))
        E = np.array([place.E for place in places(q)])
        pairs = ((1, 2), (2, 0), (0, 1))
        omega = [[E_dot[k, i] @ E[k, j] for i, j in pairs] for k in range(5)]
        posed = [pose[10:] for pose in mode.poses(t, q, v).values()]
        assert difference(omega, posed) < LIMIT


def test_driven_motion_is_the_closed_form() -> None:
    mode, times = robot("driven_robot"), np.linspace(0.0, 2.0, 11)
    known = np.array([np.concatenate(mode.closed_form(t) or ()) for t in times.tolist()])
    assert difference(follow(Only(mode), times).y, known) < LIMIT


def shoulder(mode: Mode) -> float:
    """With q2 alone in motion the arm is a pendulum: (2.36), (2.35) and (2.34) give its torque.

    J_O = Σ u · E J Eᵀ u + m ρ², whatever the rate is; J_O q̈₂ and the moment of the weights.
    """
    t, q = 0.3, np.array([0.4, -0.7, 1.1, 0.6, -0.5])
    v = np.array(mode.g(t, q))
    poses = {name: np.array(pose) for name, pose in mode.poses(t, q, v).items()}
    hinge = poses["base"][:3] + cut_bodies.matrix(tuple(poses["base"])) @ [0.05, 0.02, 0.19]
    u = np.array([-math.sin(q[0]), math.cos(q[0]), 0.0])
    torque, q_ddot = 0.0, mode.accelerations(t, q, v)[1]
    for name in ("upper", "fore", "wrist", "hand"):
        E, arm = cut_bodies.matrix(tuple(poses[name])), poses[name][:3] - hinge
        mass = mode.masses[name]
        across = arm - (arm @ u) * u
        J_O = u @ E @ mass.J @ E.T @ u + mass.m * (across @ across)
        torque += J_O * q_ddot + u @ np.cross(arm, [0.0, 0.0, mass.m * G])
    assert abs(v[1]) > 0.5, "it stands still"
    return abs(mode.reactions(t, q, v)["q2.torque"] - torque) / abs(torque)


ALONE = {f"S{k}": 0.0 for k in (1, 3, 4, 5)}


def test_one_joint_alone_moves_a_pendulum() -> None:
    assert shoulder(robot("driven_robot", **ALONE)) < LIMIT
    assert shoulder(robot("driven_robot")) > 1e-3, "it sees no other joint move"


# Mistakes planted in the five-axis robots: the law that must see each sees it.

MODULES = (arm, driven_robot, five_axis_robot, robot_knife, serial_arm)
outward, inward, mass_matrix = arm.outward, arm.inward, arm.mass_matrix


def without_gyroscopic_term(*given: Any) -> Any:
    """The centres move as they do, but ω × J ω is lost."""
    return [replace(at, omega=NIL) for at in outward(*given)]


def without_carried_rates(where: Any, v: Any, a: Any) -> Any:
    """ω̇ without ω_{k−1} × q̇_k u_k."""
    turns = np.cumsum([np.multiply(x, place.u) for x, place in zip(a, where, strict=True)], axis=0)
    found = zip(outward(where, v, a), turns.tolist(), strict=True)
    return [replace(at, omega_dot=tuple(omega_dot)) for at, omega_dot in found]


def lifted_at_the_tip(where: Any, moving: Any, tip: Any = NIL) -> Any:
    """A force of the hand's weight that nobody applies."""
    return inward(where, moving, (0.0, 0.0, 0.7 * 9.80665))


def without_tensors(where: Any) -> Any:
    with mock.patch.object(arm.Link, "turned", return_value=NIL):
        return mass_matrix(where)


def without_steiner(where: Any) -> Any:
    """The hand's centre on its hinge."""
    return mass_matrix([*where[:-1], replace(where[-1], c=where[-1].p)])


IN_THE_ARM = {
    "outward": (without_gyroscopic_term, without_carried_rates),
    "inward": (lifted_at_the_tip,),
    "mass_matrix": (without_tensors, without_steiner),
}
PLANTED = [
    pytest.param(name, function, wrong, id=f"{name}: {wrong.__name__}")
    for function, mistakes in IN_THE_ARM.items()
    for wrong in mistakes
    for name in PARAMETERS
    if name != "driven_robot" or function != "mass_matrix"  # it needs none
]


@pytest.mark.mutant("{name}: {wrong}")
@pytest.mark.parametrize(("name", "function", "wrong"), PLANTED)
def test_a_mistake_in_the_arm_is_seen_by_lagrange(
    name: str, function: str, wrong: Callable[..., Any], monkeypatch: pytest.MonkeyPatch
) -> None:
    for module in MODULES:
        if hasattr(module, function):
            monkeypatch.setattr(module, function, wrong)
    assert robot_laws.equations(robot(name)) > 1e3 * LIMIT


def of_one_hinge(self: Any, t: Any, q: Any, v: Any) -> Any:
    """ω_{k,k−1} for ω_k."""
    rows = zip(sound(self, "poses")(t, q, v).items(), arm.LINKS, v, strict=True)
    return {name: (*pose[:10], *(x * np.eye(3)[link.axis])) for (name, pose), link, x in rows}


def exchanged(self: Any, *given: Any) -> dict[str, float]:
    """What the second body exerts on the first."""
    held = sound(self, "reactions")(*given)
    return {name: -x if name.startswith("q3.") else x for name, x in held.items()}


def of_the_next_axis(self: Any, *given: Any) -> dict[str, float]:
    """Moments about the next hinge for those about this one."""
    held = sound(self, "reactions")(*given)
    return held | {f"q3.m{axis}": held[f"q4.m{axis}"] for axis in "xyz"}


def upward(self: Any, t: Any, q: Any) -> Any:
    return -sound(self, "U")(t, q)


IN_THE_MODE = {
    "transposed E": ({"poses": transposed}, robot_laws.moves),
    "ω in ground axes": ({"poses": in_ground_axes}, robot_laws.moves),
    "ω of one hinge": ({"poses": of_one_hinge}, robot_laws.moves),
    "parts exchanged": ({"reactions": exchanged}, robot_laws.cut_free),
    "moment about another point": ({"reactions": of_the_next_axis}, robot_laws.cut_free),
    "accelerations off": ({"accelerations": too_fast}, robot_laws.power),
    "weight upward": ({"U": upward}, robot_laws.equations),
}


@pytest.mark.mutant("{name}: {mistake}")
@NAMES
@pytest.mark.parametrize("mistake", IN_THE_MODE)
def test_a_mistake_in_the_mode_is_seen(name: str, mistake: str) -> None:
    methods, law = IN_THE_MODE[mistake]
    assert law(mutant(robot(name), **methods)) > 1e3 * LIMIT


# The robot's knife: multipliers against an elimination, the edge's own point, planted mistakes.

BELOW = 0.9800170106  # rad, of q2: with the angles there P is straight below the second hinge
P = np.array([0.13, 0.014, -0.045])  # of the hand, from its centre


def point(mode: Mode, t: float, q: Any, v: Any) -> tuple[Any, Any, Any]:
    """P, its velocity, and the hand's long axis, in ground axes, from the hand's pose alone."""
    pose = mode.poses(t, q, v)["hand"]
    E = cut_bodies.matrix(pose)
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
