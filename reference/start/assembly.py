"""The start of a case: what it gives, and what the constraints make of that.

Positions by Newton's method from guesses, rates by linear algebra; in the plane and in space.
"""

import numpy as np

from ...cases.case import Case
from ...cases.mistake import CaseError
from ...cases.scene.frame import SPACE
from ..system import Array, Pose
from . import messages
from .planar_closure import PlanarClosure
from .positions import positions
from .rates import rates
from .search import RANK
from .spatial_closure import SpatialClosure

EPS = float(np.finfo(np.float64).eps)
ROUNDINGS = 8.0  # of places, in one equation: a sum of as many terms
ILL = 5e-3  # of rad or sizes: a chain of 100 has 0.016, shipped mechanisms 0.1 or more (measured)
SHORT = 1e-9  # of the mechanism's size: a rod of that length has no direction


def equally_good_start(
    closure: PlanarClosure | SpatialClosure, q: Array, v: Array
) -> tuple[Array, Array] | None:
    """Another start, as far off along what is determined worst as rounding of the equations allows.

    None where that is not far: each answer to a case begins at its one start, and so none shows it.
    """
    rows = closure.equations(q)[1][:, closure.free]
    if not rows.size:
        return None
    _, sizes, ways = np.linalg.svd(rows, full_matrices=False)
    if sizes[-1] > ILL:
        return None
    far = ROUNDINGS * EPS * closure.rounding / float(sizes[-1])
    change = np.zeros(closure.n)
    change[closure.free] = far * ways[-1]
    there = closure.moved(q, closure.units * change)
    try:
        return there, rates(closure, there)
    except CaseError:  # what is given agrees with its own place only
        return there, v


def closure_of(case: Case) -> PlanarClosure | SpatialClosure:
    """The equations of its start."""
    return SpatialClosure(case) if case.scene.frame is SPACE else PlanarClosure(case)


def size_of(case: Case) -> float:
    """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
    return closure_of(case).size


def assemble(case: Case) -> tuple[Array, Array]:
    """q (m,) and v (n,) at t = 0 in maximal coordinates.

    Raises CaseError if the constraints are not independent, the mechanism cannot be assembled
    or can be in two ways, or a coordinate or rate stays undetermined.
    """
    return assembled(closure_of(case))


def assembled(closure: PlanarClosure | SpatialClosure) -> tuple[Array, Array]:
    """The start that these equations have, as `assemble` gives it. Raises CaseError as it does."""
    q = positions(closure)
    _long(closure, q)
    part = closure.dependent(q, RANK)
    if part is not None:
        raise messages.dependent(closure.case, part)
    return q, rates(closure, q)


def start_poses(case: Case) -> dict[str, Pose]:
    """The state of each body at t = 0, as its frame has it. Raises CaseError as `assemble` does."""
    poses: dict[str, Pose] = closure_of(case).where.poses(*assemble(case))
    return poses


def _long(closure: PlanarClosure | SpatialClosure, q: Array) -> None:
    """Refuses a rod without length: it would have no direction."""
    rods = [joint.name for joint in closure.scene.joints.values() if joint.swings]
    for part in closure.parts:
        if part.part in rods and abs(part.places(0.0, q.tolist())[0]) < SHORT * closure.size:
            raise messages.without_length(closure.case, part.part)
