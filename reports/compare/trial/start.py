"""Where an engine starts: row 0 of the reference, or the assembled scene, the same to rounding."""

from ....cases.case import Case
from ....cases.trajectory import Trajectory
from ....engines.engine import Start
from ....reference.start.assembly import start_poses
from ....reference.states.answer import first_state


def first(reference: Trajectory) -> Start:
    """Row 0 of the reference."""
    return {name: tuple(rows[0].tolist()) for name, rows in reference.states.items()}  # type: ignore[misc]


def assembled(case: Case) -> Start:
    """The start of a case that nobody has solved. Raises CaseError where there is none."""
    poses = start_poses(case) if case.states is None else first_state(case)
    return {name: tuple(float(x) for x in pose) for name, pose in poses.items()}  # type: ignore[misc]
