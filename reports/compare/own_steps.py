"""A user's model at its own step and at finer ones, by each integrator, against its limit.

The limit is of the engine's own continuous equations: what is off is the step's, and nothing is
said of the equations. These are compared in `own_equations`.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from math import log2

import numpy as np

from ...cases.trajectory import Array
from ...engines.mujoco.own_model.limit import INTEGRATORS, Limit, apart, limit, moved, stepped
from ...engines.mujoco.own_model.model import OwnModel

DURATION, SAMPLES = 1.0, 25  # s, and how many samples after the start at most
TOLERANCE = 1e-3  # rad, m
RUNGS = 4  # h, h/2, h/4, h/8
DISTURBED = 1e-9  # rad, m: what grows from it to the tolerance is chaos, and judged no longer
OWN = "own"
Mask = np.ndarray[tuple[int], np.dtype[np.bool_]]
ROUNDING = 1e-12  # rad, m: below it errors are of rounding
SETTLED = 0.5  # the least order of an error that falls
KNOWN = 0.1  # of the tolerance: a limit that is not known so well judges nothing


@dataclass(frozen=True)
class Step:
    """An integrator at a model's own step and finer: the worst joint, and how its error falls.

    off [rad, m] at the time `when` [s]; None where it diverges. order: of the last two steps that
    are above the limit's own error, where it falls. keeps: the largest step tried [s] from which on
    the tolerance is kept.
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

    @property
    def judges(self) -> bool:
        """Whether the limit is known well enough to say which step keeps the tolerance."""
        return self.limit.error <= KNOWN * self.tolerance


def steps(own: OwnModel, tolerance: float = TOLERANCE) -> Steps:
    """Runs a model by its own and by the other integrators. Raises NoLimit."""
    h = own.model.opt.timestep
    every = max(1, round(DURATION / SAMPLES / h))
    count = max(1, int(DURATION / (every * h) + 1e-9))
    times = np.arange(count + 1) * (every * h)
    exact = limit(own, times)
    until = _horizon(own, exact, tolerance)
    judged = times <= until
    others = [name for name, word in INTEGRATORS.items() if word != own.model.opt.integrator]
    rows = [_row(own, name, exact, judged, tolerance) for name in (OWN, *others)]
    return Steps(exact, until, tolerance, rows)


def _horizon(own: OwnModel, exact: Limit, tolerance: float) -> float:
    """Returns until when a disturbance of the start stays below the tolerance."""
    start = own.start()
    by = np.random.default_rng(0).choice((-DISTURBED, DISTURBED), own.model.nv)
    start.qpos[:] = moved(own.model, start.qpos, by)
    disturbed = limit(own, exact.times, start)
    far = [k for k, off in enumerate(_off(own, exact, disturbed.q)) if off.max() > tolerance]
    return float(exact.times[far[0] - 1] if far else exact.times[-1])


def _off(own: OwnModel, exact: Limit, q: Array) -> Array:
    """(N, n) [rad, m]: how far each joint is from the limit."""
    return np.array([np.abs(apart(own.model, a, b)) for a, b in zip(exact.q, q, strict=True)])


def _row(own: OwnModel, name: str, exact: Limit, judged: Mask, tolerance: float) -> Step:
    h, integrator = own.model.opt.timestep, None if name == OWN else name
    ladder: list[Array | None] = []
    for k in range(RUNGS):
        q = stepped(own, exact.times, integrator, h / 2**k)
        ladder.append(None if q is None else _off(own, exact, q)[judged])
    worst = [np.inf if off is None else float(off.max()) for off in ladder]
    kept = [k for k in range(RUNGS) if all(e <= tolerance for e in worst[k:])]
    known = exact.error <= KNOWN * tolerance
    keeps = h / 2 ** kept[0] if kept and known else None
    clear = [e for e in worst if max(10 * exact.error, ROUNDING) < e < np.inf]
    order = log2(clear[-2] / clear[-1]) if len(clear) > 1 else None
    if order is not None and order < SETTLED:
        order = None
    if (first := ladder[0]) is None:
        return Step(name, h, "", None, None, order, keeps)
    k, joint = np.unravel_index(int(np.argmax(first)), first.shape)
    name_of = own.tree.named(int(joint)) if worst[0] else ""
    return Step(name, h, name_of, worst[0], float(exact.times[k]), order, keeps)
