"""The size of a mechanism: what its lengths are small against."""

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from .closure import Closure
from .space.closure import size_in_space


def size_of(case: Case) -> float:
    """The largest length [m] on a body, wherever the scene stands; without one, the reach."""
    if case.scene.frame is SPACE:
        return size_in_space(case, case.scene)
    return Closure(case).size
