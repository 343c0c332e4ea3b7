"""The laws every mode of every system obeys, each as the largest relative violation.

They are plain functions, so that planted mistakes can be run through the very same checks. A law
is asked of a system `at` a mode, whose random admissible states it draws.
"""

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from textmech.reference.formalisms import energy, lagrange, newton_euler
from textmech.reference.formalisms.derivative import along
from textmech.reference.motion.follow import follow
from textmech.reference.system import Array, System

from ..machines.examples import MODES, PARAMETERS, example
from ..machines.states import states
from ..scenes.starts import STARTS
from .unknowns import APPLIED, MULTIPLIERS, RESIDUALS

At = tuple[str, str]
"""The name of a system, and of one of its modes."""
Law = Callable[[System, At], float]


def difference(a: Any, b: Any, scale: float = 0.0) -> float:
    """max |a − b| relative to the largest entry, or to `scale` if that is larger."""
    a, b = np.asarray(a, dtype=float), np.asarray(b, dtype=float)
    return float(abs(a - b).max() / max(abs(a).max(), abs(b).max(), scale, 1e-300))


def equations(system: System, at: At) -> float:
    """Explicit accelerations = (2.60), and (2.44) where there are no constraints."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        a = mode.accelerations(t, q, v)
        found, lam = lagrange.multipliers(mode, t, q, v)
        # Of what stands still, beside what holds it: all masses are about 1.
        held = 0.0 if a.any() else max(map(abs, lam.tolist()), default=0.0)
        worst = max(worst, difference(a, found, held))
        if at not in MULTIPLIERS:
            worst = max(worst, difference(a, lagrange.accelerations(mode, t, q, v)))
    return worst


def multipliers(system: System, at: At) -> float:
    """Hand-written reactions = λ of (2.60)."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        reactions, lam = mode.reactions(t, q, v), lagrange.multipliers(mode, t, q, v)[1]
        written = [reactions[key] for key in MULTIPLIERS[at]]
        assert len(lam) == len(written)
        worst = max(worst, difference(written, lam))
    return worst


def free_cut(system: System, at: At) -> float:
    """Explicit accelerations = (2.23), (2.27) solved for q̈, and balance the free-cut bodies."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        a = mode.accelerations(t, q, v)
        # What is at rest has no acceleration to compare with: 1 m/s² or rad/s² then.
        worst = max(worst, difference(a, newton_euler.accelerations(mode, t, q, v)[0], 1.0))
        worst = max(worst, newton_euler.balance(mode, t, q, v, a).share())
    return worst


def reactions(system: System, at: At) -> float:
    """Hand-written reactions = those of (2.23), (2.27), solved for and balanced."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        written = mode.reactions(t, q, v)
        _, solved = newton_euler.accelerations(mode, t, q, v)
        balanced = newton_euler.balance(mode, t, q, v, mode.accelerations(t, q, v)).reactions
        for found in (solved, balanced):
            assert written.keys() - found.keys() == set(APPLIED.get(at, ()))
            keys = list(found)
            worst = max(worst, difference([written[k] for k in keys], [found[k] for k in keys]))
    return worst


def power(system: System, at: At) -> float:
    """(2.51) The power balance, relative to its largest term."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        a = mode.accelerations(t, q, v)
        terms = [
            lagrange.momentum(mode, t, q, v) * a,
            lagrange.gradient(lambda q, t=t: mode.U(t, q), q) * v,
            np.asarray(mode.Q4(t, q, v)) * v,
        ]
        # A wheel left alone changes no energy at all: then 1e-300 stands for "nothing".
        largest = max(abs(np.array(terms)).max(), 1e-300)
        worst = max(worst, abs(energy.power_balance(mode, t, q, v)) / largest)
    return worst


def rates_of_poses(system: System, at: At) -> float:
    """(2.6) Velocities of `poses` = time derivatives of its positions, body by body."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        for body, pose in mode.poses(t, q, v).items():
            moved = along(
                lambda t, q, v=v, body=body: mode.poses(t, q, v)[body][:3], (t, q), (1.0, v)
            )
            worst = max(worst, difference(moved, pose[3:]))
    return worst


def koenig(system: System, at: At) -> float:
    """(2.54) T = Σ ½ m ṙ_c² + ½ J ω² of the poses."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        total = 0.0
        for body, (_, _, _, vx, vy, omega) in mode.poses(t, q, v).items():
            mass = mode.masses[body]
            total += mass.m * (vx**2 + vy**2) / 2 + (mass.J or 0.0) * omega**2 / 2
        worst = max(worst, difference(total, mode.T(t, q, v)))
    return worst


def constraints(system: System, at: At) -> float:
    """(2.14) f = 0 in the states and f_a = ∂f/∂q, so that f_a q̇ᵃ = g."""
    worst, mode = 0.0, system.modes[at[1]]
    for t, q, v in states(*at):
        f, rows = mode.f(t, q), mode.f_a(t, q)
        assert len(rows) == len(mode.g(t, q)) == len(MULTIPLIERS[at])
        assert len(f) == RESIDUALS.get(at, len(rows))
        if len(f):
            slopes = [along(lambda q, t=t: mode.f(t, q), (q,), (e,)) for e in np.eye(len(q))]
            worst = max(worst, difference(np.transpose(slopes), rows[: len(f)]), abs(f).max())
        # What stands still has no rate to compare with: 1e-300 stands for "nothing" again.
        size = max(abs(rows * v).max(), 1e-300)
        worst = max(worst, abs(rows @ v - mode.g(t, q)).max() / size)
    return worst


def start(system: System, at: At) -> float:
    """Start as the case says: poses beyond their margin, constraints and their rates."""
    name, q, v = system.start()
    mode = system.modes[name]
    poses = mode.poses(0.0, q, v)
    beyond = [abs(poses[body][i] - value) - margin for body, i, value, margin in STARTS[at[0]]]
    open_ = [*abs(mode.f(0.0, q)), *abs(mode.f_a(0.0, q) @ v - mode.g(0.0, q))]
    return float(max(0.0, *beyond, *open_))


def closed_form(system: System, at: At) -> float:
    """Closed form: the start at t = 0; its v is q̇ and q̈ = `accelerations`, by differences."""
    known, moments = _closed(system, 0.0), (0.37, 1.1, 2.9, 4.9)  # no system has an event there
    worst = max(difference(known[i], system.start()[i + 1], 1.0) for i in range(2))
    modes = follow(system, np.array([0.0, *moments])).modes[1:]
    for t, name in zip(moments, modes, strict=True):
        q_dot, q_ddot = (_slope(lambda s, i=i: _closed(system, s)[i], t) for i in range(2))
        q, v = _closed(system, t)
        worst = max(worst, difference(q_dot, v, 1.0))
        worst = max(worst, difference(q_ddot, system.modes[name].accelerations(t, q, v), 1.0))
    return worst


def _closed(system: System, t: float) -> tuple[Array, Array]:
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
_STARTING = {(name, example(name).start()[0]) for name in PARAMETERS}
_NO_CLOSED_FORM = {
    "anisotropic_drift", "ball_on_rope", "compass_walker", "disk_on_disk", "double_pendulum",
    "elastic_pendulum", "four_bar", "light_feet", "rhombus", "running_gait", "smooth_dynamometer",
    "smooth_growing_force", "sliding_ladder", "spring_mass_jump", "stopped_pendulum",
    "stribeck_drive", "tipping_block", "trunk_on_legs", "turning_sled",
}  # fmt: skip
_FREE = {
    "charge_in_field", "cradle", "elastic_pendulum", "falling_drag", "rhombus", "running_gait",
    "spring_mass_damper", "spring_mass_jump", "turning_sled",
}  # fmt: skip
# The laws that say nothing about a mode without constraints or reactions, and those of the whole
# system, which are asked where it starts.
ONLY: dict[Law, set[At]] = {
    multipliers: set(MULTIPLIERS),
    constraints: set(MULTIPLIERS),
    reactions: {at for at in MODES if at[0] not in _FREE and at != ("ball_on_rope", "flies")},
    start: _STARTING,
    closed_form: {at for at in _STARTING if at[0] not in _NO_CLOSED_FORM},
}


def broken(law: Law, violation: float) -> bool:
    """Whether a violation is more than rounding."""
    return not violation <= LIMITS.get(law, LIMIT)
