"""The laws every system obeys, each as the largest relative violation over some states.

They are plain functions, so that planted mistakes can be run through the very same checks.
"""

from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np

from textmech.reference.formalisms import energy, lagrange, newton_euler
from textmech.reference.formalisms.derivative import along
from textmech.reference.system import Array, Mode

from .examples import MULTIPLIERS, STARTS

States = Iterable[tuple[float, Array, Array]]
Law = Callable[[Mode, str, States], float]


def difference(a: Any, b: Any, scale: float = 0.0) -> float:
    """max |a − b| relative to the largest entry, or to `scale` if that is larger."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    return float(abs(a - b).max() / max(abs(a).max(), abs(b).max(), scale, 1e-300))


def equations(system: Mode, name: str, states: States) -> float:
    """Explicit accelerations = (2.60), and (2.44) where there are no constraints."""
    worst = 0.0
    for t, q, v in states:
        a = system.accelerations(t, q, v)
        worst = max(worst, difference(a, lagrange.multipliers(system, t, q, v)[0]))
        if name not in MULTIPLIERS:
            worst = max(worst, difference(a, lagrange.accelerations(system, t, q, v)))
    return worst


def multipliers(system: Mode, name: str, states: States) -> float:
    """Hand-written reactions = λ of (2.60)."""
    worst = 0.0
    for t, q, v in states:
        reactions, lam = system.reactions(t, q, v), lagrange.multipliers(system, t, q, v)[1]
        written = [reactions[key] for key in MULTIPLIERS[name]]
        assert len(lam) == len(written)
        worst = max(worst, difference(written, lam))
    return worst


def free_cut(system: Mode, name: str, states: States) -> float:
    """Explicit accelerations = (2.23), (2.27) solved for q̈, and balance the free-cut bodies."""
    worst = 0.0
    for t, q, v in states:
        a = system.accelerations(t, q, v)
        # A wheel at rest has no acceleration to compare with: 1 m/s² or rad/s² then.
        worst = max(worst, difference(a, newton_euler.accelerations(system, t, q, v)[0], 1.0))
        worst = max(worst, newton_euler.balance(system, t, q, v, a)[0])
    return worst


def reactions(system: Mode, name: str, states: States) -> float:
    """Hand-written reactions = those of (2.23), (2.27), solved for and balanced."""
    worst = 0.0
    for t, q, v in states:
        written = system.reactions(t, q, v)
        _, solved = newton_euler.accelerations(system, t, q, v)
        _, balanced = newton_euler.balance(system, t, q, v, system.accelerations(t, q, v))
        for found in (solved, balanced):
            largest = max(map(abs, found.values()))
            wrong = max(abs(written[key] - found[key]) for key in written)
            worst = max(worst, wrong / largest)
    return worst


def power(system: Mode, name: str, states: States) -> float:
    """(2.51) The power balance, relative to its largest term."""
    worst = 0.0
    for t, q, v in states:
        a = system.accelerations(t, q, v)
        terms = [
            lagrange.momentum(system, t, q, v) * a,
            lagrange.gradient(lambda q, t=t: system.U(t, q), q) * v,
            np.asarray(system.Q4(t, q, v)) * v,
        ]
        # A wheel left alone changes no energy at all: then 1e-300 stands for "nothing".
        largest = max(abs(np.array(terms)).max(), 1e-300)
        worst = max(worst, abs(energy.power_balance(system, t, q, v)) / largest)
    return worst


def rates_of_poses(system: Mode, name: str, states: States) -> float:
    """(2.6) Velocities of `poses` = time derivatives of its positions, body by body."""
    worst = 0.0
    for t, q, v in states:
        for body, pose in system.poses(t, q, v).items():
            moved = along(
                lambda t, q, v=v, body=body: system.poses(t, q, v)[body][:3], (t, q), (1.0, v)
            )
            worst = max(worst, difference(moved, pose[3:]))
    return worst


def koenig(system: Mode, name: str, states: States) -> float:
    """(2.54) T = Σ ½ m ṙ_c² + ½ J ω² of the poses."""
    worst = 0.0
    for t, q, v in states:
        total = 0.0
        for body, (_, _, _, vx, vy, omega) in system.poses(t, q, v).items():
            mass = system.masses[body]
            total += mass.m * (vx**2 + vy**2) / 2 + (mass.J or 0.0) * omega**2 / 2
        worst = max(worst, difference(total, system.T(t, q, v)))
    return worst


def constraints(system: Mode, name: str, states: States) -> float:
    """(2.14) f = 0 in the states and f_a = ∂f/∂q, so that f_a q̇ᵃ = g."""
    worst = 0.0
    for t, q, v in states:
        f, rows = system.f(t, q), system.f_a(t, q)
        assert len(f) == len(rows) == len(system.g(t, q)) == len(MULTIPLIERS[name])
        slopes = [along(lambda q, t=t: system.f(t, q), (q,), (e,)) for e in np.eye(len(q))]
        worst = max(worst, difference(np.transpose(slopes), rows), abs(f).max())
        worst = max(worst, abs(rows @ v - system.g(t, q)).max() / abs(rows * v).max())
    return worst


def start(system: Mode, name: str, states: States) -> float:
    """Start as the case says: poses beyond their margin, constraints and their rates."""
    q, v = system.start()
    poses = system.poses(0.0, q, v)
    beyond = [abs(poses[body][i] - value) - margin for body, i, value, margin in STARTS[name]]
    open_ = [*abs(system.f(0.0, q)), *abs(system.f_a(0.0, q) @ v - system.g(0.0, q))]
    return float(max(0.0, *beyond, *open_))


def closed_form(system: Mode, name: str, states: States) -> float:
    """Closed form: the start at t = 0; its v is q̇ and q̈ = `accelerations`, by differences."""
    known = _closed(system, 0.0)
    worst = max(difference(known[i], system.start()[i], 1.0) for i in range(2))
    for t in (0.37, 1.1, 2.9, 4.9):
        q_dot, q_ddot = (_slope(lambda s, i=i: _closed(system, s)[i], t) for i in range(2))
        q, v = _closed(system, t)
        worst = max(worst, difference(q_dot, v, 1.0))
        worst = max(worst, difference(q_ddot, system.accelerations(t, q, v), 1.0))
    return worst


def _closed(system: Mode, t: float) -> tuple[Array, Array]:
    known = system.closed_form(t)
    assert known is not None
    return known


def _slope(function: Callable[[float], Array], t: float) -> Array:
    """Central difference, extrapolated twice: error about h⁶, and 1e-16/h of rounding."""
    h = 4e-3
    d = [(function(t + s) - function(t - s)) / (2 * s) for s in (h, h / 2, h / 4)]
    e = [(4 * d[1] - d[0]) / 3, (4 * d[2] - d[1]) / 3]
    return (16 * e[1] - e[0]) / 15


LIMIT = 1e-12  # of the largest term
LIMITS: dict[Law, float] = {closed_form: 1e-10}  # what the differences leave

LAWS: Sequence[Law] = (
    equations, multipliers, free_cut, reactions, power, rates_of_poses, koenig, constraints, start,
    closed_form,
)  # fmt: skip
# The laws that say nothing about a system without constraints, reactions or a closed form.
ONLY: dict[Law, set[str]] = {
    multipliers: set(MULTIPLIERS),
    constraints: set(MULTIPLIERS),
    reactions: {"rolling_wheel", "bar_pendulum", "double_pendulum", "four_bar"},
    closed_form: {"rolling_wheel", "bar_pendulum", "spring_mass_damper"},
}


def broken(law: Law, violation: float) -> bool:
    """Whether a violation is more than rounding."""
    return not violation <= LIMITS.get(law, LIMIT)
