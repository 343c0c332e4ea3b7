"""What the reference says of its own error: every answer that shares no algebra, compared.

Bounds are relative to the size of what is compared. They are 1e-12, or the rounding floor
2.2e-16 × steps where that is larger: a motion of many steps cannot be known better.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from cases.case import Case
from cases.observe import observe
from cases.trajectory import Trajectory
from reference.formalisms import energy, lagrange, newton_euler
from reference.explicit import dormand_prince
from reference.implicit import radau
from reference.integrator import Integration
from reference.mechanism import Mechanism
from reference.motion import TOLERANCE, instants, integrate, motion
from reference.system import Array, System

OWN_ERROR = 1e-12  # of the motion's size: what is asked of a reference
LAW = 1e-12  # of the largest term: the laws are algebra, only rounding may differ
GENERATED = 1e-9  # hand-written against generated motion
ROUNDING = 2.2e-16
STAGES = 7  # Radau IIA of order 13: five stages need twice the time at this tolerance
QUARTERS = 4  # steps a sample at least: longer ones, of order 13, lose up to two digits here
SHARE = 0.01  # of the smallest tolerance: what the reference's own error may take


@dataclass(frozen=True)
class Check:
    """One comparison: `difference` relative to the size, and the bound it must keep."""

    name: str
    difference: float
    bound: float

    @property
    def holds(self) -> bool:
        return bool(self.difference <= self.bound)  # false for NaN


def certify(
    case: Case,
    system: System,
    generated: Mechanism,
    integration: Integration,
    trajectory: Trajectory,
) -> tuple[Check, ...]:
    """All checks that apply to the case."""
    y, times = integration.y, case.times
    floor = ROUNDING * integration.steps
    own = max(OWN_ERROR, floor)
    implicit = motion(system, times, _implicit(system, times), generated)
    others = {"implicit integrator": implicit}
    checks = [Check("implicit integrator", difference(trajectory, implicit), own)]
    if system is not generated:
        checks.append(Check("start as assembled", _start(system, generated), OWN_ERROR))
        other = integrate(generated, times, dormand_prince, tolerance=TOLERANCE)
        others["generated"] = motion(generated, times, other.y, generated)
        checks.append(
            Check("generated motion", difference(trajectory, others["generated"]), GENERATED)
        )
        checks.append(
            Check("generated reactions", _reactions(trajectory, others["generated"]), GENERATED)
        )
    closed = closed_form(system, times)
    if closed is not None:
        others["closed form"] = motion(system, times, closed, generated)
        checks.append(Check("closed form", difference(trajectory, others["closed form"]), own))
    checks += _laws(system, system is not generated, times, y)
    checks.append(Check("constraint drift", _drift(system, times, y), own))
    checks.append(Check("share of the tolerances", _share(case, trajectory, others), SHARE))
    return tuple(checks)


def _implicit(system: System, times: Array) -> Array:
    """y (N, 2n) by the implicit integrator."""
    finer = np.linspace(times[0], times[-1], (len(times) - 1) * QUARTERS + 1)
    return integrate(system, finer, radau, tolerance=TOLERANCE, stages=STAGES).y[::QUARTERS]


def difference(one: Trajectory, other: Trajectory) -> float:
    """Largest difference of places, angles, velocities and rates, each relative to its size."""
    a = np.concatenate(list(one.states.values()))
    b = np.concatenate(list(other.states.values()))
    groups = ([0, 1], [2], [3, 4], [5])
    return max(_relative(a[:, columns], b[:, columns]) for columns in groups)


def _relative(a: Array, b: Array) -> float:
    size = np.max(np.abs(a))
    largest = np.max(np.abs(a - b))
    return float(largest / size) if size > 0 else float(largest)


def _reactions(one: Trajectory, other: Trajectory) -> float:
    shared = one.reactions.keys() & other.reactions.keys()
    size = max((np.max(np.abs(one.reactions[k])) for k in shared), default=0.0)
    largest = max(
        (np.max(np.abs(one.reactions[k] - other.reactions[k])) for k in shared), default=0.0
    )
    return float(largest / size) if size > 0 else 0.0


def _start(system: System, generated: Mechanism) -> float:
    """A hand-written system states its own start: it must be the case's."""
    q, v = generated.place(system.poses(0.0, *system.start()))
    q0, v0 = generated.start()
    return max(_relative(q0, q), _relative(v0, v))


def closed_form(system: System, times: Array) -> Array | None:
    """y (N, 2n) by known functions, or None."""
    rows = [system.closed_form(t) for t in times.tolist()]
    if any(row is None for row in rows):
        return None
    return np.array([np.concatenate(row) for row in rows if row is not None])


def _laws(system: System, written: bool, times: Array, y: Array) -> Iterator[Check]:
    """The explicit accelerations against each formalism along the motion.

    Accelerations are relative to the largest of the motion, powers to the largest Σ |p_a q̈ᵃ|.
    """
    size, power = 0.0, 0.0
    derived, balance, unbalanced, reactions = 0.0, 0.0, 0.0, 0.0
    for t, q, v in instants(times, y):
        a = system.accelerations(t, q, v)
        size = max(size, float(np.max(np.abs(a))))
        power = max(power, float(np.sum(np.abs(lagrange.momentum(system, t, q, v) * a))))
        derived = max(derived, float(np.max(np.abs(lagrange.multipliers(system, t, q, v)[0] - a))))
        balance = max(balance, abs(energy.power_balance(system, t, q, v)))
        if written:
            residual, forces = newton_euler.balance(system, t, q, v, a)
            unbalanced = max(unbalanced, residual)
            reactions = max(reactions, _other_forces(forces, system.reactions(t, q, v)))
    yield Check("accelerations by Lagrange with multipliers (2.60)", derived / (size or 1.0), LAW)
    yield Check("power balance (2.51)", balance / (power or 1.0), LAW)
    if written:
        yield Check("Newton-Euler balance (2.23), (2.27)", unbalanced, LAW)
        yield Check("reactions by Newton-Euler", reactions, LAW)


def _other_forces(cut_free: Mapping[str, float], written: Mapping[str, float]) -> float:
    size = max((abs(force) for force in cut_free.values()), default=0.0)
    worst = max((abs(cut_free[name] - force) for name, force in written.items()), default=0.0)
    return worst / (size or 1.0)


def _drift(system: System, times: Array, y: Array) -> float:
    """Residual of (2.14) along the motion, relative to the size of the coordinates."""
    largest = [np.max(np.abs(system.f(t, q)), initial=0.0) for t, q, _ in instants(times, y)]
    n = y.shape[1] // 2
    return float(max(largest) / max(1e-300, np.max(np.abs(y[:, :n]))))


def _share(case: Case, trajectory: Trajectory, others: dict[str, Trajectory]) -> float:
    """The reference's own error against the smallest allow or reach of any quantity."""
    worst = 0.0
    for name, allowed in case.allow.items():
        bars = [bars[name] for bars in case.reach.values() if name in bars]
        bars += [] if allowed is None else [allowed]
        own = observe(case.scene, trajectory, name)
        error = max(np.max(np.abs(own - observe(case.scene, o, name))) for o in others.values())
        worst = max([worst, *(float(error) / bar for bar in bars)])
    return worst
