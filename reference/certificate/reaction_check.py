"""The hand-written system beside the mechanism of the scene, at one state at a time.

No integrator's error is in it: a mass or a sign that only the scene has otherwise shows at once,
however sensitive the motion and however loose its tolerances are.
"""

import math
from collections.abc import Callable, Iterator

import numpy as np

from ..formalisms.derivative import along
from ..mechanism.modes.mechanism import Mechanism
from ..mechanism.modes.mode import Multibody
from ..motion.bodies import Answer
from ..system import Array, Mode
from .agreement import Check, worst

AGREE = 1e-12  # of the largest term, if the mechanism's own equations are well conditioned
EPS = float(np.finfo(np.float64).eps)
ULPS, DRAWS, SEED = 2, 8, 2  # what a sum of some terms, each rounded, is off
DIGITS = 100  # times ε and the condition of its equations: what these lose


def reaction_checks(
    written: Answer, built: Answer, generated: Mechanism, times: Array
) -> Iterator[Check]:
    """Accelerations, and reactions where the system knows its own; phase by phase.

    With another count of phases there is nothing to compare: the events say so.
    """
    followed, phases = written.followed, built.followed.phases
    if len(phases) != len(followed.phases):
        return
    moved, held, uneven = [], [], 1.0
    for t, phase, y in zip(times.tolist(), followed.phase.tolist(), followed.y, strict=True):
        mode, other = written.system.modes[followed.phases[phase]], generated.modes[phases[phase]]
        q, v = mode.parted(y)
        place = generated.base.place(mode.poses(t, q, v))
        a = _accelerations(mode, generated.base, t, q, v)
        size = max(worst(np.abs(a)), generated.base.terms(t, *place)[0]) or 1.0
        error = worst(np.abs(other.accelerations(t, *place) - a)) / size
        moved.append(unexplained(error, size, (other.accelerations, t, *place)))
        rows = other.f_a(t, place[0])
        uneven = max(uneven, condition(rows, generated.base))
        own, theirs = mode.reactions(t, q, v), other.reactions(t, *place)
        force = worst(map(abs, theirs.values())) or 1.0
        error = worst(abs(own[name] - theirs[name]) / force for name in own if name in theirs)
        if error > AGREE:
            most = max(force, _borne(rows, generated.base, t, *place))
            error, force = error * force / most, most
        error = unexplained(error, force, (reactions(other), t, *place), (reactions(mode), t, q, v))
        held += [error] if own.keys() & theirs.keys() else []
    least = max(AGREE, rounding_error(uneven))
    yield Check("generated accelerations", worst(moved), least)
    if held:
        yield Check("generated reactions", worst(held), least)


def _power(x: float) -> float:
    """The next power of ten above a number; 0 of 0."""
    return 10.0 ** math.ceil(math.log10(x)) if x else 0.0


def _accelerations(mode: Mode, base: Multibody, t: float, q: Array, v: Array) -> Array:
    """(n,) of the bodies: the change of the velocities that the system's poses have."""
    a = mode.accelerations(t, q, v)

    def velocities(t: object, q: Array, v: Array) -> Array:
        return base.where.velocities(mode.poses(t, q, v))

    rates: Array = along(velocities, (t, q, v), (1.0, mode.rates(t, q, v), a))
    return rates


def _borne(rows: Array, base: Multibody, t: float, q: Array, v: Array) -> float:
    """The largest force that one force exerts along what the rows hold.

    A reaction is the sum of such, and where it goes through zero their rounding is left of it.
    """
    along = np.abs(rows) / np.linalg.norm(rows, axis=1, keepdims=True)
    return worst((along * base.largest(t, q, v)).ravel())


Follows = tuple[Callable[..., Array], float, Array, Array]
"""What follows from a state, and the state: t [s], q and v."""


def unexplained(error: float, size: float, *follows: Follows) -> float:
    """The difference, or 0 where the states' own rounding may be all of it, in powers of ten.

    Of two answers each has a state of its own: beside a dead centre that of one tells it badly.
    """
    if not error > AGREE:
        return error
    steep = sum(_sensitivity(*quantity) for quantity in follows)
    return 0.0 if error <= _power(steep / size) else error


def reactions(mode: Mode) -> Callable[..., Array]:
    """The mode's reactions as one array."""
    return lambda t, q, v: np.array([*mode.reactions(t, q, v).values()])


def _sensitivity(of: Callable[..., Array], t: float, q: Array, v: Array) -> float:
    """Largest change of a function of a state when t, q and v change by some ulp.

    On the threshold of smooth friction a force that is rounded is multiplied by the law's slope. A
    place that is zero is rounded where it is measured from, by an ulp of the others.
    """
    random, here, largest = np.random.default_rng(SEED), of(t, q, v), 0.0
    for _ in range(DRAWS):
        ways = [ULPS * EPS * random.choice((-1.0, 1.0), np.shape(x)) for x in (t, q, v)]
        moved = q + ways[1] * np.where(q == 0.0, worst(np.abs(q)), q)
        there = of(float(t * (1 + ways[0])), moved, v * (1 + ways[2]))
        largest = max(largest, worst(np.abs(there - here)))
    return largest


def rounding_error(condition: float) -> float:
    """Relative error of equations with this condition number, in whole powers of ten."""
    return _power(DIGITS * EPS * condition)  # their digits would be rounding's


def condition(rows: Array, base: Multibody) -> float:
    """Condition number of the equations for the multipliers, in units where each row has size 1.

    Raises LinAlgError where a row is zero.
    """
    if not len(rows):
        return 1.0
    by_mass = rows / np.sqrt(np.array(base.where.masses))
    sizes = np.linalg.norm(by_mass, axis=1, keepdims=True)
    if not np.all(sizes > 0.0):
        raise np.linalg.LinAlgError("a row of zeros")
    by_mass /= sizes
    return float(np.linalg.cond(by_mass)) ** 2
