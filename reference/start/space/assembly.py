"""The start of a scene in space: positions by Newton's method, rates by linear algebra."""

from ....cases.case import Case
from ....cases.scene import Scene
from ...system import Array
from . import refusal
from .closure import RANK, SpatialClosure
from .positions import positions
from .rates import rates


def assemble_in_space(case: Case, scene: Scene) -> tuple[Array, Array]:
    """q (m,) and v (n,) at t = 0.

    Raises CaseError if the constraints are not independent, the mechanism cannot be assembled or
    can be in two ways, or a coordinate or rate stays undetermined.
    """
    closure = SpatialClosure(case, scene)
    q = positions(closure)
    part = closure.dependent(q, RANK)
    if part is not None:
        raise refusal.dependent(closure, part)
    return q, rates(closure, q)
