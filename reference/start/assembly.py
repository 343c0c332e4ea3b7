"""The start of a case: what it gives, what the constraints make of that, and the mechanism there.

Positions by Newton's method from guesses, rates by linear algebra; in the plane and in space.
"""

import numpy as np

from ...cases.case import Case
from ...cases.scene import Scene
from ...cases.scene.frame import SPACE
from ..mechanism.kinematics.coordinates import Coordinates
from ..mechanism.kinematics.spatial_coordinates import SpatialCoordinates
from ..mechanism.modes.mechanism import Mechanism, PlanarMechanism, SpatialMechanism
from ..system import Array, Pose
from . import refusal
from .closure import Closure
from .positions import positions
from .rates import rates
from .search import RANK, rank
from .space import refusal as spatial_refusal
from .space.closure import SpatialClosure, size_in_space
from .space.positions import positions as spatial_positions
from .space.rates import rates as spatial_rates

SHORT = 1e-9  # of the mechanism's size: a rod of that length has no direction


def mechanism(case: Case) -> Mechanism:
    """The mechanism of a case's scene at its start. Raises CaseError as `assemble` does."""
    if case.scene.frame is SPACE:
        return SpatialMechanism(case.scene, assemble_in_space(case, case.scene))
    q, v = assemble(case)
    inner = [force.begins for force in case.scene.inner().values()]
    return PlanarMechanism(case.scene, (np.append(q, inner), v), size_of(case))


def size_of(case: Case) -> float:
    """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
    if case.scene.frame is SPACE:
        return size_in_space(case, case.scene)
    return Closure(case).size


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


def assemble_in_space(case: Case, scene: Scene) -> tuple[Array, Array]:
    """q (m,) and v (n,) at t = 0 in space. Raises CaseError as `assemble` does."""
    closure = SpatialClosure(case, scene)
    q = spatial_positions(closure)
    part = closure.dependent(q, RANK)
    if part is not None:
        raise spatial_refusal.dependent(closure, part)
    return q, spatial_rates(closure, q)


def _long(closure: Closure, q: Array) -> None:
    """Refuses a rod without length: it would have no direction."""
    rods = [joint.name for joint in closure.case.scene.joints.values() if joint.swings]
    for part in closure.parts:
        if part.part in rods and abs(part.places(0.0, q.tolist())[0]) < SHORT * closure.size:
            raise refusal.without_length(closure, part.part)


def _independent(closure: Closure, q: Array) -> None:
    """Refuses the first joint or contact whose constraints only repeat what others hold."""
    held = np.zeros((0, closure.n))
    for c in closure.parts:
        held = np.vstack([held, closure.rows([c], q)])
        if rank(held, RANK) < len(held):
            raise refusal.dependent(closure, c.part)
