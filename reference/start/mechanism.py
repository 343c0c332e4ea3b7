"""The mechanism of a case's scene at its start."""

import numpy as np

from ...cases.case import Case
from ...cases.scene.frame import SPACE
from ..mechanism.modes.mechanism import Mechanism, PlanarMechanism, SpatialMechanism
from .assembly import assemble
from .sizes import size_of
from .space.assembly import assemble_in_space


def mechanism(case: Case) -> Mechanism:
    """In the plane or in space. Raises CaseError for a start that cannot be assembled."""
    if case.scene.frame is SPACE:
        return SpatialMechanism(case.scene, assemble_in_space(case, case.scene))
    q, v = assemble(case)
    inner = [force.begins for force in case.scene.inner().values()]
    return PlanarMechanism(case.scene, (np.append(q, inner), v), size_of(case))
