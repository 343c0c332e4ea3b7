"""Five-axis robot whose knife moves in a horizontal plane without side slip (Exercise 2.5).

q = (q₁ … q₅) as of its arm. The knife's edge is at P, the end of the hand, and stands along the
hand's long axis E₁; ψ is the heading of E₁ projected on the plane, e = (cos ψ, sin ψ, 0) and
n = (−sin ψ, cos ψ, 0). The joints are free: the arm sinks under its weight, and the edge guides it.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import equation
from ...system import Array, Cut, Vector
from .arm import Place, bias, mass_matrix, outward, places
from .serial_arm import SerialArm
from .triples import Triple, cross, dot, minus, plus, times

UP = (0.0, 0.0, 1.0)
SINGULAR = 1e-6  # of lengths near 1 m: what is nearer than that loses half of its digits


@dataclass(frozen=True)
class RobotKnife(SerialArm):
    """The arm let go at the angles q1 … q5 [rad], w3, w4, w5 [rad/s]; the edge gives w1, w2."""

    q1: float
    q2: float
    q3: float
    q4: float
    q5: float
    w3: float
    w4: float
    w5: float

    def __post_init__(self) -> None:
        super().__post_init__()
        where = places(self._angles())
        x, y, _ = where[-1].E[0]
        if x * x + y * y < SINGULAR:
            raise ValueError("the hand stands upright, and its edge has no heading")
        if abs(np.linalg.det(np.array(self.rows(where))[:, :2])) < SINGULAR:
            raise ValueError("at these angles the edge does not determine the rates of q1 and q2")

    def start(self) -> tuple[Array, Array]:
        """(2.61) w₁ and w₂ from f_a q̇ᵃ = 0: P is kept at the height where it starts."""
        q, own = self._angles(), np.array([self.w3, self.w4, self.w5])
        rows = np.array(self.rows(places(q)))
        return q, np.concatenate([np.linalg.solve(rows[:, :2], -rows[:, 2:] @ own), own])

    def _angles(self) -> Array:
        return np.array([self.q1, self.q2, self.q3, self.q4, self.q5])

    def rows(self, where: list[Place]) -> list[list[Any]]:
        """(2.15) ż_P = 0, n · ṙ_P = 0, with ∂ṙ_P/∂q̇_j = u_j × (P − p_j): two rows of 5."""
        P, (_, n) = where[-1].end, heading(where)
        moved = [cross(place.u, minus(P, place.p)) for place in where]
        return [[x[2] for x in moved], [dot(n, x) for x in moved]]

    def guided(self, q: Array, v: Array) -> tuple[Array, Array]:
        """(2.60) M_ab q̈ᵇ + bias_a = λ_b f_aᵇ, f_a q̈ᵃ = −ḟ_a q̇ᵃ: q̈ (5,), λ (2,) [N].

        ḟ_a q̇ᵃ is r̈_P at q̈ = 0: its z, and n · r̈_P + ṅ · ṙ_P with ṅ = −ψ̇ e.
        """
        where, rates = places(q), v.tolist()
        rows = np.array(self.rows(where))
        hand = outward(where, rates, (0.0,) * 5)[-1]
        e, n = heading(where)
        P_dot = _velocity(where, rates)
        drift = [hand.end_ddot[2], dot(n, hand.end_ddot) - _turn(where, hand.omega) * dot(e, P_dot)]
        matrix = np.block([[mass_matrix(where), -rows.T], [rows, np.zeros((2, 2))]])
        right = np.negative([*bias(where, rates), *drift])
        solution: Any = np.linalg.solve(matrix, right)
        return solution[:5], solution[5:]

    def accelerations(self, t: float, q: Array, v: Array) -> Array:
        """(2.60) as `guided` has it [rad/s²], (5,)."""
        return self.guided(q, v)[0]

    def reactions(self, t: float, q: Array, v: Array) -> dict[str, float]:
        """(2.60) λ are the plane's forces on the edge; (2.23), (2.27) inward from it [N, N m]."""
        where, (a, lam) = places(q), self.guided(q, v)
        normal, side = lam.tolist()
        tip = plus(times(normal, UP), times(side, heading(where)[1]))
        held = self.joint_reactions(where, outward(where, v.tolist(), a.tolist()), tip)
        return held | {"blade.normal": normal, "blade.force": side}

    def f(self, t: Any, q: Vector) -> Vector:
        """(2.14) z_P − z_P(0) = 0 [m], (1,)."""
        return np.array([places(q)[-1].end[2] - places(self._angles())[-1].end[2]])

    def f_a(self, t: Any, q: Vector) -> Vector:
        """(2.15) as `rows` has it, (2, 5)."""
        return np.array(self.rows(places(q)))

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """As of any arm, and the edge: a force upward and one to its left."""
        where = places(q)
        names = ("blade.normal", "blade.force")
        edge = Cut(names, None, "hand", where[-1].end, (UP, heading(where)[1]))
        return [*super().cuts(t, q), edge]


def heading(where: list[Place]) -> tuple[Triple, Triple]:
    """e and n of the hand's long axis, projected on the plane; not of one that stands upright."""
    x, y, _ = where[-1].E[0]
    size = (x * x + y * y) ** 0.5  # of complex numbers too
    return (x / size, y / size, 0.0), (-y / size, x / size, 0.0)


@equation
def _velocity(where: list[Place], rates: list[float]) -> Triple:
    """(2.6) ṙ_P = Σ q̇_j u_j × (P − p_j) [m/s]."""
    velocity = (0.0, 0.0, 0.0)
    for place, rate in zip(where, rates, strict=True):
        velocity = plus(velocity, cross(times(rate, place.u), minus(where[-1].end, place.p)))
    return velocity


def _turn(where: list[Place], omega: Triple) -> Any:
    """ψ̇ = (E₁ × Ė₁)_z/(E₁ₓ² + E₁ᵧ²) with (2.5) Ė₁ = ω × E₁ [rad/s]."""
    x, y, _ = where[-1].E[0]
    x_dot, y_dot, _ = cross(omega, where[-1].E[0])
    return (x * y_dot - y * x_dot) / (x * x + y * y)
