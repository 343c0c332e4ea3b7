"""Where an engine starts: row 0 of the reference, or the assembled scene, the same to rounding."""

from ...cases.case import Case
from ...cases.trajectory import Trajectory
from ...engines.engine import State
from ...reference.generated.mechanism import Mechanism
from ...reference.start.assembly import assemble


def first(reference: Trajectory) -> State:
    """Row 0 of the reference."""
    return {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}  # type: ignore[misc]


def assembled(case: Case) -> State:
    """The start of a case that nobody has solved. Raises CaseError where there is none."""
    mechanism = Mechanism(case.scene, assemble(case))
    poses = mechanism.poses(0.0, *mechanism.start())
    return {name: tuple(float(x) for x in pose) for name, pose in poses.items()}  # type: ignore[misc]
