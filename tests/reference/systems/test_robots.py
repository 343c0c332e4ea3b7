"""The five-axis robot, falling and driven: second derivations and special motions."""

import math
from typing import Any

import numpy as np
import pytest
from given import free_cut, robot_laws
from given.laws import LIMIT, difference
from given.robots import PARAMETERS, robot, states

from textmech.reference.formalisms.derivative import along
from textmech.reference.motion.follow import follow
from textmech.reference.system import Mode, Only
from textmech.reference.systems.robots.arm import places

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
    hinge = poses["base"][:3] + free_cut.matrix(tuple(poses["base"])) @ [0.05, 0.02, 0.19]
    u = np.array([-math.sin(q[0]), math.cos(q[0]), 0.0])
    torque, q_ddot = 0.0, mode.accelerations(t, q, v)[1]
    for name in ("upper", "fore", "wrist", "hand"):
        E, arm = free_cut.matrix(tuple(poses[name])), poses[name][:3] - hinge
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
