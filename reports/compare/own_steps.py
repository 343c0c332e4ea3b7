"""A user's model at its own step and at finer ones, by each integrator, against its limit.

The limit is of the engine's own continuous equations: what is off is the step's, and nothing is
said of the equations. These are compared in `own_equations`.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from ...cases.trajectory import Array
from ...engines.own_model.limit import (
    INTEGRATORS,
    PAIRS,
    Limit,
    apart,
    apart_by_pairs,
    limit,
    stepped,
)  # fmt: skip
from ...engines.own_model.model import OwnModel, moved
from .judge.convergence import instants, study

DURATION, SAMPLES = 1.0, 25  # s, and how many samples after the start at most
TOLERANCE = 1e-3  # rad, m
RUNGS = (4.0, 2.0, 1.0, 1 / 2, 1 / 4, 1 / 8)  # of its own step
DISTURBED = 1e-9  # rad, m: what grows from it to the tolerance is chaos, and judged no longer
OWN = "own"
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]
ROUNDING = 1e-12  # rad, m: below it errors are of rounding
CLEAR = 10  # times the limit's own error: below it an order is of that
KNOWN = 0.1  # of the tolerance: a limit that is not known so well judges nothing


@dataclass(frozen=True)
class Step:
    """An integrator at a model's own step: the worst joint, and how its error falls on a ladder.

    off [rad, m] at the time `when` [s]; None where it diverges. order: of the error's
    size, where that is clear. keeps: the largest step tried [s] from which on the tolerance is
    kept.
    """

    setting: str
    step: float
    joint: str
    off: float | None
    when: float | None
    order: float | None
    keeps: float | None


@dataclass(frozen=True)
class Steps:
    """A model at its steps: its limit, until when it is judged [s], and a row an integrator."""

    limit: Limit
    until: float
    tolerance: float
    rows: Sequence[Step]
    note: str

    @property
    def judges(self) -> bool:
        """Whether the limit is known well enough to say which step keeps the tolerance."""
        return self.limit.error <= KNOWN * self.tolerance


def steps(own: OwnModel, tolerance: float = TOLERANCE) -> Steps:
    """Runs a model by its own and by the other integrators. Raises NoLimit."""
    h = own.model.opt.timestep
    whole = int(max(RUNGS))  # each rung meets the samples
    every = whole * max(1, round(DURATION / SAMPLES / h / whole))
    count = max(1, int(DURATION / (every * h) + 1e-9))
    times = np.arange(count + 1) * (every * h)
    exact = limit(own, times)
    until = _horizon(own, exact, tolerance)
    judged = times <= until
    others = [name for name, word in INTEGRATORS.items() if word != own.model.opt.integrator]
    rows = [_row(own, name, exact, judged, tolerance) for name in (OWN, *others)]
    return Steps(exact, until, tolerance, rows, PAIRS if apart_by_pairs(own.model) else "")


def _horizon(own: OwnModel, exact: Limit, tolerance: float) -> float:
    """Returns until when a disturbance of the start stays below the tolerance."""
    start = own.start()
    by = np.random.default_rng(0).choice((-DISTURBED, DISTURBED), own.model.nv)
    start.qpos[:] = moved(own.model, start.qpos, by)
    off = np.abs(apart(own.model, exact.q, limit(own, exact.times, start).q)).max(axis=1)
    far = np.flatnonzero(off > tolerance)
    return float(exact.times[max(far[0] - 1, 0)] if len(far) else exact.times[-1])


def _row(own: OwnModel, name: str, exact: Limit, judged: Mask, tolerance: float) -> Step:
    h, integrator = own.model.opt.timestep, None if name == OWN else name
    ladder: dict[float, Array] = {}
    for k in sorted(_rungs(own)):  # the finest first: above one that diverges none is usable
        q = stepped(own, exact.times, integrator, h * k)
        if q is None:
            break
        ladder[h * k] = apart(own.model, exact.q, q)[judged]
    floor = max(CLEAR * exact.error, ROUNDING)
    known = exact.error <= KNOWN * tolerance
    keeps = instants(_largest(ladder), tolerance).usable_step if known else None
    clear = {step: off for step, off in ladder.items() if np.abs(off).max() > floor}
    order = None
    if clear:
        zero = np.zeros_like(next(iter(clear.values())))
        order = study(clear, zero, exponents=(), allow=tolerance, floor=floor).order
    if (off := ladder.get(h)) is None:
        return Step(name, h, "", None, None, order, keeps)
    k, joint = np.unravel_index(int(np.argmax(np.abs(off))), off.shape)
    worst = float(np.abs(off).max())
    where = own.tree.named(int(joint)) if worst else ""
    return Step(name, h, where, worst, float(exact.times[k]), order, keeps)


def _rungs(own: OwnModel) -> tuple[float, ...]:
    """Returns the ladder's steps over its own; a finer one only where its law can be held."""
    return tuple(k for k in RUNGS if k >= 1) if apart_by_pairs(own.model) else RUNGS


def _largest(ladder: Mapping[float, Array]) -> dict[float, float]:
    return {step: float(np.abs(off).max()) for step, off in ladder.items()}
