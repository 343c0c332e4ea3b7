"""The laws every hand-written mode in space obeys, each as the largest relative violation.

They are asked of a mode at states of its own, so that planted mistakes go through the same checks.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from textmech.reference.formalisms import lagrange
from textmech.reference.formalisms.derivative import along
from textmech.reference.system import Array, Mode, Vector

States = Iterable[tuple[float, Array, Array]]
Law = Callable[[Mode, States], float]
LIMIT = 1e-12  # of the largest term: the laws are algebra, only rounding may differ


def difference(a: Any, b: Any) -> float:
    """max |a − b| relative to the largest entry."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    return float(abs(a - b).max() / max(abs(a).max(), abs(b).max(), 1e-300))


@dataclass(frozen=True)
class InRates(Mode):
    """The mode's energies in coordinates and their rates, v = q̇, as (2.60) has them."""

    of: Mode
    rows: Callable[[Vector], Any]  # f_a (r, m), on q̇

    def T(self, t: Any, q: Vector, v: Vector) -> Any:
        return self.of.T(t, q, v)

    def U(self, t: Any, q: Vector) -> Any:
        return self.of.U(t, q)

    def f_a(self, t: Any, q: Vector) -> Vector:
        return np.asarray(self.rows(q)).reshape(-1, len(q))

    def g(self, t: Any, q: Vector) -> Vector:
        return np.zeros(len(self.f_a(t, q)))


# What binds the rates q̇, typed again, and the reactions that its multipliers are.
def _rows(mode: Any) -> Callable[[Any], Any]:
    """(2.19) on (ẋ, ẏ, θ̇, β̇, φ̇)."""
    R = mode.R
    return lambda q: [[1, 0, 0, 0, -R * np.cos(q[2])], [0, 1, 0, 0, -R * np.sin(q[2])]]


ROWS: dict[str, Callable[[Mode], Callable[[Any], Any]]] = {
    "heavy_top": lambda top: lambda q: [],
    "tilting_disk": _rows,
    "tilting_ring": _rows,
    "torque_free": lambda body: lambda q: [[0, 0, 0, *q[3:]]],  # e · ė = 0: it stays a unit
}
MULTIPLIERS = dict.fromkeys(("tilting_disk", "tilting_ring"), ("touch.fx", "touch.fy"))


def lagrangian(name: str) -> Law:
    """Explicit accelerations and reactions against (2.60) over T and U, with v = q̇."""

    def law(mode: Mode, states: States) -> float:
        rated, worst = InRates(mode, ROWS[name](mode)), 0.0
        for t, q, v in states:
            q_dot, a = mode.rates(t, q, v), mode.accelerations(t, q, v)
            q_ddot = along(mode.rates, (t, q, v), (1.0, q_dot, a))
            derived, lam = lagrange.multipliers(rated, t, q, q_dot)
            worst = max(worst, difference(q_ddot, derived))
            if name in MULTIPLIERS:
                reactions = mode.reactions(t, q, v)
                worst = max(worst, difference([reactions[x] for x in MULTIPLIERS[name]], lam))
        return worst

    return law


def free_bodies(mode: Mode, states: States) -> float:
    """(2.23) m r̈_c = F, and (2.27) d/dt (R J ω) = M_c in ground axes, with the mode's reactions."""
    worst = 0.0
    for t, q, v in states:
        q_dot, a = mode.rates(t, q, v), mode.accelerations(t, q, v)
        for body, mass in mode.masses.items():

            def momenta(t: Any, q: Any, v: Any, body: str = body, mass: Any = mass) -> Any:
                pose = mode.poses(t, q, v)[body]
                spin = matrix(pose[3:7]) @ (mass.J @ np.array(pose[10:]))
                return np.concatenate([mass.m * np.array(pose[7:10]), spin])

            change, F, M = along(momenta, (t, q, v), (1.0, q_dot, a)), np.zeros(3), np.zeros(3)
            centre, terms = np.array(mode.poses(t, q, v)[body][:3]), [abs(change).max()]
            for at, force in _forces(mode, t, q, v, body):
                F, M = F + force, M + np.cross(at - centre, force)
                terms += [abs(force).max()]
            worst = max(worst, float(abs(change - np.concatenate([F, M])).max() / max(terms)))
    return worst


def _forces(mode: Mode, t: float, q: Array, v: Array, body: str) -> Iterable[tuple[Array, Array]]:
    """Points and forces: the loads, and the reactions at the cuts."""
    for load in mode.loads(t, q, v):
        if load.body == body:
            yield np.array(load.at), np.array(load.force)
    known = mode.reactions(t, q, v)
    for cut in mode.cuts(t, q):
        force = sum(
            known[name] * np.array(u) for name, u in zip(cut.names, cut.directions, strict=True)
        )
        yield np.array(cut.at), np.asarray(force if cut.b == body else -force)


def matrix(e: Any) -> Any:
    """R (3, 3), whose columns are the body axes in ground axes, of a unit quaternion."""
    w, x, y, z = e
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def rates_of_poses(mode: Mode, states: States) -> float:
    """(2.6) ṙ_c, and (2.3) Rᵀ Ṙ = the matrix of ω in body axes; |e| = 1."""
    worst = 0.0
    for t, q, v in states:
        q_dot = mode.rates(t, q, v)
        for body, pose in mode.poses(t, q, v).items():
            moved = along(
                lambda t, q, v=v, body=body: np.array(mode.poses(t, q, v)[body][:3]),
                (t, q), (1.0, q_dot),
            )  # fmt: skip
            R_dot = along(
                lambda t, q, v=v, body=body: matrix(mode.poses(t, q, v)[body][3:7]),
                (t, q), (1.0, q_dot),
            )  # fmt: skip
            turns = matrix(pose[3:7]).T @ R_dot
            worst = max(worst, difference(moved, pose[7:10]))
            worst = max(worst, difference([turns[2, 1], turns[0, 2], turns[1, 0]], pose[10:]))
            worst = max(worst, abs(float(np.linalg.norm(pose[3:7])) - 1.0))
    return worst


def koenig(mode: Mode, states: States) -> float:
    """(2.54) T = Σ ½ m ṙ_c² + ½ ω · J ω of the poses."""
    worst = 0.0
    for t, q, v in states:
        total = 0.0
        for body, pose in mode.poses(t, q, v).items():
            mass, omega = mode.masses[body], np.array(pose[10:])
            total += mass.m * float(np.dot(pose[7:10], pose[7:10])) / 2
            total += float(omega @ mass.J @ omega) / 2
        worst = max(worst, difference(total, mode.T(t, q, mode.rates(t, q, v))))
    return worst


def energy(mode: Mode, states: States) -> float:
    """(2.51) T + U stays, relative to the largest term p_a q̈ᵃ of its change."""
    worst = 0.0
    for t, q, v in states:
        q_dot, a = mode.rates(t, q, v), mode.accelerations(t, q, v)
        total = lambda t, q, v: mode.T(t, q, mode.rates(t, q, v)) + mode.U(t, q)  # noqa: E731
        q_ddot = along(mode.rates, (t, q, v), (1.0, q_dot, a))
        terms = np.abs(lagrange.momentum(mode, t, q, q_dot) * q_ddot)
        worst = max(worst, float(abs(along(total, (t, q, v), (1.0, q_dot, a))) / terms.max()))
    return worst


def rolling(mode: Mode, states: States) -> float:
    """(2.15) f_a v = g."""
    worst = 0.0
    for t, q, v in states:
        rows = mode.f_a(t, q)
        worst = max(worst, float(abs(rows @ v - mode.g(t, q)).max() / abs(rows * v).max()))
    return worst


COMMON: Sequence[Law] = (free_bodies, rates_of_poses, koenig, energy)


def broken(violation: float) -> bool:
    """Whether a violation is more than rounding."""
    return not violation <= LIMIT
