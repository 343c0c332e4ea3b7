"""The start of a scene: what the case gives, and what the constraints make of it.

Positions by Newton's method from a guess, rates by linear algebra.
"""

import math

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from ..mechanism.kinematics.coordinates import Coordinates
from ..mechanism.kinematics.space.coordinates import SpatialCoordinates
from ..system import Array, Pose
from . import refusal
from .closure import Closure
from .positions import RANK, positions, rank
from .rates import rates
from .space.assembly import assemble_in_space

SHORT = 1e-9  # of the mechanism's size: a rod of that length has no direction


def assemble(case: Case) -> tuple[Array, Array]:
    """q (n,) and v (n,) at t = 0 in maximal coordinates.

    Raises CaseError if the constraints are not independent, the mechanism cannot be assembled
    or can be in two ways, or a coordinate or rate stays undetermined.
    """
    closure = Closure(case)
    q = positions(closure)
    _long(closure, q)
    _independent(closure, q)
    return q, rates(closure, q)


def start_poses(case: Case) -> dict[str, Pose]:
    """The state of each body at t = 0, as its frame has it. Raises CaseError as `assemble` does."""
    if case.scene.frame is SPACE:
        q, v = assemble_in_space(case, case.scene)
        return SpatialCoordinates(case.scene).poses(q, v)
    return Coordinates(case.scene).poses(*assemble(case))


def _long(closure: Closure, q: Array) -> None:
    """Refuses a rod without length: it would have no direction."""
    for joint in closure.case.scene.joints.values():
        if joint.swings:
            a, b = (
                closure.where.point(at, 0.0, q.tolist(), q.tolist()) for at in (joint.a, joint.b)
            )
            if math.hypot(b.r[0] - a.r[0], b.r[1] - a.r[1]) < SHORT * closure.size:
                raise refusal.without_length(closure, joint.name)


def _independent(closure: Closure, q: Array) -> None:
    """Refuses the first joint or contact whose constraints only repeat what others hold."""
    held = np.zeros((0, closure.n))
    for c in closure.parts:
        held = np.vstack([held, closure.rows([c], q)])
        if rank(held, RANK) < len(held):
            raise refusal.dependent(closure, c.part)
