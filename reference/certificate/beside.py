"""The hand-written system beside the mechanism of the scene, at one state at a time.

No integrator's error is in it: a mass or a sign that only the scene has otherwise shows at once,
however sensitive the motion and however loose its tolerances are.
"""

import math
from collections.abc import Iterator

import numpy as np

from ..coverage import look
from ..formalisms.derivative import along
from ..generated.either import Base, Generated
from ..motion.bodies import Answer
from ..system import Array, Mode
from .agreement import Check, worst

AGREE = 1e-12  # of the largest term, if the mechanism's own equations are well conditioned
EPS = float(np.finfo(np.float64).eps)
DIGITS = 100  # times ε and the condition of its equations: what these lose


def beside(written: Answer, built: Answer, generated: Generated, times: Array) -> Iterator[Check]:
    """Accelerations, and reactions where the system knows its own; phase by phase.

    With another count of phases there is nothing to compare: the events say so.
    """
    look()
    followed, phases = written.followed, built.followed.phases
    if len(phases) != len(followed.phases):
        return
    moved, held, condition = [], [], 1.0
    for t, phase, y in zip(times.tolist(), followed.phase.tolist(), followed.y, strict=True):
        mode, other = written.system.modes[followed.phases[phase]], generated.modes[phases[phase]]
        q, v = mode.parted(y)
        place = generated.base.place(mode.poses(t, q, v))
        a = _accelerations(mode, generated.base, t, q, v)
        size = max(worst(np.abs(a)), generated.base.terms(t, *place)[0]) or 1.0
        moved.append(worst(np.abs(other.accelerations(t, *place) - a)) / size)
        condition = max(condition, _condition(other.f_a(t, place[0]), generated.base))
        own, theirs = mode.reactions(t, q, v), other.reactions(t, *place)
        force = worst(map(abs, theirs.values())) or 1.0
        held += [abs(own[name] - theirs[name]) / force for name in own if name in theirs]
    lost = 10.0 ** math.ceil(math.log10(DIGITS * EPS * condition))  # rounding's are its digits
    bound = max(AGREE, lost)
    yield Check("generated accelerations", worst(moved), bound)
    if held:
        yield Check("generated reactions", worst(held), bound)


def _accelerations(mode: Mode, base: Base, t: float, q: Array, v: Array) -> Array:
    """(n,) of the bodies: the change of the velocities that the system's poses have."""
    a = mode.accelerations(t, q, v)

    def velocities(t: object, q: Array, v: Array) -> Array:
        return base.where.velocities(mode.poses(t, q, v))

    rates: Array = along(velocities, (t, q, v), (1.0, mode.rates(t, q, v), a))
    return rates


def _condition(rows: Array, base: Base) -> float:
    """Of the equations for the multipliers, in units in which each row has the size 1."""
    if not len(rows):
        return 1.0
    by_mass = rows / np.sqrt(np.array(base.where.masses))
    by_mass /= np.linalg.norm(by_mass, axis=1, keepdims=True)
    return float(np.linalg.cond(by_mass)) ** 2
