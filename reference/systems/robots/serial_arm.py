"""The ingredients of the five-axis robot (fig 2.10), whatever drives or holds it.

q = (q₁ … q₅) as of its arm. Joint k, named qk, joins body k − 1 to body k; the base to the ground.
"""

from typing import Any

import numpy as np

from ...system import Array, Cut, Load, Mass, Mode, Pose, Vector
from .arm import LINKS, G, Moving, Place, inward, places
from .triples import NIL, Triple, cross, dot, embodied, minus, plus, times

NAMES = tuple(link.name for link in LINKS)
AXES = ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))


class SerialArm(Mode):
    """Five bodies in series on hinges without friction, under their weight."""

    coordinates = ("q1", "q2", "q3", "q4", "q5")

    def __post_init__(self) -> None:
        J = [link.turned(axis) for link in LINKS for axis in AXES]
        tensors = np.array(J).reshape(5, 3, 3)
        masses = {link.name: Mass(link.m, J) for link, J in zip(LINKS, tensors, strict=True)}
        object.__setattr__(self, "masses", masses)

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        """(2.54) T = Σ ½ m ṙ_c² + ½ J_ik ω_i ω_k [J], by the velocities that each rate alone gives.

        ṙ_c = Σ_j q̇_j u_j × (c − p_j), and ω = Σ_j q̇_j u_j in body axes.
        """
        where, energy = places(q), 0.0
        for k, (link, place) in enumerate(zip(LINKS, where, strict=True)):
            hinges = where[: k + 1]
            c_dot = np.array([cross(h.u, minus(place.c, h.p)) for h in hinges]).T @ v[: k + 1]
            omega = np.array([embodied(place.E, h.u) for h in hinges]).T @ v[: k + 1]
            spin = omega * (self.masses[link.name].J @ omega)
            energy = energy + (link.m * np.sum(c_dot**2, axis=0) + np.sum(spin, axis=0)) / 2
        return energy

    def U(self, t: Any, q: Vector) -> Any:
        """(2.45) U = Σ m g z_c [J]."""
        rows = zip(LINKS, places(q), strict=True)
        return sum(link.m * G * place.c[2] for link, place in rows)

    def poses(self, t: Any, q: Vector, v: Vector) -> dict[str, Pose]:
        """(2.6), (2.8)–(2.12) R_k, E_k, ṙ = ṙ_p + ω × x and ω = ω_{k,k−1} + ω_{k−1,0}.

        The quaternion is the product of those of the turns: it is smooth in q, over any turns.
        """
        (*cos,), (*sin,) = np.cos(q / 2).tolist(), np.sin(q / 2).tolist()
        poses: dict[str, Pose] = {}
        w, x = 1.0, NIL
        omega, p_dot = NIL, NIL
        for k, (link, place) in enumerate(zip(LINKS, places(q), strict=True)):
            turn = times(sin[k], AXES[link.axis])
            w, x = (
                w * cos[k] - dot(x, turn),
                plus(plus(times(w, turn), times(cos[k], x)), cross(x, turn)),
            )
            omega = plus(omega, times(v[k], place.u))
            c_dot = plus(p_dot, cross(omega, minus(place.c, place.p)))
            p_dot = plus(p_dot, cross(omega, minus(place.end, place.p)))
            poses[link.name] = (*place.c, w, *x, *c_dot, *embodied(place.E, omega))
        return poses

    def joint_reactions(
        self, where: list[Place], moving: list[Moving], tip: Triple = NIL
    ) -> dict[str, float]:
        """(2.23), (2.27) F_k and M_k about p_k of every joint, on its second body [N, N m].

        All of M_k: what a drive exerts about the hinge's axis is in it.
        """
        wrenches = inward(where, moving, tip)
        return {
            f"{joint}.{field}": float(x)
            for joint, (F, M) in zip(self.coordinates, wrenches, strict=True)
            for field, x in zip(("fx", "fy", "fz", "mx", "my", "mz"), (*F, *M), strict=True)
        }

    def loads(self, t: float, q: Array, v: Array) -> list[Load]:
        """(2.81) weights m g at the centres."""
        rows = zip(LINKS, places(q), strict=True)
        return [Load(link.name, place.c, (0.0, 0.0, -link.m * G)) for link, place in rows]

    def cuts(self, t: float, q: Array) -> list[Cut]:
        """The hinges: a force each, and moments about the body's two axes across the hinge's."""
        cuts = []
        for k, (link, place) in enumerate(zip(LINKS, places(q), strict=True)):
            across = tuple(place.E[(link.axis + i) % 3] for i in (1, 2))
            joint = self.coordinates[k]
            names = tuple(f"{joint}.{field}" for field in ("fx", "fy", "fz", "across1", "across2"))
            before = NAMES[k - 1] if k else None
            cuts.append(Cut(names, before, link.name, place.p, AXES, moments=across))
        return cuts
