"""The five-axis robot (fig 2.10): its bodies, and (2.6)–(2.12), (2.23), (2.27) along its chain.

q = (q₁ … q₅), the turns about z, y, y, y, x, each in the axes that those before it leave. With
q = 0 all axes are parallel to the ground's and the arm reaches along x. The book draws no numbers:
these are ours. All vectors stand in ground axes, all tensors in body axes.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np

from ...coverage import Numbered, equation
from ...system import Array, Vector
from .triples import (
    GROUND,
    NIL,
    Frame,
    Triple,
    about,
    cross,
    dot,
    embodied,
    grounded,
    minus,
    plus,
    times,
)

G = 9.80665  # m/s²


@dataclass(frozen=True)
class Link(Numbered):
    """A body: m [kg]; J₁₁, J₂₂, J₃₃, J₁₂, J₁₃, J₂₃ [kg m²]; the ends a, b [m] from its centre.

    Joint k turns body k about its own axis (0, 1, 2) through a; b is the next joint, or P.
    """

    name: str
    axis: int
    m: float
    J: tuple[float, float, float, float, float, float]
    a: Triple
    b: Triple

    def turned(self, x: Triple) -> Triple:
        """(2.31) J_ik x_k, in body axes."""
        d1, d2, d3, d12, d13, d23 = self.J
        return (
            d1 * x[0] + d12 * x[1] + d13 * x[2],
            d12 * x[0] + d2 * x[1] + d23 * x[2],
            d13 * x[0] + d23 * x[1] + d3 * x[2],
        )


LINKS = (
    Link("base", 2, 8.0, (0.33, 0.29, 0.14, 0.007, -0.012, 0.005),
         (-0.03, 0.01, -0.21), (0.05, 0.02, 0.19)),
    Link("upper", 1, 5.0, (0.021, 0.17, 0.18, -0.004, 0.009, 0.003),
         (-0.24, -0.025, 0.015), (0.26, 0.06, -0.016)),
    Link("fore", 1, 3.0, (0.011, 0.064, 0.069, 0.002, -0.0055, -0.0015),
         (-0.17, 0.027, 0.012), (0.23, -0.055, 0.008)),
    Link("wrist", 1, 1.2, (0.0035, 0.0081, 0.0074, 0.0004, -0.0006, 0.0003),
         (-0.065, 0.004, -0.007), (0.09, -0.0035, 0.0052)),
    Link("hand", 0, 0.7, (0.0026, 0.0047, 0.0039, -0.0002, 0.00052, 0.0001),
         (-0.08, 0.011, 0.006), (0.13, 0.014, -0.045)),
)  # fmt: skip


@dataclass(frozen=True)
class Place:
    """Where a body is: its frame, its joint's point p and axis u, its centre c, and its end."""

    E: Frame
    p: Triple
    u: Triple
    c: Triple
    end: Triple


@dataclass(frozen=True)
class Moving:
    """How a body moves: ω, ω̇, and r̈ of its centre and of its end."""

    omega: Triple
    omega_dot: Triple
    c_ddot: Triple
    end_ddot: Triple


@equation
def places(q: Vector) -> list[Place]:
    """(2.8)–(2.12) R_k and E_k of every body as functions of q."""
    cos, sin = np.cos(q).tolist(), np.sin(q).tolist()
    frames, E, p = [], GROUND, NIL
    for k, link in enumerate(LINKS):
        E = about(E, link.axis, cos[k], sin[k])
        c = minus(p, grounded(E, link.a))
        end = plus(c, grounded(E, link.b))
        frames.append(Place(E, p, E[link.axis], c, end))
        p = end
    return frames


@equation
def outward(where: list[Place], v: Any, a: Any) -> list[Moving]:
    """(2.7) r̈ = r̈_p + ω̇ × x + ω × (ω × x), from the ground on, for rates v and q̈ = a.

    ω_k = ω_{k−1} + q̇_k u_k, and so ω̇_k = ω̇_{k−1} + q̈_k u_k + ω_{k−1} × q̇_k u_k.
    """
    bodies, omega, omega_dot, p_ddot = [], NIL, NIL, NIL
    for place, rate, change in zip(where, v, a, strict=True):
        carried = cross(omega, times(rate, place.u))
        omega_dot = plus(plus(omega_dot, times(change, place.u)), carried)
        omega = plus(omega, times(rate, place.u))
        ends = []
        for point in (place.c, place.end):
            x = minus(point, place.p)
            turning = plus(cross(omega_dot, x), cross(omega, cross(omega, x)))
            ends.append(plus(p_ddot, turning))
        bodies.append(Moving(omega, omega_dot, *ends))
        p_ddot = ends[1]
    return bodies


@equation
def inward(
    where: list[Place], moving: list[Moving], tip: Triple = NIL
) -> list[tuple[Triple, Triple]]:
    """(2.23) F_k = m (r̈_c − g) + F_{k+1} and (2.27), (2.33) M_k about p_k, from the hand on.

    M_k = J ω̇ + ω × J ω + (c − p) × m (r̈_c − g) + M_{k+1} + (end − p) × F_{k+1}: what body k − 1
    exerts on body k [N, N m]. tip: a force that acts at the hand's end.
    """
    wrenches: list[tuple[Triple, Triple]] = []
    F, M = times(-1.0, tip), NIL
    for link, place, at in zip(LINKS[::-1], where[::-1], moving[::-1], strict=True):
        omega, omega_dot = embodied(place.E, at.omega), embodied(place.E, at.omega_dot)
        D_dot = plus(link.turned(omega_dot), cross(omega, link.turned(omega)))
        x, y, z = at.c_ddot
        own = times(link.m, (x, y, z + G))
        M = plus(plus(M, cross(minus(place.end, place.p), F)), grounded(place.E, D_dot))
        M = plus(M, cross(minus(place.c, place.p), own))
        F = plus(F, own)
        wrenches.append((F, M))
    return wrenches[::-1]


@equation
def bias(where: list[Place], v: Any) -> list[Any]:
    """(2.27) The torques u_k · M_k [N m] that q̈ = 0 needs: M_ab q̈ᵇ + bias = torques."""
    wrenches = inward(where, outward(where, v, (0.0,) * 5))
    return [dot(place.u, M) for place, (_, M) in zip(where, wrenches, strict=True)]


@equation
def mass_matrix(where: list[Place]) -> Array:
    """(2.44) M_ab [kg m²], (5, 5): the torque at a that q̈_b = 1 alone needs, from rest.

    It moves the bodies from b on by r̈_c = u_b × (c − p_b) and ω̇ = u_b; body k then needs
    u_a · (J ω̇ + (c − p_a) × m r̈_c).
    """
    M = np.zeros((5, 5))
    for b, hinge in enumerate(where):
        force, moment = NIL, NIL  # of the bodies so far, the moment about the origin
        for k in range(4, b - 1, -1):
            link, place = LINKS[k], where[k]
            own = times(link.m, cross(hinge.u, minus(place.c, hinge.p)))
            spin = grounded(place.E, link.turned(embodied(place.E, hinge.u)))
            force = plus(force, own)
            moment = plus(plus(moment, spin), cross(place.c, own))
            M[k, b] = M[b, k] = dot(place.u, minus(moment, cross(place.p, force)))
    return M
