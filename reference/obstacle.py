"""What stops a motion: a line without direction, or constraints that come to depend on each other.

It is asked only after the integrators have failed, to say why.
"""

import numpy as np

from ..cases.case import Case
from ..cases.mistake import CaseError
from .generated.action import ends_meet
from .generated.mechanism import Mechanism
from .motion.smooth import Stuck
from .start.closure import Closure
from .start.positions import rank
from .system import Array

SHORT = 1e-3  # of the mechanism's size: steps give up well before the length is zero
DEPENDENT = 1e-2  # singular values below this part of the largest: the same, for constraints


def refused(case: Case, generated: Mechanism, stuck: Stuck) -> CaseError:
    """The end of a motion as a mistake in the case, at its duration."""
    q, _ = generated.place(stuck.system.poses(stuck.time, stuck.q, stuck.v))
    why = _line(case, generated, stuck.time, q) or _constraint(case, q) or str(stuck)
    what = f"the motion cannot be followed beyond t = {stuck.time:.4g} s: {why}"
    return CaseError([case.mistake(("duration",), what)])


def _line(case: Case, generated: Mechanism, t: float, q: Array) -> str | None:
    size = Closure(case).size
    for force in case.scene.forces.values():
        if ends_meet(force, generated.where, t, q.tolist(), SHORT * size):
            return f"{force.name} has no length there, and so no direction"
    return None


def _constraint(case: Case, q: Array) -> str | None:
    closure = Closure(case)
    rows = np.zeros((0, closure.n))
    for c in closure.parts:
        rows = np.vstack([rows, closure.rows([c], q)])
        if rank(rows, DEPENDENT) < len(rows):
            return (
                f"in this position what {c.part} holds is held by the others already, so that "
                "neither its reaction nor the way on is determined"
            )
    return None
