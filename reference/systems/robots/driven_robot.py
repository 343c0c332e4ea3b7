"""Five-axis robot (fig 2.10, Exercise 2.1) whose joints are driven: inverse dynamics.

q = (q₁ … q₅) as of its arm, with q̇_k = S_k sin n_k t prescribed: the torques are asked for.
"""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...system import Array, Cut, Vector
from .arm import LINKS, outward, places
from .serial_arm import NAMES, SerialArm
from .triples import dot


@dataclass(frozen=True)
class DrivenRobot(SerialArm):
    """The arm from the angles q [rad] on, by amplitudes S and angular frequencies n [rad/s]."""

    q1: float
    q2: float
    q3: float
    q4: float
    q5: float
    S1: float
    S2: float
    S3: float
    S4: float
    S5: float
    n1: float
    n2: float
    n3: float
    n4: float
    n5: float

    def start(self) -> tuple[Array, Array]:
        """At the angles q, at rest: the drives begin with rates of zero."""
        return np.array([self.q1, self.q2, self.q3, self.q4, self.q5]), np.zeros(5)

    def drives(self) -> tuple[Array, Array]:
        """S and n [rad/s], (5,) each."""
        S = [self.S1, self.S2, self.S3, self.S4, self.S5]
        return np.array(S), np.array([self.n1, self.n2, self.n3, self.n4, self.n5])

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.15) q̈_k = S_k n_k cos n_k t, whatever the masses are [rad/s²], (5,)."""
        S, n = self.drives()
        return S * n * np.cos(n * t)

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.23), (2.27) inward along the arm [N, N m]; the torque of a drive is u_k · M_k."""
        where = places(q)
        held = self.joint_reactions(
            where, outward(where, v.tolist(), self.accelerations(t, q, v).tolist())
        )
        for joint, place in zip(self.coordinates, where, strict=True):
            x, y, z = (held[f"{joint}.m{axis}"] for axis in "xyz")
            held[f"{joint}.torque"] = float(dot(place.u, (x, y, z)))
        return held

    def closed_form(self, t: float) -> tuple[Array, Array]:
        """(2.12) q_k = q_k(0) + S_k/n_k (1 − cos n_k t), q̇_k = S_k sin n_k t.

        From the parameters alone: `drives` belongs to the motion.
        """
        start = [self.q1, self.q2, self.q3, self.q4, self.q5]
        S = [self.S1, self.S2, self.S3, self.S4, self.S5]
        n = [self.n1, self.n2, self.n3, self.n4, self.n5]
        rows = list(zip(start, S, n, strict=True))
        q = [q0 + 2 * S / n * math.sin(n * t / 2) ** 2 for q0, S, n in rows]
        return np.array(q), np.array([S * math.sin(n * t) for _, S, n in rows])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) every rate is prescribed: the unit rows (5, 5), λ the torques."""
        return np.eye(5)

    def g(self, t: Any, q: Vector) -> Vector:
        """(2.15) q̇_k = S_k sin n_k t [rad/s], (5,)."""
        S, n = self.drives()
        return S * np.sin(n * t)

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """As of any arm, and the drives about the hinges' axes."""
        where = places(q)
        drives = [
            Cut((f"{joint}.torque",), before, link.name, place.p, (), moments=(place.u,))
            for joint, before, link, place in zip(
                self.coordinates, (None, *NAMES), LINKS, where, strict=False
            )
        ]
        return [*super().cuts(t, q), *drives]
