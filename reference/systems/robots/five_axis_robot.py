"""Five-axis robot (fig 2.10, Exercise 2.1) that falls under its own weight, no joint driven.

q = (q₁ … q₅) as of its arm.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array
from .arm import bias, mass_matrix, outward, places
from .serial_arm import SerialArm


@dataclass(frozen=True)
class FiveAxisRobot(SerialArm):
    """The arm let go at the angles q1 … q5 [rad], with the rates w1 … w5 [rad/s]."""

    q1: float
    q2: float
    q3: float
    q4: float
    q5: float
    w1: float
    w2: float
    w3: float
    w4: float
    w5: float

    def start(self) -> tuple[Array, Array]:
        """As it is let go."""
        q = [self.q1, self.q2, self.q3, self.q4, self.q5]
        return np.array(q), np.array([self.w1, self.w2, self.w3, self.w4, self.w5])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.44) M_ab q̈ᵇ = −bias: no torque about any hinge [rad/s²], (5,)."""
        where = places(q)
        q_ddot: Any = np.linalg.solve(mass_matrix(where), np.negative(bias(where, v.tolist())))
        return q_ddot

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23), (2.27) inward along the arm [N, N m]."""
        where, a = places(q), self.accelerations(t, q, v)
        return self.joint_reactions(where, outward(where, v.tolist(), a.tolist()))
