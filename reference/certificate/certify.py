"""What the reference says of its own error: every answer that shares no algebra, compared.

Bounds are relative to the size of what is compared. They are 1e-12, or the rounding floor
2.2e-16 × steps where that is larger: a motion of many steps cannot be known better.
"""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import numpy as np

from ...cases.case import Case
from ...cases.observe import observe
from ...cases.quantity import table
from ...cases.trajectory import Trajectory
from ..formalisms import energy, lagrange, newton_euler
from ..generated.mechanism import Mechanism
from ..integrators.explicit import dormand_prince
from ..integrators.implicit import radau
from ..integrators.march import Integration
from ..motion.smooth import TOLERANCE, instants, integrate, motion
from ..system import Array, System
from .agreement import difference, reactions, relative, worst

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
            Check("generated reactions", reactions(trajectory, others["generated"]), GENERATED)
        )
    closed = closed_form(system, times)
    if closed is not None:
        others["closed form"] = motion(system, times, closed, generated)
        checks.append(Check("closed form", difference(trajectory, others["closed form"]), own))
    checks += laws(system, generated, times, y, written=system is not generated)
    checks.append(Check("constraint drift", _drift(system, times, y), own))
    checks.append(Check("share of the tolerances", share(case, trajectory, others), SHARE))
    return tuple(checks)


def _implicit(system: System, times: Array) -> Array:
    """y (N, 2n) by the implicit integrator."""
    finer = np.linspace(times[0], times[-1], (len(times) - 1) * QUARTERS + 1)
    return integrate(system, finer, radau, tolerance=TOLERANCE, stages=STAGES).y[::QUARTERS]


def _start(system: System, generated: Mechanism) -> float:
    """A hand-written system states its own start: it must be the case's."""
    q, v = generated.place(system.poses(0.0, *system.start()))
    q0, v0 = generated.start()
    return worst([relative(q0, q), relative(v0, v)])


def closed_form(system: System, times: Array) -> Array | None:
    """y (N, 2n) by known functions, or None."""
    rows = [system.closed_form(t) for t in times.tolist()]
    if any(row is None for row in rows):
        return None
    return np.array([np.concatenate(row) for row in rows if row is not None])


def laws(
    system: System, generated: Mechanism, times: Array, y: Array, *, written: bool
) -> Iterator[Check]:
    """The explicit accelerations against each formalism along the motion.

    Differences are relative to the largest term: of the accelerations and powers themselves, or of
    those that each force alone would give, since at rest the forces cancel but for rounding.
    """
    bound = len(system.f_a(0.0, y[0, : y.shape[1] // 2])) > 0
    sizes, powers, derived, balances, unbalanced, forces = [], [], [], [], [], []
    for t, q, v in instants(times, y):
        a = system.accelerations(t, q, v)
        alone = generated.terms(t, *generated.place(system.poses(t, q, v)))
        sizes += [worst(np.abs(a)), alone[0]]
        powers += [float(np.sum(np.abs(lagrange.momentum(system, t, q, v) * a))), alone[1]]
        if bound:
            derived.append(worst(np.abs(lagrange.multipliers(system, t, q, v)[0] - a)))
        else:
            derived.append(worst(np.abs(lagrange.accelerations(system, t, q, v) - a)))
        balances.append(abs(energy.power_balance(system, t, q, v)))
        if written:
            residual, cut_free = newton_euler.balance(system, t, q, v, a)
            unbalanced.append(residual)
            forces.append(_other_forces(cut_free, system.reactions(t, q, v)))
    size, power = worst(sizes) or 1.0, worst(powers) or 1.0
    by = "Lagrange with multipliers (2.60)" if bound else "Lagrange (2.44)"
    yield Check(f"accelerations by {by}", worst(derived) / size, LAW)
    yield Check("power balance (2.51)", worst(balances) / power, LAW)
    if written:
        yield Check("Newton-Euler balance (2.23), (2.27)", worst(unbalanced), LAW)
        yield Check("reactions by Newton-Euler", worst(forces), LAW)


def _other_forces(cut_free: Mapping[str, float], written: Mapping[str, float]) -> float:
    """Relative to the largest; friction that slides is an applied force, and no cut finds it."""
    size = worst(abs(force) for force in cut_free.values())
    shared = [name for name in written if name in cut_free]
    return worst(abs(cut_free[name] - written[name]) for name in shared) / (size or 1.0)


def _drift(system: System, times: Array, y: Array) -> float:
    """Residual of (2.14) along the motion, relative to the size of the coordinates."""
    largest = worst(worst(np.abs(system.f(t, q))) for t, q, _ in instants(times, y))
    n = y.shape[1] // 2
    return largest / (worst(np.abs(y[:, :n]).ravel()) or 1.0)


def share(case: Case, trajectory: Trajectory, others: dict[str, Trajectory]) -> float:
    """The reference's own error against the smallest allow or reach of any quantity."""
    shares = []
    known = table(case.scene)
    for name, allowed in case.allow.items():
        if name not in known:
            continue  # an event's: its times have a check of their own
        bars = [bars[name] for bars in case.reach.values() if name in bars]
        bars += [] if allowed is None else [allowed]
        own = observe(case.scene, trajectory, name)
        error = worst(
            worst(np.abs(own - observe(case.scene, other, name))) for other in others.values()
        )
        shares += [error / bar for bar in bars]
    return worst(shares)
