"""The explicit accelerations of every mode against the chapter's formalisms, along its motion."""

from collections.abc import Iterator, Mapping

import numpy as np

from ..coverage import look
from ..formalisms import energy, lagrange, newton_euler
from ..generated.mechanism import Mechanism
from ..generated.mode import Multibody
from ..motion.bodies import Answer
from ..system import Array, Mode
from .agreement import Check, worst

LAW = 1e-12  # of the largest term: the laws are algebra, only rounding may differ


def laws(answer: Answer, generated: Mechanism, times: Array) -> Iterator[Check]:
    """The laws of every mode along its own part of the motion; the worst of each."""
    found: dict[str, Check] = {}
    followed, written = answer.followed, answer.system is not generated
    for name in dict.fromkeys(followed.modes):
        mine, mode = np.array(followed.modes) == name, answer.system.modes[name]
        for check in of_mode(mode, generated.base, times[mine], followed.y[mine], written=written):
            known = found.setdefault(check.name, check)
            if not check.difference <= known.difference:  # true for NaN
                found[check.name] = check
    yield from found.values()


def of_mode(
    mode: Mode, generated: Multibody, times: Array, y: Array, *, written: bool
) -> Iterator[Check]:
    """The explicit accelerations against each formalism along the motion.

    Differences are relative to the largest term: of the accelerations and powers themselves, or of
    those that each force alone would give, since at rest the forces cancel but for rounding.
    """
    look()
    bound = len(mode.f_a(0.0, y[0, : y.shape[1] // 2])) > 0
    sizes, powers, derived, balances, unbalanced, forces = [], [], [], [], [], []
    for t, row in zip(times.tolist(), y, strict=True):
        q, v = np.split(row, 2)
        a = mode.accelerations(t, q, v)
        alone = generated.terms(t, *generated.place(mode.poses(t, q, v)))
        sizes += [worst(np.abs(a)), alone[0]]
        powers += [float(np.sum(np.abs(lagrange.momentum(mode, t, q, v) * a))), alone[1]]
        if bound:
            derived.append(worst(np.abs(lagrange.multipliers(mode, t, q, v)[0] - a)))
        else:
            derived.append(worst(np.abs(lagrange.accelerations(mode, t, q, v) - a)))
        balances.append(abs(energy.power_balance(mode, t, q, v)))
        if written:
            residual, cut_free = newton_euler.balance(mode, t, q, v, a)
            unbalanced.append(residual)
            forces.append(_other_forces(cut_free, mode.reactions(t, q, v)))
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
