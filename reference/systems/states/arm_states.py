"""The five-axis robot (fig 2.10, Exercise 2.1) at any state: kinematics and inverse dynamics.

q = (q₁ … q₅) as of its arm. ω_k follows from Ė_k by (2.3), (2.4), and torques from one pass outward
and one inward, with no energy.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...laws.rotation import angular_velocity
from ...stated import Stated
from ...system import Array
from ..robots.arm import LINKS, inward, mass_matrix, outward, places
from ..robots.serial_arm import NAMES, SerialArm
from ..robots.triples import dot


@dataclass(frozen=True)
class ArmStates(SerialArm, Stated):
    """The arm with its rates and accelerations given: five hinges, driven by what they need."""

    coordinates = ("q1.angle", "q2.angle", "q3.angle", "q4.angle", "q5.angle")

    def quantities(self, q: Array, v: Array, a: Array) -> dict[str, Any]:
        """ω from Ė, ω̇ and r̈ outward, M_ab, and the torques u_k · M_k inward."""
        where = places(q)
        values: dict[str, Any] = {"mass_matrix": mass_matrix(where)}
        moving = outward(where, v.tolist(), a.tolist())
        for name, at in zip(NAMES, moving, strict=True):
            values |= _by_axis(f"{name}.a", at.c_ddot) | _by_axis(f"{name}.alpha_", at.omega_dot)
        values |= _by_axis("hand.P.a", moving[-1].end_ddot)
        for k, (place, (_, M)) in enumerate(zip(where, inward(where, moving), strict=True)):
            values[f"q{k + 1}.torque"] = dot(place.u, M)
        for name, place, E_dot in zip(NAMES, where, turning(q, v), strict=True):
            omega = angular_velocity(np.array(place.E), E_dot)
            values |= {f"{name}.omega_{i}": x for i, x in enumerate(omega, start=1)}
        return values


def turning(q: Array, v: Array) -> Iterator[Array]:
    """Ė_k (3, 3) from joint to joint: E_k = A(q_k) E_{k−1}, so that Ė_k = Ȧ E_{k−1} + A Ė_{k−1}."""
    E, E_dot = np.eye(3), np.zeros((3, 3))
    for link, angle, rate in zip(LINKS, q, v, strict=True):
        b, c = (link.axis + 1) % 3, (link.axis + 2) % 3
        A, slope = np.eye(3), np.zeros((3, 3))
        A[b, b] = A[c, c] = slope[b, c] = np.cos(angle)
        A[b, c], A[c, b] = np.sin(angle), -np.sin(angle)
        slope[b, b] = slope[c, c] = -np.sin(angle)
        slope[c, b] = -np.cos(angle)
        E, E_dot = A @ E, rate * slope @ E + A @ E_dot
        yield E_dot


def _by_axis(begin: str, vector: Any) -> dict[str, float]:
    return {f"{begin}{axis}": float(x) for axis, x in zip("xyz", vector, strict=True)}
